// Lower bounds of dtw and frechet between one curve, P, and many stored curves, Q, from cheap to
// expensive. A search tests them before it computes a distance.
//
//   level 0   the distances of the ends; how far one box reaches beyond the other
//   level 1   both curves cut into about 8 runs. For each run, the distance of its box to the
//             nearest box of the other curve, times its points, added up (dtw); the largest
//             distance (frechet). The larger result of P's runs and of Q's
//   level 2   the same with about 32 runs
//   level 3   each point instead of the runs, against about 48 boxes
//
// In the dimension d, the levels take O(d), O(64 d), O(1000 d) and O(48 (n + m) d) time, the last
// one in SIMD. In one dimension, boxes are intervals. Points are compared with few of them, or with
// an interval for each point (matched_values.hpp). Level 1 then uses Q's points alone, in O(m),
// level 2 those of Q and P in O(n + m). Further levels do not help.
//
// With a window, a point or a run has only the boxes that its band reaches: the bound of Keogh &
// Ratanamahatana (2005) with several boxes instead of one. In narrow bands of several dimensions,
// each point has one box around the points of its band, and the levels are those of one dimension.
// In one dimension, the sum over rows and the sum over columns can be added. The rows are then not
// compared with Q's points, but with the values nearest to Q's points that P holds in their bands:
// the bound of Lemire (2009). A cell costs at least the way from q to that value, and from there to
// p. The terms of the last level also bound the cost of the rest of a path. A sweep with a cutoff
// skips cells that cost too much (live_columns.hpp).
//
// No bound is above the computed value. Distances to boxes are computed by the monotone operations
// of the ground distance (kernels/boxes.inl.hpp), and those of the ends in the table's own order,
// without slack. Sums in another order than the table's get the slack of CostSums. Ground distances
// that are not norms (kernels/metrics.inl.hpp), and curves outside the usual range, have the bound
// 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "curves/checks.hpp"
#include "runtime/aligned_buffer.hpp"
#include "runtime/scratch.hpp"
#include "warping/box_tree.hpp"
#include "warping/cost_sums.hpp"
#include "warping/first_bounds.hpp"
#include "warping/kept_bounds.hpp"
#include "warping/kept_boxes.hpp"
#include "warping/line_table.hpp"
#include "warping/matched_values.hpp"
#include "warping/packed_curve.hpp"
#include "warping/warping_problem.hpp"

namespace curvewise::warping {

// The boxes of one curve that the band leaves each point of the other, kept while the numbers of
// points do not change.
class BandedBoxes {
   public:
    // Of `count` points, in the order in which they are stored.
    // Of a curve of `size` points, `points_per_box` in a box.
    void assign(std::ptrdiff_t count, PointOrder order, std::ptrdiff_t size,
                std::ptrdiff_t points_per_box, std::optional<std::ptrdiff_t> window);
    // These boxes for the kernel, which needs the points besides.
    kernels::PointsAndBoxes of(const BoxLevel& boxes) const noexcept;

   private:
    std::ptrdiff_t count_ = -1;
    std::ptrdiff_t size_ = -1;
    bool is_limited_ = false;
    runtime::ScratchVector<std::ptrdiff_t> first_;
    runtime::ScratchVector<std::ptrdiff_t> last_;
};

// The bounds of one P. For one thread.
class PairBounds {
   public:
    static constexpr int levels = 4;

    // All must outlive this.
    PairBounds(const WarpingOptions& options, const KeptBounds& kept, const CheckedCurve& P,
               const PackedCurve& packed);

    // Level 0.
    const FirstBounds& first() const noexcept { return first_; }
    // Whether the bound of curve j includes the distances of the ends.
    bool has_looked_at_ends(std::ptrdiff_t j) const noexcept { return is_bounded(j); }
    // That of a level above 0 and curve j, whose points are `q`.
    double refined(std::ptrdiff_t j, const PackedCurve& q, int level);
    // The least cost of the rest of a path, for a sweep that skips cells above `most`, in the unit
    // of the table. Returns nullopt if the measure's own pruning is better, or if bounds do not
    // exist. Valid until the next call.
    std::optional<CostToGo> cost_to_go(std::ptrdiff_t j, const PackedCurve& q, double most);
    // Whether the table's value, or one above `most`, follows from that without a general sweep.
    bool is_of_lines() const noexcept;
    double line_value(const PackedCurve& q, const CostToGo& cost_to_go);
    // Whether every path costs more than the last of these says.
    bool is_hopeless(const CostToGo& cost_to_go) const noexcept {
        return sums_.all() * cost_to_go.slack > cost_to_go.most;
    }

   private:
    bool is_bounded(std::ptrdiff_t j) const noexcept {
        return first_.is_bounded(kept_[j].largest());
    }
    bool is_frechet() const noexcept { return options_.rule == kernels::Rule::frechet; }
    bool is_open() const noexcept { return options_.open_begin || options_.open_end; }
    template <class Norm>
    double run_bound(std::ptrdiff_t j, int level);
    double point_bound(std::ptrdiff_t j, const PackedCurve& q);
    double column_bound(std::ptrdiff_t j, const PackedCurve& q);
    // The bound of a level above 0, before it is divided.
    double undivided(std::ptrdiff_t j, const PackedCurve& q, int level);
    bool is_line() const noexcept { return tree_.dim() == 1; }
    bool is_banded() const noexcept { return options_.window.radius || options_.window.fraction; }
    // Whether each point has a box for itself, in several dimensions.
    bool has_narrow_band(std::ptrdiff_t m) const noexcept;
    BoxLevel point_level_boxes() const noexcept;
    bool is_symmetric2() const noexcept { return options_.rule == kernels::Rule::dtw_symmetric2; }
    bool has_ways_through(const PackedCurve& q) const noexcept;
    void compute_row_terms(std::ptrdiff_t j, const PackedCurve& q);
    // Of boxes for each point, within a band and without open ends.
    void compute_banded_row_terms(std::ptrdiff_t j, const PackedCurve& q);
    void compute_column_terms(std::ptrdiff_t j, const PackedCurve& q);
    // The distances of `points` to the nearest of these boxes.
    void compute_terms(const PackedCurve& points, kernels::PointsAndBoxes boxes,
                       AlignedBuffer& terms) const;
    // The larger of the costs of P's parts and of Q's, or their sum.
    double combined(double rows, double columns, double first_row, double first_column) const;

    const WarpingOptions& options_;
    const KeptBounds& kept_;
    const PackedCurve& P_;
    Metric metric_;
    kernels::LeastFunction kernel_;  // null if bounds do not exist
    kernels::ExtremesFunction extremes_;
    BoxTree tree_;
    FirstBounds first_;
    // The most recent terms of the last level: P's points in order or in reverse, Q's in their
    // stored order.
    AlignedBuffer row_terms_;
    AlignedBuffer column_terms_;
    std::ptrdiff_t row_terms_of_ = -1;
    std::ptrdiff_t column_terms_of_ = -1;
    bool they_add_;  // the row terms, to the column terms
    bool rows_are_reversed_ = false;
    BandedBoxes boxes_of_rows_;
    BandedBoxes boxes_of_columns_;
    BandedValues values_of_rows_;
    BandedValues values_of_columns_;
    AlignedBuffer reversed_;  // P, if its points may have a box each, by coordinate
    std::ptrdiff_t reversed_stride_ = 0;
    AlignedBuffer nearest_values_;  // nearest to Q's points, among those of their bands in P
    AlignedBuffer merged_;          // boxes of P, in one dimension
    AlignedBuffer merged_of_kept_;  // of Q
    std::ptrdiff_t merged_count_ = 0;
    runtime::ScratchVector<double> run_terms_;
    BoxRoom boxes_;  // of Q
    CostSums sums_;
    LineTable line_table_;
};

}  // namespace curvewise::warping
