/// \file
/// A custom ground distance for dtw and frechet. It computes some rows of the table at a time:
///
///     const curvewise::BlockDistances own = [&](const curvewise::TableBlock& block, double* out) {
///         for (std::ptrdiff_t i = 0; i < block.rows; ++i)
///             for (std::ptrdiff_t j = 0; j < block.columns; ++j)
///                 *out++ = matrix[block.first_row + i][block.first_column + j];
///     };
///     options.ground.own = &own;
#pragma once

#include <cstddef>
#include <functional>

namespace curvewise {

/// A part of the table of all pairs of points. Its rows are points of P, its columns points of Q.
struct TableBlock {
    std::ptrdiff_t first_row;
    std::ptrdiff_t rows;
    std::ptrdiff_t first_column;
    std::ptrdiff_t columns;
};

/// Writes the distances of a block's pairs, each at least 0 or infinity, to `out`, row by row. The
/// thread that made the call calls it, for blocks of at most 264 rows with about 2^21 pairs, or of
/// one row. For a path, the same pair may be requested more than once. Exceptions pass through.
struct BlockDistances : std::function<void(const TableBlock& block, double* out)> {
    using function::function;
};

}  // namespace curvewise
