// Instruction-set levels: which this machine has, and which one this process uses.
#pragma once

#include <string>
#include <vector>

#include "warping/kernels/recurrence.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {

struct Level {
    const char* name;
    const kernels::KernelSet* kernels;
    const kernels::RecurrenceKernels* recurrences;
};

// Those this machine has, the slowest first.
std::vector<Level> available_levels();

// The last of them, or the one that the environment variable CURVEWISE_ISA names; chosen once.
// Throws std::runtime_error if this machine does not have a level of that name.
const Level& active_level();

}  // namespace curvewise::warping
