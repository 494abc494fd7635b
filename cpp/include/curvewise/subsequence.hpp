/// \file
/// Where in a long curve a short one occurs: the k best runs of Q for P, under dtw or the discrete
/// Fréchet distance (subsequence DTW: Müller 2007, chapter 7).
///
///     for (const curvewise::Subsequence& found : curvewise::subsequences(cycle, record, 10)) {
///         std::printf("%td to %td: %g\n", found.start, found.stop, found.distance);
///     }
///
/// The first answer is the best of all runs of consecutive points of Q, what dtw with open_begin
/// and open_end finds. Each later one is the best run of what is left of Q: of the pieces between,
/// before and behind the earlier answers, each of them searched as if it were all of Q. Answers do
/// not overlap, and their distances never fall. Of equal distances the run that ends first is the
/// better.
///
/// Exact. One sweep of the table, O(n m), that carries along with every value where in Q its path
/// began; after each answer only those ends behind it are swept again whose paths began before its
/// end. Memory O(n + m).
#pragma once

#include <cstddef>
#include <vector>

#include "curvewise/control.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/export.h"
#include "curvewise/frechet.hpp"

namespace curvewise {

/// A run of consecutive points of Q.
struct Subsequence {
    double distance;       ///< of P and the run
    std::ptrdiff_t start;  ///< the run's first point of Q, and its last
    std::ptrdiff_t stop;
};

/// Fewer than `count` where Q has no more runs, or none within the options' cutoff. Throws
/// std::invalid_argument for what dtw and frechet refuse, for a count below 1, for a window, and
/// for a step pattern other than symmetric1; std::bad_alloc; Stopped. Open ends need not be asked
/// for.
CURVEWISE_EXPORT std::vector<Subsequence> subsequences(const CurveView& P, const CurveView& Q,
                                                       std::ptrdiff_t count = 1,
                                                       const DtwOptions& options = {},
                                                       Control* control = nullptr);
/// The same under the discrete Fréchet distance.
CURVEWISE_EXPORT std::vector<Subsequence> subsequences(const CurveView& P, const CurveView& Q,
                                                       std::ptrdiff_t count,
                                                       const FrechetOptions& options,
                                                       Control* control = nullptr);

/// How far the runs of a curve lie outside of boxes.
struct RunsOutside {
    std::vector<double> totals;  ///< of each run
    std::vector<double> scales;  ///< 1 / deviation: of coordinate c of run k, at [c * runs + k]
};

/// For every run of Q of as many points as there are boxes, the sum, or the largest, of the
/// distances of its points to their boxes, after each of the run's coordinates has been shifted and
/// scaled to mean 0 and deviation 1 (both of the run's own numbers, in two passes). Where the boxes
/// hold the points that a curve may have matched with each, dtw and frechet of the normalised run
/// are not below it, except for rounding, which differs by level (Keogh and Ratanamahatana 2005).
/// Where a coordinate stands still, or its squares leave the range of a double, its scale is not
/// to be relied on, nor is the total. O(n m d) time, O(m d) memory.
///
/// `low` and `high` are the boxes' corners. Throws std::invalid_argument for shapes that differ, no
/// boxes, minkowski (except in one dimension), and haversine; std::bad_alloc.
CURVEWISE_EXPORT RunsOutside runs_outside(const CurveView& low, const CurveView& high,
                                          const CurveView& Q, Metric metric, bool of_largest);

}  // namespace curvewise
