// The kernels of one instruction-set level, compiled once for each: CURVEWISE_LEVEL is `baseline`
// (SSE2 on x86-64, NEON on arm64), `v3` or `v4`.
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "strip.hpp"

namespace curvewise::kernels {
namespace {
#include "beside.inl.hpp"
#include "block.inl.hpp"
#include "boxes.inl.hpp"
#include "diagonals.inl.hpp"
#include "line.inl.hpp"
#include "narrow.inl.hpp"
#include "resident.inl.hpp"
#include "runs.inl.hpp"
#include "soft.inl.hpp"
}  // namespace

const KernelSet CURVEWISE_LEVEL = {select_advance,
                                   select_resident,
                                   select_fill,
                                   select_reach,
                                   select_values,
                                   select_least,
                                   select_runs,
                                   extremes,
                                   sum,
                                   select_line,
                                   line_height,
                                   narrow,
                                   width,
                                   select_beside,
                                   scan_diagonals,
                                   arcs,
                                   soft_forward<false>,
                                   soft_forward<true>,
                                   soft_backward};

}  // namespace curvewise::kernels
