/// \file
/// The version, in its one place: CMake and the Python package read it from this line.
#pragma once

namespace curvewise {

/// As "major.minor.patch".
inline constexpr char version[] = "0.1.0";

}  // namespace curvewise
