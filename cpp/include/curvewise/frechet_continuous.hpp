/// \file
/// The continuous Fréchet distance of two polygonal curves. Two walkers go along the curves at any
/// speeds, never back; the distance is the smallest possible maximum of their distance. Unlike the
/// discrete distance, it does not depend on the sampling of a curve: points added on an edge change
/// nothing. Euclidean, in any dimension.
///
/// The value is exact: it is always the real number, rounded up to the next double, for curves of
/// any length and any distance from the origin. Comparisons that rounded arithmetic cannot decide
/// are made in whole numbers. So the value does not depend on the order or the direction of the
/// curves. It is exactly 0 for curves that differ only in points on straight edges.
///
/// The algorithm searches the free-space diagram of Alt & Godau (1995) with filters and boxes, as
/// Bringmann, Künnemann & Nusser (2019) do. Time about O((n + m) log(n + m)) for similar curves,
/// O(n m log) at worst; memory O(n + m). Throws std::invalid_argument for a curve that is empty or
/// not finite, and for curves of different dimension. Throws std::bad_alloc and Stopped. Safe from
/// any number of threads.
///
///     const double distance = curvewise::frechet_continuous(experiment, simulation);
///     if (curvewise::frechet_within(experiment, simulation, 0.1)) std::puts("close enough");
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// How frechet_continuous() is computed.
struct FrechetContinuousOptions {
    static constexpr const char* measure = "frechet_continuous";
    static constexpr bool is_planar = false;  ///< for curves of any dimension

    /// As for the other measures of any dimension. One pair is searched by one thread, however.
    std::ptrdiff_t workers = 1;

    static constexpr bool is_symmetric() noexcept { return true; }
    /// The elementary steps, of some nanoseconds each, that curves of n and m points may take.
    constexpr double work(double n, double m, double /*dim*/) const noexcept { return 10 * n * m; }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(FrechetContinuousOptions& options, Visit&& visit) {
    visit("workers", options.workers, workers_range);
}

/// Two doubles that a real number lies between.
struct Interval {
    double low = 0.0;
    double high = 0.0;
};

/// The real number rounded up; inf if it is beyond the range of a double.
[[nodiscard]] CURVEWISE_EXPORT double frechet_continuous(
    const CurveView& P, const CurveView& Q, const FrechetContinuousOptions& options = {},
    Control* control = nullptr);

/// The same, and the real number rounded down: equal to it, or the double below it.
[[nodiscard]] CURVEWISE_EXPORT Interval
frechet_continuous_bounds(const CurveView& P, const CurveView& Q,
                          const FrechetContinuousOptions& options = {}, Control* control = nullptr);

/// Two walks that attain the distance.
struct Matching {
    /// The largest distance between the walkers, which is frechet_continuous(). If rounding of the
    /// parameters increases it, it is the least double that is not below the parameters' distance.
    /// The increase is some units in the last place of the longest edge times the number of points.
    double distance = 0.0;
    /// Pairs of a parameter of P and one of Q, each a vertex's index plus a fraction of the edge
    /// behind it. Neither ever decreases; the first are 0, the last the indices of the last points;
    /// between two rows both walks stay on one edge, at steady speeds.
    std::vector<std::array<double, 2>> parameters;
};

/// Among the matchings within the distance, prefers one that keeps the curves close. Twice the time
/// of the distance. Memory O(n + m), and sqrt(n) times the number of separate sections in a row of
/// the free-space diagram.
[[nodiscard]] CURVEWISE_EXPORT Matching
frechet_continuous_path(const CurveView& P, const CurveView& Q,
                        const FrechetContinuousOptions& options = {}, Control* control = nullptr);

/// The section of Q that is nearest to P by the continuous distance: its matching with P. It begins
/// and ends at any points of Q, the second parameters of the first and the last row. The decisions
/// let paths begin and end anywhere in the first and the last row of the free-space diagram (Alt &
/// Godau 1995). Exact as frechet_continuous_path(). Time a few walks through the diagram, and at
/// worst about 60.
[[nodiscard]] CURVEWISE_EXPORT Matching
frechet_continuous_part(const CurveView& P, const CurveView& Q,
                        const FrechetContinuousOptions& options = {}, Control* control = nullptr);

/// The distance of closed curves: the least over where they begin, at any of their points. The last
/// point is joined to the first, unless it equals the first; then it only closes the curve. So
/// neither rotations of a curve nor points added on an edge change the value. Exact and symmetric
/// as frechet_continuous(). Decisions walk through the free-space diagram of P and twice Q, from a
/// point of its first row to the point one turn behind it (Alt & Godau 1995). Time one walk for
/// many similar curves. Otherwise about 20 decisions; most are one walk of O(n m), and a few take
/// one for each section of Q that is near one vertex of P. Memory O(n + m).
[[nodiscard]] CURVEWISE_EXPORT double closed_frechet_continuous(
    const CurveView& P, const CurveView& Q, const FrechetContinuousOptions& options = {},
    Control* control = nullptr);

/// The same, and the real number rounded down, as of frechet_continuous_bounds().
[[nodiscard]] CURVEWISE_EXPORT Interval closed_frechet_continuous_bounds(
    const CurveView& P, const CurveView& Q, const FrechetContinuousOptions& options = {},
    Control* control = nullptr);

/// Walks around two closed curves that attain the distance. With n and m points, without a last one
/// that equals the first, the parameters of P lead from 0 to n, and those of Q from some t below m
/// to t + m, where m + k is point k again. The walks begin at P's first point, and at the nearest
/// point of Q if that attains the distance. Memory as for frechet_continuous_path().
[[nodiscard]] CURVEWISE_EXPORT Matching closed_frechet_continuous_path(
    const CurveView& P, const CurveView& Q, const FrechetContinuousOptions& options = {},
    Control* control = nullptr);

/// Whether the continuous distance, or the discrete one of Euclidean distances, is at most
/// `distance`, a number >= 0. The decision is about the real numbers, not about rounded ones.
/// Faster than the distance, and far faster for curves that lie far apart.
[[nodiscard]] CURVEWISE_EXPORT bool frechet_within(const CurveView& P, const CurveView& Q,
                                                   double distance, bool continuous = true,
                                                   Control* control = nullptr);

/// For code that treats all measures in the same way (measure.hpp).
[[nodiscard]] inline double evaluate(const FrechetContinuousOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return frechet_continuous(P, Q, options, control);
}

}  // namespace curvewise
