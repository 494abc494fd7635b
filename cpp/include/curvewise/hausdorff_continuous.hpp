/// \file
/// The Hausdorff distance between two polygonal curves: the largest distance of a point of either
/// curve from the other curve, points between the vertices included. hausdorff() compares the
/// vertices alone, so it depends on the sampling of the curves; this distance does not. Euclidean,
/// in any dimension.
///
///     max(max over x on P of min over y on Q of |x - y|, max over y of min over x)
///
/// Along an edge, the distance to one edge of the other curve is convex. So the farthest point of
/// an edge is one of its ends, or a point at which the nearest edge changes. These points are
/// computed, without sampling. The value differs from the real number by at most 2^-46 times the
/// largest |coordinate|. Time about O((n + m) log(n + m)) for similar curves, O(n m) at worst;
/// memory O(n + m). Throws std::invalid_argument for a curve that is empty or not finite, and for
/// curves of different dimension. Throws std::bad_alloc and Stopped. Safe from any number of
/// threads.
///
///     const auto found = curvewise::hausdorff_continuous_points(track, road);
///     std::printf("%g at %g\n", found.distance, found.from_p.parameter);
#pragma once

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// Which distances hausdorff_continuous() compares.
struct HausdorffContinuousOptions {
    static constexpr const char* measure = "hausdorff_continuous";
    static constexpr bool is_planar = false;  ///< for curves of any dimension

    /// Only how far points of P are from Q.
    bool directed = false;

    constexpr bool is_symmetric() const noexcept { return !directed; }
    /// The elementary steps, of some nanoseconds each, that curves of n and m points may take.
    constexpr double work(double n, double m, double /*dim*/) const noexcept { return 10 * n * m; }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(HausdorffContinuousOptions& options, Visit&& visit) {
    visit("directed", options.directed);
}

/// The distance, in units of the coordinates; infinity if it is beyond the range of a double.
[[nodiscard]] CURVEWISE_EXPORT double hausdorff_continuous(
    const CurveView& P, const CurveView& Q, const HausdorffContinuousOptions& options = {},
    Control* control = nullptr);

/// The point of a curve that is farthest from another curve, and the point of that nearest to it.
struct FarthestPoint {
    double distance = 0.0;
    /// Places of the two points: the index of a vertex plus a fraction of the edge behind it.
    double parameter = 0.0, nearest = 0.0;
};

/// The points that a distance is the distance of.
struct HausdorffPoints {
    double distance = 0.0;  ///< hausdorff_continuous()
    FarthestPoint from_p;   ///< the point of P that is farthest from Q
    FarthestPoint from_q;   ///< the point of Q that is farthest from P; not sought if directed
};

/// Both directed distances with the points that attain them; of equally far points one of them.
[[nodiscard]] CURVEWISE_EXPORT HausdorffPoints hausdorff_continuous_points(
    const CurveView& P, const CurveView& Q, const HausdorffContinuousOptions& options = {},
    Control* control = nullptr);

/// For code that treats all measures in the same way (measure.hpp).
[[nodiscard]] inline double evaluate(const HausdorffContinuousOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return hausdorff_continuous(P, Q, options, control);
}

}  // namespace curvewise
