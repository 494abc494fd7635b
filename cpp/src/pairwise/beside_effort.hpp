// The cost of pairs that are computed several at a time.
#pragma once

namespace curvewise::pairwise {

// Of one pair, in cells of a table of one coordinate.
struct BesideEffort {
    double value = 0.0;
    double bound = 0.0;
    double candidate = 0.0;  // a value after a bound, of pairs that are not neighbours
    bool is_large = false;   // the value takes longer than all bounds of a pair by itself
    bool is_wide = false;    // one by one is faster if most pairs can be given up early

    // Bounds pay if at most this share of the pairs are candidates.
    double most_candidates() const noexcept { return 0.9 * (value - bound) / candidate; }
};

}  // namespace curvewise::pairwise
