/// \file
/// A recurrence over all pairs of points of two curves, as data: each variant of dynamic time
/// warping and each edit distance is one value of this type.
///
///     c[i, j] = min over steps of  c[i - rows, j - columns] + constant + sum of weight x term
///
/// Weights may be negative. A step is infinite if one of its terms is, whatever that term's weight.
/// A term of weight 0 takes no part.
///
/// added up in this order. What a term is, CostFrom says. The value is c in the last cell, or
/// where a path with free ends ends, divided as Per says. Time O(n m) times the number of terms;
/// memory O(n + m) for a value, O((n + m) log n) for a path.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "curvewise/alignment.hpp"
#include "curvewise/control.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/ground_distance.hpp"
#include "curvewise/options.hpp"

namespace curvewise {

/// What a step adds for a cell that lies some rows and columns behind its end.
enum class CostFrom {
    pair,         ///< the cost of the two points, see PairCost
    row_gap,      ///< what leaving out the row's point of P costs, see Gaps
    column_gap,   ///< the same of the column's point of Q
    offset,       ///< |i - j|
    row_move,     ///< msm: how far x_i lies outside of the interval from x_{i-1} to y_j
    column_move,  ///< msm: how far y_j lies outside of the interval from y_{j-1} to x_i
};

struct StepTerm {
    int rows;  ///< behind the end of the step
    int columns;
    double weight;  ///< 0 where the path visits a cell that costs nothing
    CostFrom from = CostFrom::pair;
};

struct Step {
    int rows;  ///< from the cell before, in all
    int columns;
    double constant;
    std::vector<StepTerm> terms;  ///< in the order in which they are added
};

/// What the pair of points P_i and Q_j costs; d is their ground distance.
enum class PairCost {
    distance,  ///< d
    apart,     ///< 1 where d >= threshold, else 0
    together,  ///< -1 where d <= threshold, else 0
    weighted   ///< d / (1 + exp(-steepness (|i - j| - max(n, m) / 2)))
};

/// What a point that is left out costs.
enum class Gaps {
    none,
    to_point,    ///< its distance from a point all of whose coordinates are `gap`
    to_previous  ///< its distance from the one before, 0 being before the first
};

/// What lies before the first row and the first column.
enum class Border {
    none,      ///< paths start at the first cell, with its cost
    zero,      ///< 0
    all_gaps,  ///< the sum of all gaps of P before the first column, of Q above the first row
    origin     ///< 0 at the corner, else infinity; a point 0 is before the first of each curve
};

/// What the last cell is divided by.
enum class Per {
    one,
    rows,     ///< n
    columns,  ///< m
    both,     ///< n + m
    longer,   ///< max(n, m)
    matches   ///< the value is 1 + c / min(n, m), and not below 0
};

/// How many points a path may leave out at the beginning and at the end of each curve: it begins in
/// one of the first cells of the first row or column, with the cost of the cell, and ends in one of
/// the last cells of the last row or column. For curves of any length `all`.
struct FreeEnds {
    static constexpr std::ptrdiff_t all = std::numeric_limits<std::ptrdiff_t>::max();

    std::ptrdiff_t p_begin = 0;
    std::ptrdiff_t p_end = 0;
    std::ptrdiff_t q_begin = 0;
    std::ptrdiff_t q_end = 0;
    /// The end is the one where c divided so is least, n and m being the points up to there; of
    /// equal ones the first in the last row, or else in the last column.
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
    double threshold = 0.0;  ///< of `apart` and `together`; none: a quarter of the larger deviation
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
    CURVEWISE_EXPORT bool is_symmetric() const;
};

/// Throws std::invalid_argument as dtw() does, and for steps that go beyond eight rows or columns,
/// or whose terms lie outside of them.
CURVEWISE_EXPORT double warp(const Recurrence& recurrence, const CurveView& P, const CurveView& Q,
                             Control* control = nullptr);
/// The cells that a cheapest path visits, those between the ends of its steps among them. None
/// where the steps admit no path; where every path is infinite, the cells of one of them. Throws
/// std::invalid_argument for a table for each coordinate, where there are several paths.
CURVEWISE_EXPORT Alignment warp_path(const Recurrence& recurrence, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr);
/// Writes c to out[i * m + j]; infinity outside the window.
CURVEWISE_EXPORT void warp_table(const Recurrence& recurrence, const CurveView& P,
                                 const CurveView& Q, double* out, Control* control = nullptr);

namespace pairwise {  // for pairwise.hpp
std::unique_ptr<const class BatchMeasure> batch_measure(const Recurrence& recurrence);
}  // namespace pairwise

}  // namespace curvewise
