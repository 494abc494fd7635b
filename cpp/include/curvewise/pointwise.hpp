/// \file
/// Point-by-point measures, for two curves of the same shape: no alignment, O(n) time, no memory.
/// And the scaling that makes coordinates of different units comparable. Throw
/// std::invalid_argument for curves of unequal shape, empty or not finite; and Stopped. Safe from
/// any number of threads. Work is counted in points, n + m.
///
///     std::vector<double> scaled(2 * Q.size());
///     curvewise::normalize(P, Q, scaled.data());   // Q in the box of P
#pragma once

#include "curvewise/control.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/export.h"

namespace curvewise {

/// The sum, over all n dim entries, of the squared difference.
CURVEWISE_EXPORT double sum_of_squares(const CurveView& P, const CurveView& Q,
                                       Control* control = nullptr);
/// The mean, over all n dim entries, of the squared difference.
CURVEWISE_EXPORT double mse(const CurveView& P, const CurveView& Q, Control* control = nullptr);
/// The mean, over all n dim entries, of the absolute difference.
CURVEWISE_EXPORT double mae(const CurveView& P, const CurveView& Q, Control* control = nullptr);

/// Writes C minus P's minimum, divided by P's extent (not divided in a direction in which P has
/// none), to out[i * dim + c]; C may be P itself. `name` is what messages call C. Throws
/// std::invalid_argument for a curve that is empty or not finite, and for curves of different
/// dimension.
CURVEWISE_EXPORT void normalize(const CurveView& P, const CurveView& C, double* out,
                                const char* name = "Q", Control* control = nullptr);

}  // namespace curvewise
