// Refines two curves to the same number of vertices, so that vertex i of one faces vertex i of the
// other. This is the first half of Algorithm 1 of Jekel et al. (2018).
#pragma once

#include <cstddef>
#include <utility>

#include "curves/polyline.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/area.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::planar {

using curves::Polyline;
using runtime::Poller;

using Cut = std::pair<std::size_t, double>;  // segment, fraction of it

struct FacingCurves {
    Polyline A;
    Polyline B;
    runtime::ScratchVector<Cut> cuts;  // of B, in its order; empty for `arc_length`
};

// For `distance` and `x`, A is the curve with more points (P if equal) and B the other, refined:
// the longest segment is bisected, again and again. O((n - m) log m). For `arc_length`, A is P and
// B is Q, each with a vertex wherever the other has one. O(n + m). Coordinates come out in `range`.
// Throws Stopped where the poller says so.
FacingCurves face(const CurveView& P, const CurveView& Q, const curves::RangeScale& range,
                  Spacing spacing, Poller& poller);

}  // namespace curvewise::planar
