/// \file
/// How this library was built, and what it uses on this machine. The kernels are compiled once per
/// instruction-set level, and the first call of the process chooses the highest one that the
/// processor has, or the one that the environment variable CURVEWISE_ISA names ("baseline", "v3",
/// "v4"). Every call throws std::runtime_error while that names a level which the machine lacks;
/// no level ever changes a result.
///
///     std::puts(curvewise::build_info().active.c_str());   // v4
#pragma once

#include <string>
#include <vector>

#include "curvewise/export.h"

namespace curvewise {

/// What build_info() returns.
struct BuildInfo {
    std::string version;
    std::string compiler;
    std::string eigen;
    std::vector<std::string> instruction_sets;  ///< those the machine has, the slowest first
    std::string active;                         ///< the one in use
};

/// Returns how the library was built, and what it uses on this machine.
CURVEWISE_EXPORT BuildInfo build_info();

}  // namespace curvewise
