// The boundary between soft-DTW and its kernels: one anti-diagonal of a strip of the table (see
// strip.hpp), forwards and backwards.
//
// A cell holds Z = exp(-R / gamma), the sum over all paths to it of the exponentials of their
// costs:
//
//   Z[i, j] = exp(-d / gamma) (Z[i-1, j] + Z[i, j-1] + Z[i-1, j-1])
//
// This takes one exponential a cell. R = d + softmin takes three and a logarithm. Z leaves the
// range of a double at once. So it is stored as mantissa 2^exponent: the mantissa is from 1 to 2,
// and the exponent is a whole number in a double.
#pragma once

#include <cstddef>

namespace curvewise::kernels {

// The exponent of zero: far below all others, and still finite.
inline constexpr double exponent_of_zero = -0x1p1000;

// Numbers on one anti-diagonal: of lane k at index k + 1, with the row above the strip at 0.
struct ScaledLanes {
    double* mantissas;
    double* exponents;
};

// The shares of a cell's three predecessors in their sum; backwards, in their place, these times
// the cell's own weight. Of lane k at index k + 1, with the row below the strip behind the last.
struct Shares {
    double* up;
    double* left;
    double* diagonal;
};

// Computes cells low..high of diagonal t from diagonals t - 1 and t - 2. `cost` has the squared
// distance of lane k at k, `scale` is log2(e) / gamma.
struct SoftStep {
    const double* cost;
    double scale;
    ScaledLanes before;
    ScaledLanes before_last;
    ScaledLanes current;
    Shares shares;  // for the kernel that writes them
};
using SoftForward = void (*)(const SoftStep& step, std::ptrdiff_t low,
                             std::ptrdiff_t high) noexcept;

// The weights of cells low..high of diagonal t, that is, the derivatives of the value by their
// costs, from the diagonals t + 1 and t + 2; and their contributions to the gradients. Coordinate c
// of lane k is p[c * p_stride + k] and q[c * q_stride + k]; its gradients have the same places.
struct SoftBackstep {
    Shares current;
    Shares next;
    Shares next_but_one;
    double* weights;  // room for one diagonal: of lane k at k
    const double* p;
    const double* q;
    double* by_p;
    double* by_q;
    std::ptrdiff_t p_stride;
    std::ptrdiff_t q_stride;
    std::ptrdiff_t dim;
};
using SoftBackward = void (*)(const SoftBackstep& step, std::ptrdiff_t low,
                              std::ptrdiff_t high) noexcept;

}  // namespace curvewise::kernels
