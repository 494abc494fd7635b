// The path behind a distance, in linear memory: divide and conquer over rows, forward only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

using IndexPairs = runtime::ScratchVector<std::array<std::int64_t, 2>>;

struct Path {
    double value;  // of the last cell
    IndexPairs pairs;
};

// The path that ends in the last row in the last column or, with an open end, in the first one
// with the smallest value. Regions of up to `max_codes` cells are swept with a byte for each.
Path find_path(const SweepProblem& problem, bool open_end,
               std::ptrdiff_t max_codes = std::ptrdiff_t{1} << 24);

}  // namespace curvewise::warping
