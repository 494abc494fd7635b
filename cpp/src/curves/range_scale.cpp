#include "curves/range_scale.hpp"

#include <algorithm>

namespace curvewise::curves {

RangeScale::RangeScale(double largest_magnitude) noexcept {
    const double limit = std::ldexp(1.0, 500);
    if (largest_magnitude > limit || (largest_magnitude > 0 && largest_magnitude < 1.0 / limit)) {
        std::frexp(largest_magnitude, &exponent_);
    }
}

RangeScale RangeScale::to_unity(double magnitude) noexcept {
    RangeScale range;
    std::frexp(magnitude, &range.exponent_);
    return range;
}

RangeScale RangeScale::beside(double constant, int degree) const noexcept {
    RangeScale range = *this;
    if (exponent_ >= 0 || constant <= 0.0 || degree == 0) return range;
    int exponent = 0;
    std::frexp(constant, &exponent);
    range.exponent_ = std::min(0, std::max(exponent_, (exponent - 1000) / degree));
    return range;
}

RangeScale RangeScale::with_coordinate(double coordinate) const noexcept {
    RangeScale range = *this;
    int exponent = 0;
    std::frexp(coordinate, &exponent);
    if (coordinate != 0.0) range.exponent_ = std::max(exponent_, exponent - 500);
    return range;
}

}  // namespace curvewise::curves
