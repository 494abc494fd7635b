// What measures of polygonal curves choose before any work: the scale of coordinates, and the
// number of coordinates as a constant.
#pragma once

#include <cstddef>
#include <type_traits>

#include "curves/range_scale.hpp"

namespace curvewise::continuous {

// The identity for curves whose fourth powers stay in range.
inline curves::RangeScale plain_scale(double largest) noexcept {
    const bool is_plain = largest == 0.0 || (largest > 0x1p-100 && largest < 0x1p100);
    return is_plain ? curves::RangeScale(1.0) : curves::RangeScale::to_unity(largest);
}

// Calls use(dim), with a constant for 1 to 3 coordinates and 0 otherwise.
template <class Use>
auto with_dimension(std::ptrdiff_t dim, Use use) {
    switch (dim) {
        case 1:
            return use(std::integral_constant<int, 1>());
        case 2:
            return use(std::integral_constant<int, 2>());
        case 3:
            return use(std::integral_constant<int, 3>());
        default:
            return use(std::integral_constant<int, 0>());
    }
}

}  // namespace curvewise::continuous
