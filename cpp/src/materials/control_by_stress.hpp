// The walk along a path that gives the strain at some points and the stress at others. A stress is
// reached by the least increment of strain that a search finds: from the elastic increment on, the
// increments double until the stress is passed, and the method of Anderson and Björck closes the
// bracket. Every trial starts from a copy of the point. The derivatives are those of the implicit
// function: one direction of the dual numbers is the increment. About ten trials a stress.
//
// N. Anderson, A. Björck, BIT 13 (1973) 253-264.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "materials/path.hpp"

namespace curvewise::materials {

// The increment of strain with which a copy of the point reaches a stress.
template <class Point>
class StressSearch {
   public:
    StressSearch(const Point& point, double modulus) : trial_(point), modulus_(modulus) {}

    double increment(const Point& point, double stress, double target, std::ptrdiff_t i) {
        if (target == stress) return 0.0;
        const double rounding = 16.0 * std::numeric_limits<double>::epsilon();
        const double negligible = rounding * (std::abs(target) + std::abs(stress));
        Try far{0.0, stress - target}, near = far;
        for (double step = (target - stress) / modulus_; !is_between(far, near); step *= 2.0) {
            far = near;
            if (!(std::abs(step) <= most_strain)) refuse_target(i, target, target + far.excess);
            near = tried(point, step, target);
        }
        for (int trials = 0; trials < most_trials && std::abs(near.excess) > negligible; ++trials) {
            const double width = near.at - far.at;
            if (std::abs(width) <= rounding * std::abs(near.at)) break;
            // Every third trial halves the bracket: at a kink secants move one end alone.
            const bool halves = trials % 3 == 2;
            const double part = halves ? 0.5 : near.excess / (near.excess - far.excess);
            const Try next = tried(point, near.at - part * width, target);
            if (is_between(near, next)) {
                far = near;
            } else {
                const double fall = 1.0 - next.excess / near.excess;
                far.excess *= fall > 0.0 ? fall : 0.5;
            }
            near = next;
        }
        return near.at;
    }

   private:
    struct Try {
        double at, excess;
    };
    static constexpr int most_trials = 100;

    // Whether the stress is reached between two trials, or at the second one.
    static bool is_between(const Try& one, const Try& other) noexcept {
        return other.excess == 0.0 || std::signbit(one.excess) != std::signbit(other.excess);
    }
    Try tried(const Point& point, double step, double target) {
        trial_ = point;
        return {step, trial_.advance(step) - target};
    }

    Point trial_;
    double modulus_;
};

// Writes the stress where the strain is given, the strain where the stress is, and, unless null,
// their derivatives by all parameters. Stresses that follow are at most `most`.
template <template <class> class Point, class Material>
void respond(const Material& material, const Parameters& parameters, double most,
             const double* given, const bool* by_stress, std::ptrdiff_t n, double* answer,
             double* slopes, Control* control) {
    constexpr std::size_t directions = 8, of_increment = directions - 1;
    using Number = Dual<directions>;
    const std::size_t count = parameters.count();
    runtime::Poller poller(control);
    for (std::size_t first = 0; first < count; first += of_increment) {
        const std::size_t width = std::min(of_increment, count - first);
        std::vector<Number> seeded(parameters.values(), parameters.values() + count);
        for (std::size_t i = 0; i < width; ++i) seeded[first + i].slopes[i] = 1.0;
        Point<double> plain(material, parameters.values(), count);
        Point<Number> point(material, seeded.data(), count), ahead(point);
        StressSearch<Point<double>> search(plain, parameters[0]);
        double stress = 0.0;
        Number strain(0.0);
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            poller.spend(1024);
            Number increment = given[i] - strain;
            if (by_stress[i]) increment = search.increment(plain, stress, given[i], i);
            stress = plain.advance(increment.value);
            if (!(std::abs(stress) <= most)) refuse_stress(i, stress);
            Number found(stress);
            if (slopes != nullptr) {
                if (by_stress[i]) {
                    ahead = point;
                    increment.slopes[of_increment] = 1.0;
                    const Number there = ahead.advance(increment);
                    for (std::size_t k = 0; k < of_increment; ++k) {
                        increment.slopes[k] = -there.slopes[k] / there.slopes[of_increment];
                    }
                    increment.slopes[of_increment] = 0.0;
                }
                found = point.advance(increment);
            }
            strain = by_stress[i] ? strain + increment : Number(given[i]);
            if (by_stress[i]) found = strain;
            answer[i] = found.value;
            if (slopes == nullptr) continue;
            check_slopes(by_stress[i] ? "strain at stress" : "stress at strain", i,
                         found.slopes.data(), first, width, parameters);
            std::copy_n(found.slopes.begin(), width,
                        slopes + static_cast<std::size_t>(i) * count + first);
        }
        if (slopes == nullptr) return;
    }
}

}  // namespace curvewise::materials
