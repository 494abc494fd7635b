/// \file
/// The mean of curves under dtw: the curve with the smallest weighted sum of dtw distances from all
/// of them, with squared Euclidean ground distances. The algorithm finds a local minimum of that
/// sum ("DTW barycenter averaging": Petitjean, Ketterlin & Gançarski 2011).
///
///     curvewise::DtwMean mean = curvewise::dtw_mean(tests, {}, tests.front());
///     const curvewise::CurveView curve(mean.points.data(), tests.front().size(), 2);
///
/// Each round finds the best warping path from the mean to every curve. Then it moves each point of
/// the mean to the weighted mean of its matched points. Neither step can raise the sum, except by
/// rounding. The mean has as many points as the initial curve. Time O(n m) a curve and round;
/// memory O(n + m).
///
/// Throws std::invalid_argument as dtw does, with the name of the curve (curves[3]), and for
/// weights that are negative, not finite, or all 0. Throws std::bad_alloc and Stopped.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"

namespace curvewise {

class Control;

/// How dtw_mean() matches points, and when it ends.
struct DtwMeanOptions {
    /// As for dtw.
    std::optional<std::ptrdiff_t> window = {};
    std::optional<double> window_fraction = {};
    /// Maximum number of rounds, at least 0.
    std::ptrdiff_t iterations = 30;
    /// The search ends if a round lowers the sum by at most this part of it.
    double tolerance = 1e-6;
    /// Threads for this call, -1 for one per core. Never changes the result.
    std::ptrdiff_t workers = 1;
};

/// The result of dtw_mean().
struct DtwMean {
    std::vector<double> points;  ///< point by point
    std::vector<double> costs;   ///< the sum for the initial curve, and after every move
    bool converged = false;      ///< within the tolerance
};

/// `weights`: one for each curve, or empty for equal weights.
[[nodiscard]] CURVEWISE_EXPORT DtwMean dtw_mean(const std::vector<CurveView>& curves,
                                                const std::vector<double>& weights,
                                                const CurveView& initial,
                                                const DtwMeanOptions& options = {},
                                                Control* control = nullptr);

}  // namespace curvewise
