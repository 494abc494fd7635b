// The cumulative table of DTW or Fréchet, or a rectangle of it, swept strip by strip (see
// kernels/strip.hpp). Only the row below the last strip is kept, O(m) memory, and the further
// outputs that the caller requests. Threads may share strips: each waits, a chunk of columns at a
// time, for the strip above. The number of threads changes no value.
#pragma once

#include <cstddef>

#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

// Sweeps a region. `boundary` is the row above it on the way in and its last row on the way out.
// `starts_here`: boundary[0] is the 0 that starts every path, not a cell of the table. Throws
// Stopped where the poller says so.
void sweep(const SweepProblem& problem, const Region& region, bool starts_here, double* boundary,
           const Destination& destination);

// The whole table's last row; after giving up, values that are all above `give_up_above`. The row
// is in the problem's memory until the next sweep.
const Row& last_row(const SweepProblem& problem);

// What the table would hold in a cell if its path began there: its ground distance.
double lone_cell(const SweepProblem& problem, std::ptrdiff_t row, std::ptrdiff_t column);

// The whole table, row by row; infinity outside the band.
void sweep_table(const SweepProblem& problem, double* table);

}  // namespace curvewise::warping
