#include "curves/range_scale.hpp"

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

}  // namespace curvewise::curves
