// The table of a recurrence with any steps, swept by strips of rows: the value, the table, and a
// path. For a path, the rows are halved until the steps of all cells of a part fit into a limited
// memory. This is Hirschberg's division, but only forward, so that every cell is bitwise identical.
// A part is swept up to its middle row. Then the path through the lower half is found, which gives
// the column where it leaves the upper half. Then the path through the upper half is found, whose
// columns are swept only up to there. A value takes O(n m) terms. A path takes at most 1 + log2(n m
// / (2^22 + 16 (n + m))) / 2 times that. Memory is O(n + m), and O((n + m) log n) for a path.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "curves/range_scale.hpp"
#include "curvewise/recurrence.hpp"
#include "runtime/aligned_buffer.hpp"
#include "runtime/scratch.hpp"
#include "warping/band.hpp"
#include "warping/packed_curve.hpp"
#include "warping/path.hpp"
#include "warping/step_table.hpp"

namespace curvewise::warping {

// The divisor of a value, for curves of n and m points.
double divisor(Per per, std::ptrdiff_t n, std::ptrdiff_t m) noexcept;

// What one thread keeps from one pair to the next.
struct RecurrenceMemory {
    AlignedBuffer lanes;
    AlignedBuffer costs;          // of rows, columns and differences
    AlignedBuffer own_distances;  // of a strip
    runtime::ScratchVector<std::ptrdiff_t> columns;
};

// The problem to sweep: the curves as the recurrence takes them, in units of a range.
struct RecurrenceProblem {
    const Recurrence& recurrence;
    const StepTable& steps;
    PackedPair curves;
    const RangeScale& range;
    double threshold;  // in units of the range
};

class RecurrenceSweep {
   public:
    // One coordinate of the curves where `coordinate` is not negative.
    RecurrenceSweep(const RecurrenceProblem& problem, std::ptrdiff_t coordinate, Poller& poller,
                    RecurrenceMemory& memory);

    // The cell in which the cheapest path ends, and its value.
    struct End {
        double value;
        std::ptrdiff_t row;
        std::ptrdiff_t column;
    };

    // An end with the value infinity if all paths are above `give_up`.
    End end(double give_up);
    void write_table(double* out);
    // The cells of a path to there from where it begins.
    IndexPairs path(const End& end);

   private:
    struct Codes;
    struct Cell {
        std::ptrdiff_t row;
        std::ptrdiff_t column;
    };
    // Rows first..end - 1 in `columns` columns.
    struct Part {
        std::ptrdiff_t first;
        std::ptrdiff_t end;
        std::ptrdiff_t columns;
    };
    using Rows = runtime::ScratchVector<double>;

    void prepare_costs(const RangeScale& range);
    void prepare_gaps(double gap, double* rows, double* columns);
    void prepare_offsets(int odd, double* offsets) const;
    ColumnRange columns_of(std::ptrdiff_t row) const noexcept;
    Rows first_boundary() const;
    End cheapest_end(const double* last_row, const Rows& last_column) const;
    void sweep(const Part& part, double* boundary, std::ptrdiff_t stride, Codes* codes,
               double* table, double give_up);
    void aim(kernels::RecurrenceStrip& strip, const Part& part, std::ptrdiff_t first,
             std::ptrdiff_t rows);
    void ask_for_distances(kernels::Strip& ground, std::ptrdiff_t first);
    void run(kernels::RecurrenceStrip& strip, const Part& part);
    bool is_hopeless(const double* boundary, std::ptrdiff_t stride, double give_up) const noexcept;
    Cell find(std::ptrdiff_t first, const Rows& boundary, Cell end);
    Cell trace(std::ptrdiff_t first, const Rows& boundary, Cell end);

    const Recurrence& recurrence_;
    const StepTable& table_;
    PackedPair curves_;
    kernels::AdvanceRecurrence advance_;
    kernels::CostFunction fill_;
    kernels::RecurrenceStrip whole_{};  // the common data of all strips
    Band band_;
    Poller& poller_;
    RecurrenceMemory& memory_;
    std::ptrdiff_t height_;  // of strips
    bool is_counting_ = true;
    double sum_of_row_gaps_ = 0.0;
    double sum_of_column_gaps_ = 0.0;
    double* left_border_ = nullptr;  // of the row `reach` above the first, and so on
    double reentry_;                 // the least of it
    double* ends_ = nullptr;         // the cell of each row in the last column, if requested
    IndexPairs found_;               // backwards
};

}  // namespace curvewise::warping
