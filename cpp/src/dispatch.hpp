// Which kernels this process uses.
#pragma once

#include "kernels/strip.hpp"

namespace curvewise::detail {

const kernels::KernelSet& active_kernels() noexcept;

}  // namespace curvewise::detail
