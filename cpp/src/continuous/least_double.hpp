// The least double for which a monotone condition holds, by bisection on bit patterns. The bit
// patterns of doubles that are not negative have the order of their values. So 62 steps always
// suffice, and 50 if the leading bits are known.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace curvewise::continuous {

inline std::uint64_t bits_of(double x) noexcept {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

inline double double_of(std::uint64_t bits) noexcept {
    double x = 0.0;
    std::memcpy(&x, &bits, sizeof x);
    return x;
}

// The neighbour below a number above 0.
inline double next_below(double x) noexcept { return double_of(bits_of(x) - 1); }

// A double above `below` and at most `most` for which `holds`. `holds` is false for `below`, and
// for another double at most `tolerance` doubles below the result. If no smaller double is found,
// the result is `most`, which is not tested. The search begins `stride` doubles above `below`.
template <class Holds>
double least_double(double below, double most, std::uint64_t stride, std::uint64_t tolerance,
                    Holds holds) {
    std::uint64_t low = bits_of(below), high = bits_of(most);
    for (; stride < (high - low) / 16; stride *= 16) {
        const std::uint64_t middle = low + stride;
        if (holds(double_of(middle))) {
            high = middle;
            break;
        }
        low = middle;
    }
    while (high - low > tolerance) {
        const std::uint64_t middle = low + (high - low) / 2;
        (holds(double_of(middle)) ? high : low) = middle;
    }
    return double_of(high);
}

// The least double that holds, which is hardly below a guess.
template <class Holds>
double least_double_near(double guess, Holds holds) {
    if (holds(0.0)) return 0.0;
    const double below = guess * (1.0 - 0x1p-50);
    const double infinity = std::numeric_limits<double>::infinity();
    return least_double(holds(below) ? 0.0 : below, infinity, 2, 1, holds);
}

}  // namespace curvewise::continuous
