// Point-by-point measures, for two curves of the same shape: no alignment, O(n) time. Throw
// std::invalid_argument for curves of unequal shape, empty or not finite.
#pragma once

#include "curvewise/curve.hpp"

namespace curvewise {

double sum_of_squares(const CurveView& P, const CurveView& Q);
double mse(const CurveView& P, const CurveView& Q);  // mean squared difference of all entries
double mae(const CurveView& P, const CurveView& Q);  // mean absolute difference of all entries

// Writes C minus P's minimum, divided by P's extent (not divided in a direction in which P has
// none), to out[i * dim + c]. `name` is what messages call C.
void normalize(const CurveView& P, const CurveView& C, double* out, const char* name = "Q");

}  // namespace curvewise
