// For tests of the functions inside dtw and frechet: two curves, packed without scaling, and
// problems of them.
#pragma once

#include <optional>

#include "curves.hpp"
#include "unpolled.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/sweep_problem.hpp"

namespace test {

using curvewise::GroundDistance;
using curvewise::curves::RangeScale;
using curvewise::kernels::Cost;
using curvewise::kernels::Rule;
using curvewise::runtime::Poller;
using curvewise::warping::Band;
using curvewise::warping::Level;
using curvewise::warping::PackedCurve;
using curvewise::warping::PointOrder;
using curvewise::warping::SweepMemory;
using curvewise::warping::SweepProblem;

class SweptPair {
   public:
    SweptPair(const Curve& P, const Curve& Q)
        : p_(P, RangeScale(1.0), PointOrder::forward, unpolled),
          q_(Q, RangeScale(1.0), PointOrder::reversed, unpolled) {}

    // In one thread and without a window. Valid until the next one, whose memory is the same.
    SweepProblem problem(const Level& level, Rule rule, const Cost& cost,
                         Poller& poller = unpolled) {
        memory_ = {};
        return {*level.kernels, {p_, q_}, rule, cost, 2.0, band(), false, 1, poller, memory_};
    }
    // With the cost that the library uses for a ground distance.
    SweepProblem problem(const Level& level, Rule rule, const GroundDistance& ground = {},
                         Poller& poller = unpolled) {
        SweepProblem found =
            problem(level, rule, curvewise::warping::canonical_cost(ground, {p_, q_}), poller);
        found.metric_parameter = ground.parameter();
        return found;
    }
    Band band(const std::optional<std::ptrdiff_t>& window = std::nullopt) const {
        return {p_.size(), q_.size(), window};
    }

   private:
    PackedCurve p_;
    PackedCurve q_;
    SweepMemory memory_;
};

}  // namespace test
