/// \file
/// The area that one of two closed curves in the plane encloses and the other does not: the area of
/// the symmetric difference of their polygons. A point is inside a curve that goes around it an odd
/// number of times (the even-odd rule), so that curves may cross themselves and each other. It
/// depends neither on where a curve begins, nor on its direction, nor on further points on edges.
/// A point at the end that equals the first one only closes a curve.
///
/// Between two neighbouring x of points or crossings, the edges do not cross, and the area is the
/// sum of every second gap between them (the slabs of Shamos & Hoey, 1976). Exact but for rounding.
/// Symmetric. Time O((n + m + k) a log a), where a edges lie above each other and k times two of
/// them cross; memory O(n + m + a²). Throws std::invalid_argument for a curve that is not finite,
/// has no point or other than 2 coordinates; std::bad_alloc; Stopped.
#pragma once

#include "curvewise/control.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/export.h"

namespace curvewise {

/// In units of x times units of y.
CURVEWISE_EXPORT double symmetric_difference(const CurveView& P, const CurveView& Q,
                                             Control* control = nullptr);

}  // namespace curvewise
