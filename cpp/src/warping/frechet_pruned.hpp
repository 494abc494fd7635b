// The discrete Fréchet distance without most of its table, exact to the bit.
//
// A lower bound from nearest neighbours (nearest_point_bound.hpp) is often the distance itself.
// Whether it is, is decided by a recursion over blocks of the table (block_recursion.hpp), and if
// not, the bound is raised in steps until the last cell is reached; a second recursion, with the
// table's values, between the last bound that was too low and the first that was not, gives the
// distance. Time nearly linear where the curves are alike, memory O(n + m).
//
// Where the curves are not alike, a coarse table says so early, and nothing is returned: the full
// sweep is then as fast or faster.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

// What a search has done, in the unit of the table (squares for the Euclidean distance).
struct PruningRecord {
    double lower = 0.0;
    double upper = std::numeric_limits<double>::infinity();
    std::int64_t blocks = 0;
    std::int64_t swept_cells = 0;
    int reach_passes = 0;
    int value_passes = 0;
    double bound_seconds = 0.0;  // trees, coarse table, both bounds
    double search_seconds = 0.0;
};

struct PruningOptions {
    // A value above it may come back as infinity.
    double cutoff = std::numeric_limits<double>::infinity();
    // Whether to go on where the full sweep is expected to be faster.
    bool gives_up = true;
    // What the whole search counts as, for the poller.
    std::int64_t steps = 0;
};

// The last value of the Fréchet table, or infinity where it is above the cutoff. Nothing where the
// ground distance has no bounds, or where it gives up; nothing is then counted. Looks at the
// problem's curves, its ground distance, its kernels and its poller only. Throws Stopped where
// the poller says so.
std::optional<double> frechet_pruned(const SweepProblem& problem, const PruningOptions& options,
                                     PruningRecord& record);

}  // namespace curvewise::warping
