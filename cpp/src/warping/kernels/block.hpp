// What the pruned Fréchet distance asks of an instruction-set level: a small block of the table,
// entered from two sides and left on the two others. As for strips, pointers and sizes only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace curvewise::kernels {

// The longest side of a block: a row of reached cells fits a word.
inline constexpr std::ptrdiff_t block_side = 64;

// Which cells of a block can be reached over cells whose ground distance is at most `threshold`.
// Column i is a point of the curve that is stored in order, row j one of the other. Both curves
// are padded as for a strip.
struct ReachBlock {
    // Coordinate c of column i is across[c * across_stride + i]; of row j,
    // down[c * down_stride + j * down_step].
    const double* across;
    const double* down;
    std::ptrdiff_t across_stride;
    std::ptrdiff_t down_stride;
    std::ptrdiff_t down_step;
    std::ptrdiff_t dim;
    std::ptrdiff_t columns;
    std::ptrdiff_t rows;
    double threshold;

    // Bit i of `above`: whether the cell above column i has been reached; bit j of `beside`:
    // the one before row j; `corner`: the one before and above all. On the way out, the last row
    // and the last column.
    std::uint64_t above;
    std::uint64_t beside;
    bool corner;
    // Whether any cell of the block has been reached; set on the way out.
    bool is_reached;
};

// The values of a block of the table, max(d, min(up, left, diagonal)). Row k is a point of the
// curve that is stored in order, column j one of the curve that is stored in reverse.
struct ValueBlock {
    // Coordinate c of row k is p[c * p_stride + k]; of column j, q[c * q_stride - j].
    const double* p;
    const double* q;
    std::ptrdiff_t p_stride;
    std::ptrdiff_t q_stride;
    std::ptrdiff_t dim;
    std::ptrdiff_t rows;
    std::ptrdiff_t columns;

    // Before the call: the values above every column and before every row. After it: the values of
    // the last row and the last column.
    double* above;
    double* beside;
    double corner;
};

using ReachFunction = void (*)(ReachBlock& block) noexcept;
using ValueFunction = void (*)(const ValueBlock& block) noexcept;

}  // namespace curvewise::kernels
