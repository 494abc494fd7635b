// Partial curve mapping's inner problem: the offset o, from 0 to T - S, at which the area
//
//   f(o) = sum of w_i d_i(o),   d_i(o) = |a_i - L(s_i + o)|,   w_i = (s_{i+1} - s_{i-1}) / 2
//
// is smallest; a_i are the vertices of the shorter curve, L the longer one by arc length.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "planar.hpp"
#include "watch.hpp"

namespace curvewise::detail {

// A polyline with the arc length at every vertex.
class ArcCurve {
   public:
    explicit ArcCurve(Polyline points)
        : points_(std::move(points)), arc_lengths_(detail::arc_lengths(points_)) {}

    const Polyline& points() const noexcept { return points_; }
    const std::vector<double>& arc_lengths() const noexcept { return arc_lengths_; }
    double length() const noexcept { return arc_lengths_.back(); }

   private:
    Polyline points_;
    std::vector<double> arc_lengths_;
};

// A place on a curve that moves forward, in O(1) amortised.
class ArcPosition {
   public:
    explicit ArcPosition(const ArcCurve& curve) noexcept : curve_(&curve) {}

    // To arc length u, cut at the curve's length; not before where it was.
    void move_to(double u) noexcept;
    std::size_t segment() const noexcept { return segment_; }
    double fraction() const noexcept { return fraction_; }
    Point point() const noexcept {
        return interpolate(curve_->points()[segment_], curve_->points()[segment_ + 1], fraction_);
    }

   private:
    const ArcCurve* curve_;
    std::size_t segment_ = 0;
    double fraction_ = 0.0;
};

struct Offset {
    double at;
    double area;
};

// Both throw Stopped where the watch says so.
//
// The first of the best among `count` evenly spaced offsets. O(count (n + m)).
Offset best_of_grid(const ArcCurve& shorter, const ArcCurve& longer, std::ptrdiff_t count,
                    Watch& watch);

// The best of all offsets, to 1e-12 S; never above the grid of 200.
Offset best_of_all(const ArcCurve& shorter, const ArcCurve& longer, Watch& watch);

}  // namespace curvewise::detail
