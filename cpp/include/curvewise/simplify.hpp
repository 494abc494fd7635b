/// \file
/// Fewer points for a curve, within a tolerance. The kept points are points of the curve, the first
/// and the last among them. Each edge between two kept points replaces the section between them.
///
/// With `frechet`, the continuous Fréchet distance between an edge and its section is at most the
/// tolerance. The number of points is the least for which this is possible (Imai & Iri, "Polygonal
/// approximations of a curve", 1988; Godau, "A natural metric for curves", STACS 1991). So the
/// whole curves are within the tolerance, too (frechet_within()). Of several choices, each point is
/// followed by the last possible one. Time O(n^3) at worst. A run of points ends where no edge can
/// replace more; if runs have at most m points, time is about O(n m). Memory O(n).
///
/// With `hausdorff`, the Hausdorff distance between an edge and its section is at most the
/// tolerance: each point left out is within it. The algorithm is that of Douglas & Peucker (1973):
/// a section that is not within the tolerance is split at the point farthest from its edge. It does
/// not give the fewest points, and a section that goes back along its edge can be lost. Time about
/// O(n log n), O(n^2) at worst; memory O(n).
///
/// Whether a section is within the tolerance is decided exactly. Curves have any dimension. Throws
/// std::invalid_argument for a curve that is empty or not finite, and a tolerance that is negative
/// or nan. Throws std::bad_alloc and Stopped. Safe from any number of threads.
///
///     const auto kept = curvewise::simplify(track, 5.0);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"

namespace curvewise {

class Control;

/// The distance between an edge and the section that it replaces.
enum class EdgeMeasure {
    frechet,   ///< continuous Fréchet, with the fewest points: Imai & Iri
    hausdorff  ///< Hausdorff: Douglas & Peucker
};

/// The indices of the points that are kept, ascending. `tolerance` has the units of the
/// coordinates, and is at least 0.
[[nodiscard]] CURVEWISE_EXPORT std::vector<std::int64_t> simplify(
    const CurveView& curve, double tolerance, EdgeMeasure measure = EdgeMeasure::frechet,
    Control* control = nullptr);

}  // namespace curvewise
