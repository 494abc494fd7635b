/// \file
/// How this library was built, and its instruction-set level on this machine. The kernels are
/// compiled once for each level. The first call of the process chooses the highest level that the
/// processor has, or the one that the environment variable CURVEWISE_ISA names ("baseline", "v3",
/// "v4"). If the machine does not have that level, every call throws std::runtime_error. The level
/// never changes a result.
///
///     std::puts(curvewise::build_info().active.c_str());   // v4
#pragma once

#include <string>
#include <vector>

#include "curvewise/export.h"

namespace curvewise {

/// The result of build_info().
struct BuildInfo {
    std::string version;
    std::string compiler;
    std::string eigen;
    std::vector<std::string> instruction_sets;  ///< levels that the machine has, the slowest first
    std::string active;                         ///< the one in use
};

/// Returns how the library was built, and its instruction-set level on this machine.
[[nodiscard]] CURVEWISE_EXPORT BuildInfo build_info();

}  // namespace curvewise
