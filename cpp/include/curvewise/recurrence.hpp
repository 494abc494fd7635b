/// \file
/// A recurrence over all pairs of points of two curves, as data: each variant of dynamic time
/// warping and each edit distance is one value of this type.
///
///     c[i, j] = min over steps of  c[i - rows, j - columns] + constant + sum of weight x term
///
/// The terms are added in this order; CostFrom defines them. Weights may be negative. A step is
/// infinite if one of its terms is, whatever that term's weight. A term of weight 0 is ignored. The
/// value is c in the last cell, or at the end of a path with free ends, divided as Per defines.
/// Time O(n m) times the number of terms; memory O(n + m) for a value, O((n + m) log n) for a path.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "curvewise/alignment.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/ground_distance.hpp"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// The cost that a step adds for a cell that lies some rows and columns behind its end.
enum class CostFrom {
    pair,         ///< the cost of the two points, see PairCost
    row_gap,      ///< cost of deleting the row's point of P, see Gaps
    column_gap,   ///< the same of the column's point of Q
    offset,       ///< |i - j|
    row_move,     ///< msm: how far x_i lies outside of the interval from x_{i-1} to y_j
    column_move,  ///< msm: how far y_j lies outside of the interval from y_{j-1} to x_i
};

struct StepTerm {
    int rows;  ///< behind the end of the step
    int columns;
    double weight;  ///< 0 if the path visits a cell that costs nothing
    CostFrom from = CostFrom::pair;
};

struct Step {
    int rows;  ///< from the cell before, in all
    int columns;
    double constant;
    std::vector<StepTerm> terms;  ///< in the order in which they are added
};

/// The cost of the pair of points P_i and Q_j; d is their ground distance.
enum class PairCost {
    distance,  ///< d
    apart,     ///< 1 if d >= threshold, else 0
    together,  ///< -1 if d <= threshold, else 0
    weighted   ///< d / (1 + exp(-steepness (|i - j| - max(n, m) / 2)))
};

/// The cost of a deleted point.
enum class Gaps {
    none,
    to_point,    ///< its distance from the point whose coordinates are all `gap`
    to_previous  ///< its distance from the one before, 0 being before the first
};

/// The values before the first row and the first column.
enum class Border {
    none,      ///< paths start at the first cell, with its cost
    zero,      ///< 0
    all_gaps,  ///< the sum of all gaps of P before the first column, of Q above the first row
    origin     ///< 0 at the corner, else infinity; a point 0 is before the first of each curve
};

/// The divisor of the last cell.
enum class Per {
    one,
    rows,     ///< n
    columns,  ///< m
    both,     ///< n + m
    longer,   ///< max(n, m)
    matches   ///< the value is 1 + c / min(n, m), and not below 0
};

/// Maximum number of points that a path may omit at the beginning and at the end of each curve. The
/// path begins in one of the first cells of the first row or column, with the cost of the cell. It
/// ends in one of the last cells of the last row or column. `all` means any number.
struct FreeEnds {
    static constexpr std::ptrdiff_t all = std::numeric_limits<std::ptrdiff_t>::max();

    std::ptrdiff_t p_begin = 0;
    std::ptrdiff_t p_end = 0;
    std::ptrdiff_t q_begin = 0;
    std::ptrdiff_t q_end = 0;
    /// The end minimises c divided by this divisor; n and m are the points up to the end. Among
    /// equal ends, the first in the last row wins, or else the first in the last column.
    Per per = Per::one;

    constexpr bool are_free() const noexcept {
        return p_begin > 0 || p_end > 0 || q_begin > 0 || q_end > 0;
    }
};

struct Recurrence {
    const char* measure;
    std::vector<Step> steps;  ///< of equal ones the first is taken
    GroundDistance ground;
    PairCost pair = PairCost::distance;
    /// Of `apart` and `together`; for `apart`, infinity selects a quarter of the larger deviation.
    double threshold = 0.0;
    double steepness = 0.0;
    Gaps gaps = Gaps::none;
    double gap = 0.0;
    Border border = Border::none;
    Per per = Per::one;
    bool by_coordinate = false;  ///< a table for each coordinate, and their sum
    std::optional<std::ptrdiff_t> window = std::nullopt;
    std::optional<double> window_fraction = std::nullopt;
    double cutoff = std::numeric_limits<double>::infinity();
    FreeEnds ends = {};  ///< for a border of `none`

    /// Whether P and Q may change places.
    [[nodiscard]] CURVEWISE_EXPORT bool is_symmetric() const;
};

/// Throws std::invalid_argument as dtw() does, and for steps of more than eight rows or columns, or
/// with terms outside of them.
[[nodiscard]] CURVEWISE_EXPORT double warp(const Recurrence& recurrence, const CurveView& P,
                                           const CurveView& Q, Control* control = nullptr);
/// The cells that a cheapest path visits, including those between the ends of its steps. Empty if
/// the steps admit no path. If every path is infinite, the cells of one of them. Throws
/// std::invalid_argument for one table per coordinate, because there are then several paths.
[[nodiscard]] CURVEWISE_EXPORT Alignment warp_path(const Recurrence& recurrence, const CurveView& P,
                                                   const CurveView& Q, Control* control = nullptr);
/// Writes c to out[i * m + j]; infinity outside the window.
CURVEWISE_EXPORT void warp_table(const Recurrence& recurrence, const CurveView& P,
                                 const CurveView& Q, double* out, Control* control = nullptr);

}  // namespace curvewise
