/// \file
/// A measure with its derivatives by every coordinate of both curves, for optimisers that follow
/// gradients: by the chain rule, a model's derivatives by its parameters give those of the measure.
///
/// Each writes d value / d P(i, c) to by_p[i * dim + c] and d value / d Q(j, c) to by_q[j * dim +
/// c], where these are not null, and returns the value. Beyond the value (for dtw and frechet: the
/// path; for soft_dtw see soft_dtw.hpp) it takes O(n + m) time and memory. The warping path, the
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

#include <cstddef>
#include <variant>
#include <vector>

#include "curvewise/area.hpp"
#include "curvewise/control.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/export.h"
#include "curvewise/frechet.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "curvewise/soft_dtw.hpp"

namespace curvewise {

/// Where derivatives go; null where they are not wanted.
struct Gradients {
    double* by_p = nullptr;
    double* by_q = nullptr;
};

/// Not for Spacing::arc_length and Spacing::function: std::invalid_argument. With
/// Crossing::rearrange the value jumps, and the derivative is that between two jumps.
CURVEWISE_EXPORT double value_and_gradients(const AreaOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// Of one point of each curve alone: those of the pair that decides. At ties of several pairs: of
/// the pair that decides after both curves have been moved by at most 2^-30 of the distance, for
/// twice the time. Does not look at options.cutoff.
CURVEWISE_EXPORT double value_and_gradients(const FrechetOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// Of the critical event that decides: two vertices, a vertex and an edge, or two vertices and an
/// edge. Three times the time of the value; at ties five times, as for frechet.
CURVEWISE_EXPORT double value_and_gradients(const FrechetContinuousOptions& options,
                                            const CurveView& P, const CurveView& Q,
                                            const Gradients& out, Control* control = nullptr);

/// Does not look at options.cutoff.
CURVEWISE_EXPORT double value_and_gradients(const DtwOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// Of curve_length(): wherever no difference is 0.
CURVEWISE_EXPORT double value_and_gradients(const CurveLengthOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// Of soft_dtw(): everywhere. Twice the time of the value, or three times.
CURVEWISE_EXPORT double value_and_gradients(const SoftDtwOptions& options, const CurveView& P,
                                            const CurveView& Q, const Gradients& out,
                                            Control* control = nullptr);

/// By Q alone.
template <class Options>
double value_and_gradient(const Options& options, const CurveView& P, const CurveView& Q,
                          double* gradient, Control* control = nullptr) {
    return value_and_gradients(options, P, Q, {nullptr, gradient}, control);
}

/// Of sum_of_squares(): 2 (Q - P), everywhere.
CURVEWISE_EXPORT double sum_of_squares_and_gradient(const CurveView& P, const CurveView& Q,
                                                    double* gradient, Control* control = nullptr);

/// A measure that has derivatives, chosen by the type of its options.
using DifferentiableMeasure =
    std::variant<AreaOptions, FrechetOptions, DtwOptions, CurveLengthOptions,
                 FrechetContinuousOptions, SoftDtwOptions>;

/// Of the pairs P[k], Q[k], on `workers` threads, -1 for one per core: values[k], and what out[k]
/// asks for: the value alone where both are null. Results do not depend on the number of threads.
/// The first error of a pair is thrown once all threads have ended.
CURVEWISE_EXPORT void values_and_gradients(const DifferentiableMeasure& measure,
                                           const std::vector<CurveView>& P,
                                           const std::vector<CurveView>& Q, double* values,
                                           const std::vector<Gradients>& out,
                                           std::ptrdiff_t workers = 1, Control* control = nullptr);

}  // namespace curvewise
