// The discrete Fréchet distance without most of its table, exact to the bit.
//
// A lower bound from nearest neighbours (hausdorff.hpp) is often the distance itself. Whether it
// is, is decided by a recursion over blocks of the table (block_recursion.hpp), and if not, the
// bound is raised in steps until the last cell is reached; a second recursion, with the table's
// values, between the last bound that was too low and the first that was not, gives the distance.
// Time nearly linear where the curves are alike, memory O(n + m).
//
// Where the curves are not alike, a coarse table says so early, and nothing is returned: the full
// sweep is then as fast or faster.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "runtime/poller.hpp"
#include "warping/block_recursion.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::detail {

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

enum class Persistence { while_it_pays, to_the_end };

// The last value of the Fréchet table over `metric`, or infinity where it is above `cutoff`.
// Nothing where the ground distance has no bounds or, unless told to go to the end, where the full
// sweep is expected to be faster. Throws Stopped where the poller says so.
std::optional<double> frechet_pruned(const kernels::KernelSet& kernels, const PackedPair& curves,
                                     Metric metric, double cutoff, Poller& poller,
                                     PruningRecord& record,
                                     Persistence persistence = Persistence::while_it_pays);

}  // namespace curvewise::detail
