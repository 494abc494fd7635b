/// \file
/// The version, in its one place: CMake and the Python package read it from the last line. The
/// preprocessor has its three numbers, in C too.
#pragma once

#define CURVEWISE_VERSION_MAJOR 0
#define CURVEWISE_VERSION_MINOR 1
#define CURVEWISE_VERSION_PATCH 0

#ifdef __cplusplus
namespace curvewise {

/// As "major.minor.patch".
inline constexpr char version[] = "0.1.0";

}  // namespace curvewise
#endif
