#include "warping/window.hpp"

#include <stdexcept>
#include <string>

#include "curves/checks.hpp"

namespace curvewise::warping {

void Window::check() const {
    if (radius && fraction) {
        throw std::invalid_argument("window and window_fraction are both given; give one of them");
    }
    if (radius) curves::check_whole_number("window", *radius, window_range);
    if (fraction && !(*fraction > 0.0 && *fraction < 1.0)) {
        throw std::invalid_argument("window is " + std::to_string(*fraction) + "; " +
                                    window_range.advice);
    }
}

void Window::check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const {
    if (between(n, m) == 0 && n != m && n > 1 && m > 1) {
        throw std::invalid_argument("window=0 admits no path between " + std::to_string(n) +
                                    " and " + std::to_string(m) + " points; use at least 1");
    }
}

}  // namespace curvewise::warping
