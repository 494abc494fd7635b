// The functions that a recurrence with any steps needs from an instruction-set level. As for the
// strips of dtw and frechet (strip.hpp), only pointers and sizes cross the boundary. The table is
// filled by strips of rows and, within a strip, by anti-diagonals.
//
// A step reaches back at most `reach` rows or columns. The first lanes of a strip are that many
// rows of the strip above, and its last rows are its output. On diagonal t, lane k is row k - reach
// of the strip and column t - k.
#pragma once

#include "strip.hpp"

namespace curvewise::kernels {

inline constexpr int max_reach = 8;
inline constexpr int max_steps = 64;
inline constexpr int max_terms = 256;
inline constexpr int start_code = 255;  // of a cell in which the path begins, in place of a step

enum class Source : std::uint8_t { pair, row_gap, column_gap, offset, row_move, column_move };
enum class PairRule : std::uint8_t { distance, apart, together, weighted };

struct LaneTerm {
    Source source;
    int diagonals_back;
    int rows_back;
    double weight;
};

struct LaneStep {
    int diagonals_back;
    int rows_back;
    double constant;
    int end_term;  // its terms end before this one, and begin at the end of the last step's terms
};

struct RecurrenceStrip {
    // The points, and where their distances go: its first lane is the first that is a row of P.
    Strip ground;
    const LaneStep* steps;
    std::ptrdiff_t step_count;
    const LaneTerm* terms;
    PairRule rule;
    double threshold;
    std::ptrdiff_t reach;
    std::ptrdiff_t lanes;  // lanes of the rows above, and of the strip's own rows
    std::ptrdiff_t columns;
    // Lane k may hold columns first_column[k]..last_column[k]; both never fall.
    const std::ptrdiff_t* first_column;
    const std::ptrdiff_t* last_column;

    // Row r of the `reach` rows above, on the way in, and of the last ones, on the way out, is at
    // boundary[r * boundary_stride].
    double* boundary;
    std::ptrdiff_t boundary_stride;
    const double* left_border;  // of each lane the cell before column 0; null: infinity
    // The number of cells of the strip's first row, and of its first column, in which a path may
    // begin.
    std::ptrdiff_t start_columns;
    std::ptrdiff_t start_rows;
    double* ends;  // of each lane the cell in the last column, where not null

    // The diagonals of values and of costs, the last one first.
    double* values[2 * max_reach + 1];
    double* pairs[2 * max_reach + 1];
    std::ptrdiff_t value_count;
    std::ptrdiff_t pair_count;

    // If steps need them: gaps and moves of lane k's row, and of column j at [columns - 1 - j]; a
    // buffer for the moves of a diagonal. |i - j|, or the weights by it, for odd and even
    // differences, at [(i - j) / 2] rounded down; the difference in lane 0 of diagonal 0.
    const double* row_gaps;
    const double* column_gaps;
    const double* row_steps;
    const double* column_steps;
    double* row_moves;
    double* column_moves;
    const double* offsets[2];
    std::ptrdiff_t first_offset;

    // The state between two calls.
    std::ptrdiff_t next_diagonal;
    std::ptrdiff_t low_lane;
    std::ptrdiff_t high_lane;

    // If requested: the step of lane k on diagonal t, at codes[t * code_stride + k], with a buffer
    // for one diagonal. The cell of lane k and column j, at table[k * table_stride + j].
    std::uint8_t* codes;
    std::ptrdiff_t code_stride;
    double* code_lanes;
    double* table;
    std::ptrdiff_t table_stride;
};

// Sweeps the diagonals from strip.next_diagonal to `end`, which is not swept.
using AdvanceRecurrence = void (*)(RecurrenceStrip& strip, std::ptrdiff_t end,
                                   CostFunction fill) noexcept;

// What one instruction-set level offers.
struct RecurrenceKernels {
    // The sweep that is compiled for these steps, or the general one.
    AdvanceRecurrence (*advance)(const LaneStep* steps, std::ptrdiff_t step_count,
                                 const LaneTerm* terms) noexcept;
    // `rows`: of a strip, at most.
    CostFunction (*fill)(Cost cost, std::ptrdiff_t dim, std::ptrdiff_t rows) noexcept;
};

namespace recurrences {
extern const RecurrenceKernels baseline;
#ifdef CURVEWISE_X86_64_LEVELS
extern const RecurrenceKernels v3;
extern const RecurrenceKernels v4;
#endif
}  // namespace recurrences

}  // namespace curvewise::kernels
