// The version, in its one place: CMake and the Python package read it from this line.
#pragma once

namespace curvewise {

inline constexpr char version[] = "0.1.0";

}  // namespace curvewise
