/// \file
/// The area that exactly one of two closed curves in the plane encloses: the area of the symmetric
/// difference of their polygons. A point is inside a curve that goes around it an odd number of
/// times (the even-odd rule), so that curves may cross themselves and each other. The area depends
/// neither on the first point of a curve, nor on its direction, nor on further points on edges. If
/// the last point equals the first one, it only closes the curve.
///
/// Between two neighbouring x of points or crossings, the edges do not cross. There the area is the
/// sum of every second gap between them (the slabs of Shamos & Hoey, 1976). Exact but for rounding.
/// Symmetric. Time O((n + m + k) a log a) if a edges lie above each other and two of them cross k
/// times; memory O(n + m + a²). Throws std::invalid_argument for a curve that is not finite, has
/// zero points or not 2 coordinates. Throws std::bad_alloc and Stopped.
#pragma once

#include "curvewise/curve.hpp"
#include "curvewise/export.h"

namespace curvewise {

class Control;

/// In units of x times units of y.
[[nodiscard]] CURVEWISE_EXPORT double symmetric_difference(const CurveView& P, const CurveView& Q,
                                                           Control* control = nullptr);

}  // namespace curvewise
