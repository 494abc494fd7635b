/// \file
/// Point-by-point measures, for two curves of the same shape, without alignment: O(n) time, no
/// memory. Also the scaling that makes coordinates of different units comparable. Throws
/// std::invalid_argument for curves of unequal shape, empty or not finite; and Stopped. Safe from
/// any number of threads. Work is counted in points, n + m.
///
///     std::vector<double> scaled(2 * Q.size());
///     curvewise::normalize(P, Q, scaled.data());   // Q in the box of P
#pragma once

#include "curvewise/curve.hpp"
#include "curvewise/export.h"

namespace curvewise {

class Control;

/// The sum, over all n dim entries, of the squared difference.
[[nodiscard]] CURVEWISE_EXPORT double sum_of_squares(const CurveView& P, const CurveView& Q,
                                                     Control* control = nullptr);
/// The mean, over all n dim entries, of the squared difference.
[[nodiscard]] CURVEWISE_EXPORT double mse(const CurveView& P, const CurveView& Q,
                                          Control* control = nullptr);
/// The mean, over all n dim entries, of the absolute difference.
[[nodiscard]] CURVEWISE_EXPORT double mae(const CurveView& P, const CurveView& Q,
                                          Control* control = nullptr);

/// Writes C minus P's minimum, divided by P's extent, to out[i * dim + c]. It does not divide in a
/// direction in which P's extent is zero. C may be P itself. `name` is the name of C in messages.
/// Throws std::invalid_argument for a curve that is empty or not finite, and for curves of
/// different dimension.
CURVEWISE_EXPORT void normalize(const CurveView& P, const CurveView& C, double* out,
                                const char* name = "Q", Control* control = nullptr);

}  // namespace curvewise
