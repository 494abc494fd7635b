// The cumulative table of DTW or Fréchet, or a rectangle of it, swept strip by strip (see
// kernels/strip.hpp). Only the row below the last strip is kept, O(m) memory, and what the caller
// asks for besides. Strips may be shared out among threads: each waits, a chunk of columns at a
// time, for the one above it. The number of threads changes no value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "aligned_buffer.hpp"
#include "band.hpp"
#include "curvewise/ground_distance.hpp"
#include "kernels/strip.hpp"
#include "packed_curve.hpp"
#include "watch.hpp"

namespace curvewise::detail {

struct SweepMemory;

struct SweepProblem {
    const kernels::KernelSet& kernels;
    PackedPair curves;
    kernels::Recurrence recurrence;
    kernels::Cost cost;
    double minkowski_p;
    Band band;
    bool open_begin;
    std::ptrdiff_t workers;
    Watch& watch;
    SweepMemory& memory;
    // With fewer cells for each, starting threads costs more than they save: it takes up to a
    // millisecond until a second core is at work.
    std::ptrdiff_t cells_per_worker = std::ptrdiff_t{1} << 22;
    // In one thread, a sweep of the whole table ends where all values of a row are above this.
    double give_up_above = std::numeric_limits<double>::infinity();
};

// Throws std::invalid_argument for an order of minkowski outside [1, inf].
void check_ground_distance(const GroundDistance& ground);

// The metric to compute: orders 1, 2 and inf of minkowski by their own names, and everything but
// sqeuclidean as |difference| in one dimension.
kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept;

// A part of the table: rows and columns, by their first and their number.
struct Region {
    std::ptrdiff_t first_row;
    std::ptrdiff_t rows;
    std::ptrdiff_t first_column;
    std::ptrdiff_t columns;
};

Region whole_table(const PackedPair& curves) noexcept;

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

// What one thread needs to sweep, kept from one sweep to the next: where curves are short, getting
// it anew takes as long as a good part of the sweep. O(m).
struct SweepMemory {
    AlignedBuffer lanes;
    std::vector<std::ptrdiff_t> columns;
    Row row;
};

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

// Sweeps a region. `boundary` is the row above it on the way in and its last row on the way out.
// `starts_here`: boundary[0] is the 0 that starts every path, not a cell of the table. Throws
// Stopped where the watch says so.
void sweep(const SweepProblem& problem, const Region& region, bool starts_here, double* boundary,
           const Destination& destination);

// The height of the strips that a sweep with `codes` cuts a region into, and where each begins.
struct CodeLayout {
    CodeLayout(const SweepProblem& problem, const Region& region);
    std::ptrdiff_t height;
    std::ptrdiff_t size = 0;  // of all codes, in bytes
    std::vector<StripCodes> strips;
};

// The whole table's last row; after giving up, values of which each is above `give_up_above`.
// It stands in the problem's memory until the next sweep.
const Row& last_row(const SweepProblem& problem);

// What the table would hold in a cell if its path began there: its ground distance.
double lone_cell(const SweepProblem& problem, std::ptrdiff_t row, std::ptrdiff_t column);

// The whole table, row by row; infinity outside the band.
void sweep_table(const SweepProblem& problem, double* table);

}  // namespace curvewise::detail
