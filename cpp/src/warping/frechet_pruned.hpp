// The discrete Fréchet distance without most of its table (see block_recursion.hpp), exact to the
// bit.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "kernels/strip.hpp"
#include "packed_curve.hpp"
#include "warping/block_recursion.hpp"
#include "watch.hpp"

namespace curvewise::detail {

struct FrechetRecord {
    double lower = 0.0;
    double upper = std::numeric_limits<double>::infinity();
    BlockCounts counts;
    int tries = 0;
    double tree_seconds = 0.0;
    double bound_seconds = 0.0;
    double search_seconds = 0.0;
};

// The last value of the table of `cost`, or infinity where it is above `cutoff`.
double frechet_pruned(const kernels::KernelSet& kernels, const PackedPair& curves,
                      kernels::Cost cost, double cutoff, Watch& watch, FrechetRecord& record);

}  // namespace curvewise::detail
