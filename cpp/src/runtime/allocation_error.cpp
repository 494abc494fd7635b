#include "runtime/allocation_error.hpp"

#include <cstdio>

namespace curvewise::runtime {

AllocationError::AllocationError(const std::string& what_for, double bytes) {
    char size[32];
    std::snprintf(size, sizeof size, "%.3g GiB", bytes / (1024.0 * 1024.0 * 1024.0));
    message_ = "no memory for " + what_for + ", " + size;
}

}  // namespace curvewise::runtime
