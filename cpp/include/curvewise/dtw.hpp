/// \file
/// Dynamic time warping: the smallest sum of ground distances over all warping paths.
///
///     c[0, 0] = d(P_0, Q_0)
///     c[i, j] = min(min(c[i-1, j], c[i, j-1]) + d, c[i-1, j-1] + w d),   d = d(P_i, Q_j)
///
/// w = 1 for symmetric1, 2 for symmetric2 (Sakoe & Chiba 1978). step_pattern.hpp has more patterns,
/// and recurrence.hpp defines them. Exact. Time O(n m); memory O(n + m) for the distance and the
/// path, 8 n m bytes for the table. Every function throws std::invalid_argument for a curve that is
/// empty or not finite, for curves of different dimension, and for options out of range. The
/// message gives the argument and the place. Throws std::bad_alloc and Stopped. Safe from any
/// number of threads.
///
///     curvewise::DtwOptions options;
///     options.step_pattern = curvewise::StepPattern::symmetric2;
///     options.window = 20;
///     const double distance = curvewise::dtw(experiment, simulation, options);
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "curvewise/alignment.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/ground_distance.hpp"
#include "curvewise/options.hpp"
#include "curvewise/step_pattern.hpp"
#include "curvewise/warping_info.hpp"

namespace curvewise {

class Control;

/// Which paths dtw() allows, what it adds up along them, and how it is computed.
struct DtwOptions {
    static constexpr const char* measure = "dtw";
    static constexpr bool is_planar = false;  ///< for curves of any dimension

    GroundDistance ground = {};
    StepPattern step_pattern = StepPattern::symmetric1;
    /// Replaces `step_pattern` if it has rows.
    StepRows own_steps = {};
    /// Cost added to each step that leaves the diagonal, at least 0.
    double penalty = 0.0;
    /// Sakoe-Chiba band: |i (m-1) - j (n-1)| <= window (max(n, m) - 1); no band if n or m is 1.
    std::optional<std::ptrdiff_t> window = {};
    /// In place of `window`, a fraction between 0 and 1 of the points of the longer curve, cut to a
    /// whole number.
    std::optional<double> window_fraction = {};
    /// Subsequence DTW (Müller 2007): P is matched to a section of Q, which may begin, or end,
    /// anywhere. It excludes windows. It needs symmetric1 without a penalty, or a step pattern
    /// whose paths all have one weight: open_begin needs the weight n. The end minimises c over the
    /// weight of the paths to it, as in R's dtw.
    bool open_begin = false;
    bool open_end = false;
    /// Maximum number of points to omit at the beginning and the end of P, then of Q, as with psi
    /// of dtaidistance. The value is the least sum over all such paths. Needs symmetric1, with or
    /// without a penalty. Excludes a window, open ends and normalize.
    std::array<std::ptrdiff_t, 4> relax = {};
    /// Divide the distance by the sum of the weights of any path: n + m, n or m, depending on the
    /// step pattern. Rejected if paths have different weights. Ignored by dtw_path() and
    /// dtw_table().
    bool normalize = false;
    /// Threads for this call, -1 for one per core. Never changes a result.
    std::ptrdiff_t workers = 1;
    /// Whether to skip table cells that cannot affect the result. Never changes a result.
    bool prune = true;
    /// A larger distance becomes infinity, and its computation ends early. At least 0, except with
    /// own steps of negative weight. Ignored by dtw_path() and dtw_table(). Batches have an
    /// additional cutoff.
    double cutoff = std::numeric_limits<double>::infinity();

    [[nodiscard]] CURVEWISE_EXPORT bool is_symmetric() const;
    /// The elementary steps, of some nanoseconds each, that curves of n and m points take, roughly.
    double work(double n, double m, double dim) const noexcept {
        return n * m * ground.weight(dim);
    }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(DtwOptions& options, Visit&& visit) {
    visit(options.ground);
    visit("step_pattern", options.step_pattern, options.own_steps);
    visit("penalty", options.penalty, penalty_range);
    visit("window", options.window, options.window_fraction, window_range);
    visit("open_begin", options.open_begin);
    visit("open_end", options.open_end);
    visit("relax", options.relax, relax_range);
    visit("normalize", options.normalize);
    visit("workers", options.workers, workers_range);
    visit("prune", options.prune);
    visit("cutoff", options.cutoff,
          options.own_steps.has_negative_weight() ? any_cutoff_range : cutoff_range);
}

/// The distance, in units of the ground distance.
[[nodiscard]] CURVEWISE_EXPORT double dtw(const CurveView& P, const CurveView& Q,
                                          const DtwOptions& options = {},
                                          Control* control = nullptr);

/// Among equal predecessors: diagonal, then (i-1, j), then (i, j-1). The sum of step weight
/// times ground distance along the path, in path order, equals the distance to the bit.
[[nodiscard]] CURVEWISE_EXPORT Alignment dtw_path(const CurveView& P, const CurveView& Q,
                                                  const DtwOptions& options = {},
                                                  Control* control = nullptr);

/// Writes c to out[i * m + j]; infinity outside the window.
CURVEWISE_EXPORT void dtw_table(const CurveView& P, const CurveView& Q, double* out,
                                const DtwOptions& options = {}, Control* control = nullptr);

/// The distance, with how it was found (see docs/explanation/exact_and_fast.md).
[[nodiscard]] CURVEWISE_EXPORT WarpingInfo dtw_info(const CurveView& P, const CurveView& Q,
                                                    const DtwOptions& options = {},
                                                    Control* control = nullptr);

/// For code that treats all measures in the same way (measure.hpp).
[[nodiscard]] inline double evaluate(const DtwOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return dtw(P, Q, options, control);
}

}  // namespace curvewise
