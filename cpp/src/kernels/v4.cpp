// The kernels for x86-64-v4: AVX-512.
#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "strip.hpp"

namespace curvewise::kernels {
namespace {
#include "sweep.inl.hpp"
#include "block.inl.hpp"
}  // namespace

const KernelSet v4 = {select_advance, select_fill, select_reach, select_values};

}  // namespace curvewise::kernels
