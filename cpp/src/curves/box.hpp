// The smallest axis-parallel box around a curve, and scaling by it: the curve then lies in [0, 1]
// in every coordinate. Each coordinate has its own range: x may be very large and y very small.
#pragma once

#include <cmath>
#include <cstddef>

#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"

namespace curvewise::curves {

// The box in one coordinate.
class BoxSide {
   public:
    BoxSide(const CurveView& curve, std::ptrdiff_t coordinate) noexcept;

    bool has_extent() const noexcept { return has_extent_; }
    double scaled(double x) const noexcept { return (range_.shrink(x) - low_) / extent_; }
    // scaled(b) - scaled(a), without its rounding error far from the box.
    double scaled_difference(double a, double b) const noexcept {
        const double difference = b - a;
        // First the difference, then the range, in which both may be infinite; the other way round
        // where the difference is.
        return (std::isfinite(difference) ? range_.shrink(difference)
                                          : range_.shrink(b) - range_.shrink(a)) /
               extent_;
    }
    // The derivative of scaled().
    double slope() const noexcept { return range_.shrink(1.0 / extent_); }

   private:
    RangeScale range_;
    double low_;
    double extent_ = 1.0;  // 1 if the curve has zero extent: nothing is scaled
    bool has_extent_ = false;
};

// The box of a curve in the plane.
struct Box {
    explicit Box(const CurveView& curve) noexcept : x(curve, 0), y(curve, 1) {}
    BoxSide x;
    BoxSide y;
};

}  // namespace curvewise::curves
