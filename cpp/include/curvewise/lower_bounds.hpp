/// \file
/// Lower bounds of dtw, by the definitions of their papers.
///
/// A point of P is matched only to points of Q in its window. The smallest box that contains these
/// is the point's envelope, and its distance from the envelope bounds each of its pairs.
/// - lb_keogh (Keogh & Ratanamahatana 2005) adds these distances.
/// - lb_improved (Lemire 2009) adds lb_keogh of Q and H, where H is P with each point moved to the
///   nearest of its envelope.
/// - lb_kim (Kim, Park & Chu 2001) is the largest of four distances: between the first points, the
///   last points, the least and the greatest coordinates.
///
/// No bound exceeds dtw with the same metric and window, also after rounding. The batches of
/// pairwise.hpp with a cutoff, and Index, apply such bounds by themselves. Time O((n + m) d
/// log(window)), memory O((n + m) d). Throws std::invalid_argument as dtw does, and for metrics
/// without envelopes: minkowski and those that are not norms. Throws std::bad_alloc and Stopped.
/// Safe from any number of threads.
///
///     curvewise::LowerBoundOptions options;
///     options.window = 5;
///     if (curvewise::lb_keogh(P, Q, options) > limit) { /* dtw is above the limit, too */ }
#pragma once

#include <cstddef>
#include <optional>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/ground_distance.hpp"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// The ground distance and the window of dtw.
struct LowerBoundOptions {
    static constexpr const char* measure = "lower bounds";

    /// euclidean, sqeuclidean, cityblock or chebyshev.
    Metric metric = Metric::euclidean;
    /// As for dtw. lb_kim has no window.
    std::optional<std::ptrdiff_t> window = {};
    std::optional<double> window_fraction = {};

    /// The elementary steps, of some nanoseconds each, that curves of n and m points take, roughly.
    constexpr double work(double n, double m, double dim) const noexcept {
        return 8.0 * (n + m) * dim;
    }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(LowerBoundOptions& options, Visit&& visit) {
    visit("metric", options.metric);
    visit("window", options.window, options.window_fraction, window_range);
}

/// The sum of the distances of P's points from their envelopes in Q. Not symmetric.
[[nodiscard]] CURVEWISE_EXPORT double lb_keogh(const CurveView& P, const CurveView& Q,
                                               const LowerBoundOptions& options = {},
                                               Control* control = nullptr);

/// At least lb_keogh, except by rounding. In several dimensions with sqeuclidean and cityblock
/// alone. Not symmetric.
[[nodiscard]] CURVEWISE_EXPORT double lb_improved(const CurveView& P, const CurveView& Q,
                                                  const LowerBoundOptions& options = {},
                                                  Control* control = nullptr);

/// The largest of four distances. Symmetric; ignores the window.
[[nodiscard]] CURVEWISE_EXPORT double lb_kim(const CurveView& P, const CurveView& Q,
                                             const LowerBoundOptions& options = {},
                                             Control* control = nullptr);

}  // namespace curvewise
