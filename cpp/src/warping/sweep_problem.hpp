// The problem to sweep: a table, the part of it to compute, and the places of the results.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "curvewise/block_distances.hpp"
#include "runtime/aligned_buffer.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/live_columns.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

// Long enough to amortise the ramps at both ends of a strip and the pass over the boundary row.
// Short enough that three diagonals and the strip's points stay in the first-level cache.
inline constexpr std::ptrdiff_t max_strip_height = 256;

// A row of the table, with the room that a sweep needs behind it.
class Row {
   public:
    Row() noexcept = default;
    Row(std::ptrdiff_t columns, double value) { assign(columns, value); }
    void assign(std::ptrdiff_t columns, double value);
    double* data() noexcept { return row_.data(); }
    const double* data() const noexcept { return row_.data(); }
    double operator[](std::ptrdiff_t j) const noexcept { return row_.data()[j]; }
    double& operator[](std::ptrdiff_t j) noexcept { return row_.data()[j]; }
    // The first column with the smallest value.
    std::ptrdiff_t argmin() const noexcept;

   private:
    std::ptrdiff_t columns_ = 0;
    AlignedBuffer row_;
};

// The memory that one thread needs to sweep, kept from one sweep to the next. If curves are short,
// a new allocation takes as long as a good part of the sweep. O(m).
struct SweepMemory {
    AlignedBuffer lanes;
    AlignedBuffer own_distances;  // of a strip
    Row row;

    // Memory for `count` columns, with any content. A few columns, as short curves have, need no
    // heap memory.
    std::ptrdiff_t* columns(std::size_t count) {
        if (count <= few_columns_.size()) return few_columns_.data();
        many_columns_.resize(count);
        return many_columns_.data();
    }

   private:
    std::array<std::ptrdiff_t, 64> few_columns_{};
    runtime::ScratchVector<std::ptrdiff_t> many_columns_;
};

struct SweepProblem {
    const kernels::KernelSet& kernels;
    PackedPair curves;
    kernels::Rule rule;
    kernels::Cost cost;
    double metric_parameter;
    LiveColumns columns;
    bool open_begin;
    std::ptrdiff_t workers;
    Poller& poller;
    SweepMemory& memory;
    // With fewer cells for each, starting threads costs more than they save: it takes up to a
    // millisecond until a second core is at work.
    std::ptrdiff_t cells_per_worker = std::ptrdiff_t{1} << 22;
    // In one thread, a sweep of the whole table ends where every path to its end is above this.
    double give_up_above = std::numeric_limits<double>::infinity();
    bool open_end = false;  // at any cell of the last row
    // In registers where that can be, as regions that are large enough are: for tests.
    bool is_always_resident = false;
    // Where the cost is the caller's own, in one thread.
    const BlockDistances* own = nullptr;
};

using Region = TableBlock;

Region whole_table(const PackedPair& curves) noexcept;
// The virtual row above the table, its first columns: 0 where a path may begin. Beyond the columns
// of the first row it stays infinite, as a row that reaches further right requires.
void assign_start(const SweepProblem& problem, std::ptrdiff_t columns, Row& row);

// Where the codes of a strip's predecessors begin in an array of all of them.
struct StripCodes {
    std::ptrdiff_t first_diagonal;
    std::ptrdiff_t offset;
};

// What a sweep writes besides its last row, each where not null.
struct Destination {
    double* table = nullptr;             // the region's cells, row by row
    std::uint8_t* codes = nullptr;       // predecessors, strip by strip as laid out by CodeLayout
    const StripCodes* layout = nullptr;  // one per strip
    double* origins = nullptr;           // per column, updated like the boundary row: for the
                                         // row above, then for the last row, the column at
                                         // which a cell's path leaves the row above the region
};

}  // namespace curvewise::warping
