// The kernels for the processor family's baseline: SSE2 on x86-64, NEON on arm64.
#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "strip.hpp"

namespace curvewise::kernels {
namespace {
#include "sweep.inl.hpp"
#include "block.inl.hpp"
}  // namespace

const KernelSet baseline = {select_advance, select_fill, select_reach, select_values};

}  // namespace curvewise::kernels
