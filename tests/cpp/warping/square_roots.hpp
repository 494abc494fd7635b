// The square roots of the kernels, one array function per instruction-set level.
#pragma once

#include <cstddef>

namespace test {

// y[i] = FastRoot of x[i], for n a multiple of 8.
using SquareRoots = void (*)(const double* x, double* y, std::ptrdiff_t n) noexcept;

extern const SquareRoots square_roots_baseline;
#ifdef CURVEWISE_X86_64_LEVELS
extern const SquareRoots square_roots_v3;
extern const SquareRoots square_roots_v4;
#endif

}  // namespace test
