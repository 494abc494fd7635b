/// \file
/// A measure with its derivatives by every coordinate of both curves, for gradient-based
/// optimisers. By the chain rule, a model's derivatives by its parameters give the derivatives of
/// the measure.
///
/// Each function writes d value / d P(i, c) to by_p[i * dim + c] and d value / d Q(j, c) to by_q[j
/// * dim + c], if these are not null, and returns the value. Beyond the value (for dtw and frechet:
/// the path; for soft_dtw see soft_dtw.hpp) it takes O(n + m) time and memory.
///
/// The warping path, the coupling, the cuts of the refinement and the order of corners are held
/// fixed. That is exact wherever small changes do not change them (for paths: the envelope
/// theorem). The measure has a kink at ties, where two matched points coincide, and where a
/// difference is 0. There a derivative does not exist; the function writes that of one side, or 0
/// for the term that vanishes. Errors are those of the value. Safe from any number of threads.
///
///     std::vector<double> gradient(Q.size() * Q.dim());
///     const double value = curvewise::value_and_gradient(curvewise::DtwOptions{}, P, Q,
///                                                        gradient.data());
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "curvewise/area.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/export.h"
#include "curvewise/frechet.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "curvewise/soft_dtw.hpp"

namespace curvewise {

class Control;

/// Output arrays of the derivatives; null if not required.
struct Gradients {
    double* by_p = nullptr;
    double* by_q = nullptr;
};

/// Not for Spacing::arc_length, Spacing::function and closed curves: std::invalid_argument. With
/// Crossing::rearrange the value jumps, and the derivative is that between two jumps.
CURVEWISE_EXPORT double value_and_gradients(const AreaOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// Only one point of each curve has derivatives: the pair that decides. If several pairs tie, it is
/// the pair that decides after both curves have been moved by at most 2^-30 of the distance, for
/// twice the time. Ignores options.cutoff.
CURVEWISE_EXPORT double value_and_gradients(const FrechetOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// Derivatives of the critical event that decides: two vertices, a vertex and an edge, or two
/// vertices and an edge. Three times the time of the value; at ties five times, as for frechet.
CURVEWISE_EXPORT double value_and_gradients(const FrechetContinuousOptions& options,
                                            const CurveView& P, const CurveView& Q,
                                            const Gradients& out, Control* control = nullptr);

/// Ignores options.cutoff.
CURVEWISE_EXPORT double value_and_gradients(const DtwOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// Derivatives of curve_length(), which exist wherever no difference is 0.
CURVEWISE_EXPORT double value_and_gradients(const CurveLengthOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// Derivatives of soft_dtw(), which exist everywhere. Two or three times the time of the value.
CURVEWISE_EXPORT double value_and_gradients(const SoftDtwOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// By Q alone.
template <class Options>
double value_and_gradient(const Options& options, const CurveView& P, const CurveView& Q,
                          double* gradient, Control* control = nullptr) {
    return value_and_gradients(options, P, Q, {nullptr, gradient}, control);
}

/// Derivatives of sum_of_squares(): 2 (Q - P), everywhere.
CURVEWISE_EXPORT double sum_of_squares_and_gradient(const CurveView& P, const CurveView& Q,
                                                    double* gradient, Control* control = nullptr);

/// A measure that has derivatives, chosen by the type of its options.
using DifferentiableMeasure =
    std::variant<AreaOptions, FrechetOptions, DtwOptions, CurveLengthOptions,
                 FrechetContinuousOptions, SoftDtwOptions>;

/// Computes values[k] and the requested derivatives out[k] of the pairs P[k], Q[k], on `workers`
/// threads, -1 for one per core. If both pointers of out[k] are null, only the value is computed.
/// Results do not depend on the number of threads. The first error of a pair is thrown once all
/// threads have ended.
CURVEWISE_EXPORT void values_and_gradients(const DifferentiableMeasure& measure,
                                           const std::vector<CurveView>& P,
                                           const std::vector<CurveView>& Q, double* values,
                                           const std::vector<Gradients>& out,
                                           std::ptrdiff_t workers = 1, Control* control = nullptr);

}  // namespace curvewise
