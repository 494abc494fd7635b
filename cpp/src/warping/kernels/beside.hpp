// The functions that a batch needs from an instruction-set level: DTW or Fréchet of several pairs
// at once, each in a lane of the SIMD vectors, and their lower bounds. As for strips, only pointers
// and sizes cross the boundary.
#pragma once

#include <cstddef>

namespace curvewise::kernels {

// The SIMD vectors that are swept beside each other: a cell waits for the one to its left, and the
// others fill that time.
inline constexpr std::ptrdiff_t most_packs_beside = 4;

// The most coordinates of curves that there are functions for.
inline constexpr std::ptrdiff_t most_dim_beside = 8;

struct Beside {
    // Coordinate c of row i is p[c * p_stride + i], for one curve in all lanes, or as for columns;
    // of column j in lane l, q[(j * dim + c) * stride + l]. A number of columns that only some
    // lanes have does no harm to those with fewer.
    const double* p;
    std::ptrdiff_t p_stride;
    const double* q;
    std::ptrdiff_t stride;
    int dim;
    std::ptrdiff_t rows;
    // Row i holds columns first_column[i]..last_column[i]; both never fall from row to row.
    const std::ptrdiff_t* first_column;
    const std::ptrdiff_t* last_column;
    std::ptrdiff_t packs;  // to sweep, at most most_packs_beside
    // Becomes the last row of the table: column j of lane l at row[j * stride + l].
    double* row;
};

using BesideFunction = void (*)(const Beside& beside) noexcept;

// Lower bounds of one curve with each of the others: the distances of columns to the boxes of the
// rows that they may be matched to, added up, or the largest. The first column has the first row
// alone, and with `has_last` the last column the last row.
struct BoundsBeside {
    const double* p;
    std::ptrdiff_t p_stride;
    const double* q;
    std::ptrdiff_t stride;
    int dim;
    std::ptrdiff_t rows;
    std::ptrdiff_t columns;  // at least 2
    bool has_last;
    // Coordinate c of the box of column j is low[c][-j] to high[c][-j].
    const double* low[most_dim_beside];
    const double* high[most_dim_beside];
    std::ptrdiff_t packs;
    double most;     // where the bounds of all lanes of a SIMD vector are above it, they end
    double* bounds;  // of lane l at [l]
};

using BoundsBesideFunction = void (*)(const BoundsBeside& beside) noexcept;

// Null for what is swept one by one.
struct BesideKernels {
    BesideFunction sweep = nullptr;        // one curve in all lanes of P
    BesideFunction sweep_pairs = nullptr;  // a curve in each lane of P; most_packs_beside packs
    BoundsBesideFunction bounds = nullptr;
};

}  // namespace curvewise::kernels
