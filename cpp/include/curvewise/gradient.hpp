/// \file
/// A measure with its derivative by every coordinate of Q, for optimisers that follow gradients: by
/// the chain rule, a model's derivatives by its parameters give those of the measure.
///
/// Each writes d value / d Q(j, c) to gradient[j * dim + c] and returns the value. Beyond the value
/// (for dtw and frechet: the path) it takes O(n + m) time and memory. The warping path, the
/// coupling, the cuts of the refinement and the order of corners are held as they are, which is
/// exact wherever they do not change at once (of paths: the envelope theorem). Where they do, at
/// ties, and where two matched points coincide or a difference is 0, the measure has a kink and no
/// derivative; what is written there is that of one of the sides, or 0 for the term that vanishes.
/// Errors are those of the value. Safe from any number of threads.
///
///     std::vector<double> gradient(Q.size() * Q.dim());
///     const double value = curvewise::value_and_gradient(curvewise::DtwOptions{}, P, Q,
///                                                        gradient.data());
#pragma once

#include "curvewise/area.hpp"
#include "curvewise/control.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/export.h"
#include "curvewise/frechet.hpp"

namespace curvewise {

/// Not for Spacing::arc_length: std::invalid_argument. With Crossing::rearrange the value jumps,
/// and the derivative is that between two jumps. With Spacing::matched the box is held, which is
/// exact where P has an extent in both directions: it is then P's.
CURVEWISE_EXPORT double value_and_gradient(const AreaOptions& options, const CurveView& P,
                                           const CurveView& Q, double* gradient,
                                           Control* control = nullptr);

/// Of one point of Q alone: that of the pair that decides. Does not look at options.cutoff.
CURVEWISE_EXPORT double value_and_gradient(const FrechetOptions& options, const CurveView& P,
                                           const CurveView& Q, double* gradient,
                                           Control* control = nullptr);

/// Does not look at options.cutoff.
CURVEWISE_EXPORT double value_and_gradient(const DtwOptions& options, const CurveView& P,
                                           const CurveView& Q, double* gradient,
                                           Control* control = nullptr);

/// Of curve_length(): wherever no difference is 0.
CURVEWISE_EXPORT double value_and_gradient(const CurveLengthOptions& options, const CurveView& P,
                                           const CurveView& Q, double* gradient,
                                           Control* control = nullptr);

/// Of sum_of_squares(): 2 (Q - P), everywhere.
CURVEWISE_EXPORT double sum_of_squares_and_gradient(const CurveView& P, const CurveView& Q,
                                                    double* gradient, Control* control = nullptr);

}  // namespace curvewise
