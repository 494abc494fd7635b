// Two curves as functions of x, piecewise linear, and the strips between them over the x that both
// span: the basis of Spacing::function.
#pragma once

#include <algorithm>
#include <cstddef>

#include "curves/checks.hpp"
#include "curves/range_scale.hpp"
#include "planar/quad.hpp"
#include "runtime/poller.hpp"

namespace curvewise::planar {

// A strip lies between two values of x, between which both functions are linear: the quadrilateral
// {P at low, P at high, Q at high, Q at low}.

// The integral of |f - g| over a strip.
double strip_area(const Quad& strip) noexcept;
// The integral of (f - g)^2.
double strip_squares(const Quad& strip) noexcept;

// A function walked from one of its points to the next, in the order of x.
class FunctionWalk {
   public:
    FunctionWalk(const curves::CheckedCurve& checked, const curves::RangeScale& range,
                 runtime::Poller& poller);
    std::size_t size() const noexcept { return points_.size(); }
    double low() const noexcept { return points_.front().x; }
    double high() const noexcept { return points_.back().x; }
    // Moves to the segment on which the function continues from x, beyond all points at x.
    void go_to(double x) noexcept {
        while (segment_ + 2 < points_.size() && points_[segment_ + 1].x <= x) ++segment_;
    }
    double next() const noexcept { return points_[segment_ + 1].x; }
    Point at(double x) const noexcept {
        const Point &a = points_[segment_], &b = points_[segment_ + 1];
        if (x == a.x) return a;
        if (x == b.x) return b;
        return {x, interpolate(a, b, (x - a.x) / (b.x - a.x)).y};
    }

   private:
    curves::Polyline points_;
    std::size_t segment_ = 0;
};

// The strips from one x to the next at which either curve has a point, in the order of x and in
// `range`. Every strip has a width. A curve with several points at one x jumps there. O(n + m).
// Throws std::invalid_argument if x turns back, or if the curves do not share a span of x; Stopped
// if the poller stops the call.
class FunctionStrips {
   public:
    FunctionStrips(const curves::CheckedCurve& P, const curves::CheckedCurve& Q,
                   const curves::RangeScale& range, runtime::Poller& poller);

    // Calls visit(strip) for each.
    template <class Visit>
    void for_each(runtime::Poller& poller, Visit visit) {
        double x = low_;
        for (std::size_t i = 0; x < high_; ++i) {
            poller.poll_in_loop(i);
            p_.go_to(x);
            q_.go_to(x);
            const double next = std::min({p_.next(), q_.next(), high_});
            visit(Quad{p_.at(x), p_.at(next), q_.at(next), q_.at(x)});
            x = next;
        }
    }

   private:
    FunctionWalk p_, q_;
    double low_, high_;
};

// Throws as FunctionStrips where x turns back.
void check_is_function(const curves::CheckedCurve& checked, runtime::Poller& poller);

}  // namespace curvewise::planar
