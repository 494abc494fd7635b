// The area with its derivatives by the points of both curves.
#pragma once

#include "curves/range_scale.hpp"
#include "curvewise/area.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/gradient.hpp"
#include "runtime/poller.hpp"

namespace curvewise::planar {

// Of curves that were checked, with options that have a gradient. Time and memory of area(). Throws
// Stopped where the poller says so.
double area_and_gradients(const CurveView& P, const CurveView& Q, const AreaOptions& options,
                          const curves::RangeScale& range, const Gradients& out,
                          runtime::Poller& poller);

}  // namespace curvewise::planar
