#include "dispatch.hpp"

namespace curvewise::detail {

const kernels::KernelSet& active_kernels() noexcept { return kernels::baseline; }

}  // namespace curvewise::detail
