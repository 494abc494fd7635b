/// \file
/// The discrete Fréchet distance (Eiter & Mannila 1994): the smallest, over all couplings, of the
/// largest ground distance.
///
///     c[i, j] = max(d(P_i, Q_j), min(c[i-1, j], c[i, j-1], c[i-1, j-1]))
///
/// It is at most the longest edge of either curve above the continuous Fréchet distance. Exact.
/// Symmetric. Time O(n m); memory O(n + m) for the distance and the path, 8 n m bytes for the
/// table. Throws as dtw does. Safe from any number of threads.
///
///     const curvewise::Alignment coupling = curvewise::frechet_path(experiment, simulation);
///     std::printf("%g in %zu steps\n", coupling.distance, coupling.path.size());
#pragma once

#include <cstddef>
#include <limits>

#include "curvewise/alignment.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/ground_distance.hpp"
#include "curvewise/options.hpp"
#include "curvewise/warping_info.hpp"

namespace curvewise {

class Control;

/// Which distances frechet() compares, and how it is computed.
struct FrechetOptions {
    static constexpr const char* measure = "frechet";
    static constexpr bool is_planar = false;  ///< for curves of any dimension

    GroundDistance ground = {};
    /// Threads for this call, -1 for one per core. Never changes a result.
    std::ptrdiff_t workers = 1;
    /// Whether to skip table cells that cannot affect the result: similar curves then take nearly
    /// linear time. Never changes a result.
    bool prune = true;
    /// A larger distance becomes infinity, and its computation ends early. At least 0. Ignored by
    /// paths and tables. Batches have an additional cutoff.
    double cutoff = std::numeric_limits<double>::infinity();

    static constexpr bool is_symmetric() noexcept { return true; }
    /// The elementary steps, of some nanoseconds each, that curves of n and m points take, roughly.
    constexpr double work(double n, double m, double dim) const noexcept {
        return n * m * ground.weight(dim);
    }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(FrechetOptions& options, Visit&& visit) {
    visit(options.ground);
    visit("workers", options.workers, workers_range);
    visit("prune", options.prune);
    visit("cutoff", options.cutoff, cutoff_range);
}

/// The distance, in units of the ground distance.
[[nodiscard]] CURVEWISE_EXPORT double frechet(const CurveView& P, const CurveView& Q,
                                              const FrechetOptions& options = {},
                                              Control* control = nullptr);

/// Among equal predecessors: diagonal, then (i-1, j), then (i, j-1). The largest ground distance
/// along the path equals the distance to the bit.
[[nodiscard]] CURVEWISE_EXPORT Alignment frechet_path(const CurveView& P, const CurveView& Q,
                                                      const FrechetOptions& options = {},
                                                      Control* control = nullptr);

/// Writes c to out[i * m + j].
CURVEWISE_EXPORT void frechet_table(const CurveView& P, const CurveView& Q, double* out,
                                    const FrechetOptions& options = {}, Control* control = nullptr);

/// The distance, with how it was found (see docs/explanation/exact_and_fast.md).
[[nodiscard]] CURVEWISE_EXPORT WarpingInfo frechet_info(const CurveView& P, const CurveView& Q,
                                                        const FrechetOptions& options = {},
                                                        Control* control = nullptr);

/// For code that treats all measures in the same way (measure.hpp).
[[nodiscard]] inline double evaluate(const FrechetOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return frechet(P, Q, options, control);
}

}  // namespace curvewise
