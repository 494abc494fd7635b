// DTW without most of its table, with bitwise identical results.
//
// An upper bound of the distance is the value of some path. Both curves are decimated, and their
// best path is found, by this same search if they are still long. Then the table is swept within a
// narrow corridor around that path. A lower bound of the cost of the rest of a path is the sum over
// each row, and over each column, that follows: at least its smallest ground distance
// (least_distances.hpp). If every path from a cell costs more than the upper bound, the cell is
// pruned, and the sweep skips it (strip_narrower.hpp). For similar curves, 3 to 6 % of the table
// remains. The time is still O(n m), the memory O(n + m).
//
// Results are bitwise identical. The upper bound is summed in the table's own operations, so it is
// not below the table's value. All cells that a path of that value visits are active. Pruned cells
// do not change a minimum on it.
//
// If curves are not similar, nothing can be pruned. The decimated curves show that early; then the
// search returns nullopt, and the full sweep is faster. It also returns nullopt if a path may begin
// anywhere, which leaves no corridor, and for orders of minkowski that have no bounds.
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
    // The next coarser level keeps one point in `decimation`; a coarse table of up to
    // `most_coarse_cells` cells is swept as a whole.
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

// The same with the path; nullopt if the value is above the cutoff.
std::optional<Path> dtw_path_pruned(const SweepProblem& problem, const DtwPruningOptions& options,
                                    DtwPruningRecord& record);

}  // namespace curvewise::warping
