// The vertices from which an edge can lead to a given one within a radius of the section between:
// a quick choice in doubles, which leaves out only what is certainly too far, with error bounds.
//
// Seen from vertex j, an edge passes every vertex between within the radius r. At distance b it
// leaves j within asin(r / b) of the vertex's direction. The edges that pass all vertices so far
// form a wedge (Chan & Chin 1996). In the plane it is known exactly; otherwise the cone of the
// farthest vertex stands for it. If it is empty, no vertex before can be reached. Nor can it if a
// vertex is nearer by more than 2 r than the farthest one so far, which an edge passes first.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "continuous/boxed_curve.hpp"
#include "continuous/free_space.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

template <int Dim>
class SectionReach {
   public:
    using Vertices = runtime::ScratchVector<std::ptrdiff_t>;

    SectionReach(const BoxedCurve& points, const Radius& radius, Poller& poller)
        : points_(points), r_(radius.scaled()), slack_(radius.slack()), poller_(poller) {}

    // In descending order; valid until the next call.
    const Vertices& before(std::ptrdiff_t j) {
        found_.clear();
        const double* const x = points_.point<Dim>(j);
        const double* farthest = x;
        Wedge wedge;
        double a = 0.0;
        for (std::ptrdiff_t i = j - 1; i >= 0; --i) {
            poller_.spend(1);
            const double* const y = points_.point<Dim>(i);
            double square = 0.0, product = 0.0;
            for (std::ptrdiff_t c = 0; c < points_.dim(); ++c) {
                const double step = y[c] - x[c];
                square += step * step;
                product += step * (farthest[c] - x[c]);
            }
            const double b = std::sqrt(square);
            if (a * a > least_square && (b + 2.0 * r_) * (1.0 + slack_) < a * (1.0 - slack_)) break;
            if (square <= least_square || b <= 2.0 * r_) {
                found_.push_back(i);
                continue;
            }
            if (a > 2.0 * r_ && are_disjoint(product, a, b)) break;
            if constexpr (Dim == 2) {
                const double step[2] = {y[0] - x[0], y[1] - x[1]};
                if (wedge.contains(step, b * slack_)) found_.push_back(i);
                if (!wedge.narrow(step, r_ / b, slack_)) break;
            } else {
                found_.push_back(i);
            }
            if (b > a) {
                a = b;
                farthest = y;
            }
        }
        return found_;
    }

   private:
    static constexpr double least_square = 0x1p-960;  // below it, rounding is not relative

    // Directions from `right` to `left`, counterclockwise, less than 120 degrees apart; all
    // directions at first.
    class Wedge {
       public:
        bool contains(const double* step, double error) const noexcept {
            return !is_set_ || (cross(right_, step) >= -error && cross(step, left_) >= -error);
        }
        // Keeps the directions within the angle with this sine, at most 1/2, of a step. Whether
        // there are any.
        bool narrow(const double* step, double sine, double error) noexcept {
            const double length = std::hypot(step[0], step[1]);
            const double x = step[0] / length, y = step[1] / length;
            const double cosine = std::sqrt(1.0 - sine * sine);
            const double left[2] = {x * cosine - y * sine, y * cosine + x * sine};
            const double right[2] = {x * cosine + y * sine, y * cosine - x * sine};
            if (!is_set_ || cross(left_, left) < 0.0) std::copy(left, left + 2, left_);
            if (!is_set_ || cross(right_, right) > 0.0) std::copy(right, right + 2, right_);
            is_set_ = true;
            return cross(right_, left_) >= -error;
        }

       private:
        static double cross(const double* u, const double* v) noexcept {
            return u[0] * v[1] - u[1] * v[0];
        }
        bool is_set_ = false;
        double left_[2] = {0.0, 0.0}, right_[2] = {0.0, 0.0};  // of length 1
    };

    // Whether no edge passes both vertices, at distances a and b above 2 r.
    bool are_disjoint(double product, double a, double b) const noexcept {
        const double p = r_ / a, q = r_ / b;
        const double cosine = std::sqrt((1.0 - p * p) * (1.0 - q * q)) - p * q;
        return product < (cosine - slack_) * a * b;
    }

    const BoxedCurve& points_;
    double r_, slack_;
    Poller& poller_;
    Vertices found_;
};

}  // namespace curvewise::continuous
