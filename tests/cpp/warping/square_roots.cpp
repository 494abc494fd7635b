// Compiled once per instruction-set level, as the kernels are; SQUARE_ROOTS names the result.
#include "square_roots.hpp"

#include <Eigen/Core>

#include "warping/kernels/strip.hpp"

namespace {

using curvewise::kernels::padding;

#include "warping/kernels/square_root.inl.hpp"

void square_roots(const double* x, double* y, std::ptrdiff_t n) noexcept {
    for (std::ptrdiff_t i = 0; i < n; i += width) store(y + i, FastRoot::of(load(x + i)));
}

}  // namespace

const test::SquareRoots test::SQUARE_ROOTS = square_roots;
