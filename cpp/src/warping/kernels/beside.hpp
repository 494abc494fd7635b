// The function that a batch needs from an instruction-set level: DTW or Fréchet of one curve with
// several others at once, each in a lane of the SIMD vectors. As for strips, only pointers and
// sizes cross the boundary.
#pragma once

#include <cstddef>

namespace curvewise::kernels {

// The SIMD vectors that are swept beside each other: a cell waits for the one to its left, and the
// others fill that time.
inline constexpr std::ptrdiff_t most_packs_beside = 4;

struct Beside {
    // Coordinate c of row i is p[c * p_stride + i]; of column j in lane l, q[(j * dim + c) * stride
    // + l]. A number of columns that only some lanes have does no harm to those with fewer.
    const double* p;
    std::ptrdiff_t p_stride;
    const double* q;
    std::ptrdiff_t stride;
    std::ptrdiff_t rows;
    // Row i holds columns first_column[i]..last_column[i]; both never fall from row to row.
    const std::ptrdiff_t* first_column;
    const std::ptrdiff_t* last_column;
    std::ptrdiff_t packs;  // to sweep, at most most_packs_beside
    // Becomes the last row of the table: column j of lane l at row[j * stride + l].
    double* row;
};

using BesideFunction = void (*)(const Beside& beside) noexcept;

}  // namespace curvewise::kernels
