// How this library was built, and what it uses on this machine.
#pragma once

#include <string>
#include <vector>

namespace curvewise {

struct BuildInfo {
    std::string version;
    std::string compiler;
    std::string eigen;
    std::vector<std::string> instruction_sets;  // those the machine has, the slowest first
    std::string active;                         // the one in use
};

BuildInfo build_info();

}  // namespace curvewise
