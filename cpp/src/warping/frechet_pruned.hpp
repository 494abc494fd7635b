// The discrete Fréchet distance without most of its table, with bitwise identical results.
//
// A lower bound from nearest neighbours (nearest_point_bound.hpp) is often the distance itself. A
// recursion over blocks of the table (block_recursion.hpp) decides whether it is. If not, the bound
// is raised in steps until the last cell is reached. A second recursion, with the table's values,
// runs between the last bound that was too low and the first that was not. It gives the distance.
// The time is nearly linear for similar curves, the memory O(n + m).
//
// If the curves are not similar, a coarse table shows it early, and the result is nullopt: the full
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

// The last value of the Fréchet table, or infinity if it is above the cutoff. Returns nullopt if
// the ground distance has no bounds, or if the search gives up; no work is then counted. Uses only
// the problem's curves, its ground distance, its kernels and its poller. Throws Stopped if the
// poller stops the call.
std::optional<double> frechet_pruned(const SweepProblem& problem, const PruningOptions& options,
                                     PruningRecord& record);

}  // namespace curvewise::warping
