// The window of warping paths, as options give it: a radius, or a fraction of the longer curve.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

namespace curvewise::warping {

struct Window {
    std::optional<std::ptrdiff_t> radius;
    std::optional<double> fraction;

    std::optional<std::ptrdiff_t> between(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept {
        if (!fraction) return radius;
        return static_cast<std::ptrdiff_t>(*fraction * static_cast<double>(std::max(n, m)));
    }
    // Throws std::invalid_argument where it is out of range, and where it admits no path.
    void check() const;
    void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const;
};

}  // namespace curvewise::warping
