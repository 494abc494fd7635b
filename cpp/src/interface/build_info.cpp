#include "curvewise/build_info.hpp"

#include "curvewise/version.hpp"
#include "warping/dispatch.hpp"

namespace curvewise {
namespace {

std::string compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "gcc " __VERSION__;
#elif defined(_MSC_VER)
    return "msvc " + std::to_string(_MSC_VER);
#else
    return "unknown";
#endif
}

}  // namespace

BuildInfo build_info() {
    BuildInfo info{version, compiler(), CURVEWISE_EIGEN_VERSION, {}, warping::active_level().name};
    for (const warping::Level& level : warping::available_levels()) {
        info.instruction_sets.emplace_back(level.name);
    }
    return info;
}

}  // namespace curvewise
