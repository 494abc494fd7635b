/// \file
/// The matrix profile of a record (Yeh et al. 2016): the nearest neighbour of every window, by the
/// Euclidean distance after each coordinate of a window is shifted and scaled.
///
/// Exact. The products of centred windows are updated along the diagonals of the table of all
/// pairs, with the formula of Zimmerman et al., "Matrix Profile XIV" (2019), and begin anew in
/// every tile. A bound of their rounding error is known for every tile. Pairs that may be nearer
/// than the nearest so far are computed by the definition.
///
/// Time O(m^2 d) for m windows in d dimensions, and O(length d) for each pair that is computed.
/// These are few unless rounding exceeds differences: if the level of a record is more than about
/// 10^10 times its deviation. Memory O(m d) for each thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"

namespace curvewise {

class Control;

/// The nearest neighbour of each window.
struct MatrixProfile {
    std::vector<double> distances;      ///< infinite where there is none
    std::vector<std::int64_t> indices;  ///< the earliest of equally near windows; -1 if none
};

/// `means` and `deviations` have a row for each window, which is the number of windows. Numbers x
/// of a window are compared as (x - mean) / deviation, or as 0 where the deviation is 0. Each mean
/// and deviation is that of its window's numbers, to rounding. Windows whose starts differ by at
/// most `exclusion` are not compared. The largest |x| should be between 2^-500 and 2^500.
///
/// The squares of a distance are added in the order of coordinates, then points. The result is the
/// same for every number of workers. Throws std::invalid_argument for shapes that do not fit, a
/// negative exclusion, and numbers that are not finite; std::bad_alloc and Stopped.
[[nodiscard]] CURVEWISE_EXPORT MatrixProfile
matrix_profile(const CurveView& record, const CurveView& means, const CurveView& deviations,
               std::ptrdiff_t exclusion, std::ptrdiff_t workers = 1, Control* control = nullptr);

}  // namespace curvewise
