/// \file
/// Soft dynamic time warping (Cuturi & Blondel 2017): dtw with squared Euclidean ground distances,
/// with a smooth minimum instead of the smallest of three, so that it has a gradient everywhere.
///
///     r[i, j] = d + softmin(r[i-1, j-1], r[i-1, j], r[i, j-1]),   d = |P_i - Q_j|^2
///     softmin(a, b, c) = -gamma log(exp(-a/gamma) + exp(-b/gamma) + exp(-c/gamma))
///
/// All paths count, each by exp(-cost / gamma). The value is below dtw by at most gamma times the
/// logarithm of their number. So it is below 0 for similar curves. As gamma falls, it approaches
/// dtw. No gamma overflows: below 2^-900 of the squared distances, the value is the limit. Time O(n
/// m); memory O(n + m), and O(n sqrt(m)) with gradients (gradient.hpp). Throws
/// std::invalid_argument as dtw does, and for a gamma that is not positive and finite. Throws
/// std::bad_alloc and Stopped. Safe from any number of threads.
///
///     curvewise::SoftDtwOptions options;
///     options.gamma = 0.1;
///     const double loss = curvewise::soft_dtw(target, forecast, options);
#pragma once

#include <cstddef>
#include <optional>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// How smooth the minimum is, and which paths count.
struct SoftDtwOptions {
    static constexpr const char* measure = "soft_dtw";
    static constexpr bool is_planar = false;  ///< for curves of any dimension

    /// In the unit of the ground distance, squared coordinates.
    double gamma = 1.0;
    /// As for dtw.
    std::optional<std::ptrdiff_t> window = {};
    std::optional<double> window_fraction = {};

    static constexpr bool is_symmetric() noexcept { return true; }
    /// The elementary steps, of some nanoseconds each, that curves of n and m points take, roughly.
    constexpr double work(double n, double m, double /*dim*/) const noexcept { return 4 * n * m; }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(SoftDtwOptions& options, Visit&& visit) {
    visit("gamma", options.gamma, gamma_range);
    visit("window", options.window, options.window_fraction, window_range);
}

[[nodiscard]] CURVEWISE_EXPORT double soft_dtw(const CurveView& P, const CurveView& Q,
                                               const SoftDtwOptions& options = {},
                                               Control* control = nullptr);

/// For code that treats all measures in the same way (gradient.hpp).
[[nodiscard]] inline double evaluate(const SoftDtwOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return soft_dtw(P, Q, options, control);
}

}  // namespace curvewise
