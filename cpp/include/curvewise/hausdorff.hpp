/// \file
/// The Hausdorff distance between the points of two curves: the largest distance of a point of
/// either curve from the other curve's points. It is the only measure that ignores the order of the
/// points.
///
///     max(max over i of min over j of d(P_i, Q_j), max over j of min over i of d(P_i, Q_j))
///
/// Exact. Symmetric. Time O(n m), memory O(n + m). Errors and threads are as for dtw().
#pragma once

#include <limits>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/ground_distance.hpp"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// Which distances hausdorff() compares.
struct HausdorffOptions {
    static constexpr const char* measure = "hausdorff";
    static constexpr bool is_planar = false;  ///< for curves of any dimension

    GroundDistance ground = {};
    /// A distance above it, at least 0, becomes infinity.
    double cutoff = std::numeric_limits<double>::infinity();

    static constexpr bool is_symmetric() noexcept { return true; }
    double work(double n, double m, double dim) const noexcept {
        return n * m * ground.weight(dim);
    }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(HausdorffOptions& options, Visit&& visit) {
    visit(options.ground);
    visit("cutoff", options.cutoff, cutoff_range);
}

/// The distance, in units of the ground distance.
[[nodiscard]] CURVEWISE_EXPORT double hausdorff(const CurveView& P, const CurveView& Q,
                                                const HausdorffOptions& options = {},
                                                Control* control = nullptr);

/// For code that treats all measures in the same way (measure.hpp).
[[nodiscard]] inline double evaluate(const HausdorffOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return hausdorff(P, Q, options, control);
}

}  // namespace curvewise
