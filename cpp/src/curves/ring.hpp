// Closed curves as lists of points: where one begins does not matter, and a last point that equals
// the first one only closes the curve.
#pragma once

#include <algorithm>
#include <cstddef>

#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::curves {

// How many points a closed curve has, without one that closes it.
inline std::ptrdiff_t points_of_ring(const CurveView& curve) noexcept {
    const std::ptrdiff_t n = curve.size();
    for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
        if (curve(0, c) != curve(n - 1, c)) return n;
    }
    return std::max<std::ptrdiff_t>(n - 1, 1);
}

// How often a curve is gone around, and from which point.
struct Turns {
    std::ptrdiff_t count, begin;
};

// The points of a closed curve on its way around, and the first of them again: a copy.
class RingPoints {
   public:
    RingPoints(const CurveView& curve, const Turns& turns, runtime::Poller& poller)
        : points_(copied(curve, turns, poller)),
          view_(points_.data(), static_cast<std::ptrdiff_t>(points_.size()) / curve.dim(),
                curve.dim()) {}

    const CurveView& view() const noexcept { return view_; }

   private:
    static runtime::ScratchVector<double> copied(const CurveView& curve, const Turns& turns,
                                                 runtime::Poller& poller) {
        const std::ptrdiff_t points = points_of_ring(curve), count = turns.count * points + 1;
        runtime::ScratchVector<double> ring;
        ring.reserve(static_cast<std::size_t>(count * curve.dim()));
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            poller.poll_in_loop(static_cast<std::size_t>(i));
            for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
                ring.push_back(curve((turns.begin + i) % points, c));
            }
        }
        return ring;
    }

    runtime::ScratchVector<double> points_;
    CurveView view_;
};

}  // namespace curvewise::curves
