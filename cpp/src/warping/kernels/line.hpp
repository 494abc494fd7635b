// The function that a search needs from an instruction-set level: the value of DTW (symmetric1) of
// two curves in one dimension, without the pruned cells. As for strips, only pointers and sizes
// cross the boundary.
#pragma once

#include <cstddef>

namespace curvewise::kernels {

// The most rows that are swept side by side, each a column behind the one above it.
inline constexpr std::ptrdiff_t max_line_height = 16;

struct Line {
    // Row i is p[i], column j is q[columns - 1 - j]; q has so much room before it and behind it.
    const double* p;
    const double* q;
    std::ptrdiff_t rows;
    std::ptrdiff_t columns;
    // Row i may hold columns first_step[i] - k to last_step[i] - k, where k is i % the level's
    // line_height. Both never fall from row to row. The arrays have that much padding behind them.
    const double* first_step;
    const double* last_step;
    // The bounds that prune cells, see CostToGo.
    double most;
    double slack;
    const double* after_row;
    const double* after_column;
    bool they_add;
    // Room for a row, with so much before it and behind it.
    double* row;
};

// The last value, or infinity if the last cell is pruned.
using LineFunction = double (*)(const Line& line) noexcept;

}  // namespace curvewise::kernels
