// DTW without most of its table, exact to the bit.
//
// An upper bound of the distance is the value of some path: both curves are decimated, their best
// path found (by this same search, where they are still long), and the table swept within a narrow
// corridor around it. A lower bound of what the rest of a path costs is what each row, and each
// column, that is still to come costs at least: its smallest ground distance, or less
// (least_distances.hpp). Cells from which every path costs more than the upper bound are dead, and
// the sweep leaves them out as it goes (strip_narrower.hpp). Curves that are alike leave 3 to 6 %
// of the table: time O(n m) still, and O(n + m) memory.
//
// The bits stay: the upper bound is summed in the table's own operations, and so is not below the
// table's value; what a path of that value visits is live. Dead cells that are left out change no
// minimum on it.
//
// Curves that are not alike leave all of their table. The decimated curves say so early; nothing
// is returned then, and the full sweep is the faster way. Nor is anything returned where a path
// may begin anywhere, which leaves no corridor, and for orders of minkowski that have no bounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "warping/path.hpp"
#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

struct DtwPruningOptions {
    // A value above it comes back as infinity.
    double cutoff = std::numeric_limits<double>::infinity();
    bool open_end = false;
    // Whether to return nothing where the full sweep is expected to be as fast.
    bool gives_up = true;
    // One point in so many is left at the next coarser level; up to so many cells, a coarse table
    // is swept as a whole.
    std::ptrdiff_t decimation = 24;
    std::ptrdiff_t most_coarse_cells = std::ptrdiff_t{1} << 18;
};

struct DtwPruningRecord {
    double lower = 0.0;
    double upper = std::numeric_limits<double>::infinity();
    std::int64_t swept_cells = 0;     // of the table
    std::int64_t corridor_cells = 0;  // of the table, for the upper bound
    double path_seconds = 0.0;        // of the decimated curves
    double upper_seconds = 0.0;
    double lower_seconds = 0.0;
    double sweep_seconds = 0.0;
};

// The value of the best path (see `open_end`). Throws Stopped where the poller says so. Counts all
// of the table as done, or nothing where it returns nothing.
std::optional<double> dtw_pruned(const SweepProblem& problem, const DtwPruningOptions& options,
                                 DtwPruningRecord& record);

// The same with the path. There is none where the value is above the cutoff.
std::optional<Path> dtw_path_pruned(const SweepProblem& problem, const DtwPruningOptions& options,
                                    DtwPruningRecord& record);

}  // namespace curvewise::warping
