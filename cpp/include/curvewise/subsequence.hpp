/// \file
/// The places in a long curve where a short one occurs: the k best runs of Q for P, under dtw or
/// the discrete Fréchet distance (subsequence DTW: Müller 2007, chapter 7).
///
///     for (const curvewise::Subsequence& found : curvewise::subsequences(cycle, record, 10)) {
///         std::printf("%td to %td: %g\n", found.start, found.stop, found.distance);
///     }
///
/// The first answer is the best of all runs of consecutive points of Q, the result of dtw with
/// open_begin and open_end. Each later answer is the best run of the rest of Q: of the sections
/// between, before and behind the earlier answers. Each section is searched like a whole Q. Answers
/// do not overlap, and their distances never fall. Among equal distances, the run that ends first
/// is the better.
///
/// Exact. One sweep of the table, O(n m), carries along with every value the place in Q where its
/// path began. After each answer, only a part is swept again: ends behind the answer whose paths
/// began before its end. Memory O(n + m).
#pragma once

#include <cstddef>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/export.h"
#include "curvewise/frechet.hpp"

namespace curvewise {

class Control;

/// A run of consecutive points of Q.
struct Subsequence {
    double distance;       ///< of P and the run
    std::ptrdiff_t start;  ///< the run's first point of Q, and its last
    std::ptrdiff_t stop;
};

/// Returns fewer than `count` if Q has no further runs, or no further runs within the options'
/// cutoff. Throws std::invalid_argument as dtw and frechet do, for a count below 1, for a window,
/// and for a step pattern other than symmetric1. Throws std::bad_alloc and Stopped. Open ends are
/// implied.
[[nodiscard]] CURVEWISE_EXPORT std::vector<Subsequence> subsequences(const CurveView& P,
                                                                     const CurveView& Q,
                                                                     std::ptrdiff_t count = 1,
                                                                     const DtwOptions& options = {},
                                                                     Control* control = nullptr);
/// The same under the discrete Fréchet distance.
[[nodiscard]] CURVEWISE_EXPORT std::vector<Subsequence> subsequences(const CurveView& P,
                                                                     const CurveView& Q,
                                                                     std::ptrdiff_t count,
                                                                     const FrechetOptions& options,
                                                                     Control* control = nullptr);

/// How far the runs of a curve lie outside of boxes.
struct RunsOutside {
    std::vector<double> totals;  ///< of each run
    std::vector<double> scales;  ///< 1 / deviation: of coordinate c of run k, at [c * runs + k]
};

/// For every run of Q with one point for each box: the sum, or the largest, of the distances of its
/// points to their boxes. Each of the run's coordinates is first shifted and scaled to mean 0 and
/// deviation 1 (both of the run's own numbers, in two passes). If each box holds the points that a
/// curve may match there, dtw and frechet of the normalised run are not below the total, except for
/// rounding, which differs by level (Keogh and Ratanamahatana 2005). If a coordinate is constant,
/// or its squares leave the range of a double, its scale and the total are not reliable. O(n m d)
/// time, O(m d) memory.
///
/// `low` and `high` are the boxes' corners. Throws std::invalid_argument for different shapes, no
/// boxes, minkowski (except in one dimension), and haversine; std::bad_alloc.
[[nodiscard]] CURVEWISE_EXPORT RunsOutside runs_outside(const CurveView& low, const CurveView& high,
                                                        const CurveView& Q, Metric metric,
                                                        bool of_largest);

}  // namespace curvewise
