// The kernels for the processor's baseline instruction set (x86-64-v2 is not assumed: SSE2; NEON
// on arm64).
#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "strip.hpp"

namespace curvewise::kernels {
namespace {
#include "ground_distance.inl.hpp"
#include "sweep.inl.hpp"
}  // namespace

const KernelSet baseline = {select_advance, select_fill};

}  // namespace curvewise::kernels
