// The smallest axis-parallel box around a curve, and scaling by it: the curve itself comes to lie
// in [0, 1] in every coordinate. Each coordinate has a range of its own: x may be as large as y is
// small.
#pragma once

#include <cstddef>

#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"

namespace curvewise::detail {

// The box in one coordinate.
class BoxSide {
   public:
    BoxSide(const CurveView& curve, std::ptrdiff_t coordinate) noexcept;

    bool has_extent() const noexcept { return has_extent_; }
    double scaled(double x) const noexcept { return (range_.shrink(x) - low_) / extent_; }
    // The derivative of scaled().
    double slope() const noexcept { return range_.shrink(1.0 / extent_); }

   private:
    RangeScale range_;
    double low_;
    double extent_ = 1.0;  // 1 where the curve has none: there nothing is scaled
    bool has_extent_ = false;
};

// The box of a curve in the plane.
struct Box {
    explicit Box(const CurveView& curve) noexcept : x(curve, 0), y(curve, 1) {}
    BoxSide x;
    BoxSide y;
};

}  // namespace curvewise::detail
