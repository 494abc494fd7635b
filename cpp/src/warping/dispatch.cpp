#include "warping/dispatch.hpp"

#include <cstdlib>
#include <stdexcept>

#include "runtime/double_precision.hpp"

namespace curvewise::warping {
namespace {

Level choose_level() {
    const std::vector<Level> levels = available_levels();
    const char* const forced = std::getenv("CURVEWISE_ISA");
    if (forced == nullptr || *forced == '\0') return levels.back();
    std::string names;
    for (const Level& level : levels) {
        if (level.name == std::string(forced)) return level;
        names += (names.empty() ? "" : ", ") + std::string(level.name);
    }
    throw std::runtime_error("CURVEWISE_ISA is '" + std::string(forced) + "'; this machine has " +
                             names);
}

}  // namespace

std::vector<Level> available_levels() {
    std::vector<Level> levels{{"baseline", &kernels::baseline, &kernels::recurrences::baseline}};
#ifdef CURVEWISE_X86_64_LEVELS
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2")) {
        levels.push_back({"v3", &kernels::v3, &kernels::recurrences::v3});
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
            __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl")) {
            levels.push_back({"v4", &kernels::v4, &kernels::recurrences::v4});
        }
    }
#endif
    return levels;
}

const Level& active_level() {
    static const Level level = choose_level();
    return level;
}

}  // namespace curvewise::warping
