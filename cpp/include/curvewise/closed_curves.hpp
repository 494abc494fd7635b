/// \file
/// Closed curves, which have no first point: dtw and the discrete Fréchet distance over all walks
/// that go once around both. A walk is a sequence of pairs of points. Its steps are (1, 0), (0, 1)
/// or (1, 1) around the curves, and its last step returns to its first pair. The value is the least
/// sum (closed_dtw) or the least maximum (closed_frechet) of the ground distances of its pairs:
///
///     min over i, j of dtw(P from point i on, Q from point j on)
///
/// and the same with frechet. If the last point of a curve equals its first one, it only closes the
/// curve, and is removed. The values are symmetric. Rotations of either curve change closed_dtw by
/// rounding only, and closed_frechet not at all.
///
/// closed_dtw: walks that begin at different points of Q need not cross. So each is searched for
/// between two others (Maes, On a cyclic string-to-string correction problem, Information
/// Processing Letters 35, 1990). Time O(n m log m), memory O(n m) bytes.
///
/// closed_frechet: bisection among distances. The first and the last point of Q from which a pair
/// is reached decide whether there is a walk within a bound (after Alt & Godau, 1995). Time O(n m)
/// a decision, with about 20 decisions, less for similar curves. Memory O(n + m), for a path O(n m)
/// bytes.
///
/// Errors are as for dtw(); a custom ground distance is rejected.
#pragma once

#include <limits>

#include "curvewise/alignment.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/ground_distance.hpp"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// Which distances closed_dtw() and closed_frechet() compare.
struct ClosedOptions {
    static constexpr const char* measure = "closed curves";

    GroundDistance ground = {};
    /// A larger distance becomes infinity, without a path. At least 0.
    double cutoff = std::numeric_limits<double>::infinity();

    /// The elementary steps, of some nanoseconds each, roughly.
    double work(double n, double m, double dim) const noexcept {
        return 20.0 * n * m * ground.weight(dim);
    }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(ClosedOptions& options, Visit&& visit) {
    visit(options.ground);
    visit("cutoff", options.cutoff, cutoff_range);
}

/// The least sum.
[[nodiscard]] CURVEWISE_EXPORT double closed_dtw(const CurveView& P, const CurveView& Q,
                                                 const ClosedOptions& options = {},
                                                 Control* control = nullptr);

/// The least sum, with its pairs: the first is one of P's first point; it is not repeated at the
/// end.
[[nodiscard]] CURVEWISE_EXPORT Alignment closed_dtw_path(const CurveView& P, const CurveView& Q,
                                                         const ClosedOptions& options = {},
                                                         Control* control = nullptr);

/// The least maximum.
[[nodiscard]] CURVEWISE_EXPORT double closed_frechet(const CurveView& P, const CurveView& Q,
                                                     const ClosedOptions& options = {},
                                                     Control* control = nullptr);

/// The least maximum, with its pairs.
[[nodiscard]] CURVEWISE_EXPORT Alignment closed_frechet_path(const CurveView& P, const CurveView& Q,
                                                             const ClosedOptions& options = {},
                                                             Control* control = nullptr);

}  // namespace curvewise
