// Targets that a search skips.
#pragma once

#include <cstddef>

namespace curvewise::nearest {

// From the first to the last; empty by default.
struct LeftOut {
    std::ptrdiff_t first = 0;
    std::ptrdiff_t last = -1;

    bool has(std::ptrdiff_t target) const noexcept { return target >= first && target <= last; }
};

}  // namespace curvewise::nearest
