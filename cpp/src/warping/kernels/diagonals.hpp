// What the matrix profile asks of an instruction-set level: the products of windows along some
// diagonals of the table of all pairs. As for strips, pointers and sizes only.
#pragma once

#include <cstddef>

namespace curvewise::kernels {

// The diagonals that are processed together, for each lane of a SIMD vector.
inline constexpr std::ptrdiff_t diagonals_a_lane = 4;

// Window i is compared with the windows i + offset, i + offset + 1, ... of as many diagonals as are
// processed together. All arrays have room for as many windows behind the last.
struct Diagonals {
    // At [c * stride + i], of coordinate c of window i. A product changes from windows i - 1 and
    // j - 1 to windows i and j by halves[i] * sums[j] + halves[j] * sums[i].
    const double* halves;
    const double* sums;
    const double* scales;  // 1 / deviation, or 0
    std::ptrdiff_t stride;
    std::ptrdiff_t dim;
    // Of window i: what is subtracted from the score of a pair, and the least score of interest.
    const double* sizes;
    const double* limits;
    std::ptrdiff_t offset;
    // The products of the row before, by coordinate and diagonal; those of the row that is returned
    // afterwards. And what they may be too small by, for each coordinate.
    double* products;
    const double* slacks;
};

// The first row from `row` on with a pair whose score may reach a limit of its windows, or `end`.
using DiagonalFunction = std::ptrdiff_t (*)(const Diagonals& diagonals, std::ptrdiff_t row,
                                            std::ptrdiff_t end) noexcept;

}  // namespace curvewise::kernels
