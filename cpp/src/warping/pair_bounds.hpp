// Lower bounds of dtw and frechet between one curve, P, and many that are kept, Q, from cheap to
// dear: what a search looks at before it computes a distance.
//
//   level 0   O(d)            the distances of the ends; how far one box reaches beyond the other
//   level 1   O((n + m) 8 d)  every point against some 8 boxes around runs of the other curve: the
//                             sum (dtw) or the maximum (frechet) of its distances to the nearest,
//                             of P's points and of Q's, the larger of the two
//   level 2   six times that  the same with some 48 boxes
//
// A window leaves a point only the boxes that its band reaches, which is the bound of Keogh &
// Ratanamahatana (2005) with several boxes in the place of their one. The terms of the last level
// say, besides, what the rest of a path costs at least: a sweep with a cutoff leaves out what is
// too dear (live_columns.hpp).
//
// No bound is above the value as it is computed. Distances to boxes are computed by the monotone
// operations of the ground distance (kernels/boxes.inl.hpp), and the ends' in the table's own
// order: no slack. Sums in another order than the table's get the slack of CostSums. minkowski,
// whose powers round as they like, and curves outside the usual range, have the bound 0.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "curves/checks.hpp"
#include "runtime/aligned_buffer.hpp"
#include "warping/box_tree.hpp"
#include "warping/cost_sums.hpp"
#include "warping/packed_curve.hpp"
#include "warping/warping_problem.hpp"

namespace curvewise::detail {

// What is kept of each Q besides its points: its ends and its box, one curve behind the other, and
// its boxes.
class KeptBounds {
   public:
    // `packed` must outlive this, at the address of its points.
    void keep(const CheckedCurve& Q, const PackedCurve& packed, PointOrder order);
    // Adds those of `others`, and leaves it empty.
    void take(KeptBounds& others);

    std::ptrdiff_t size() const noexcept { return static_cast<std::ptrdiff_t>(trees_.size()); }
    double largest(std::ptrdiff_t j) const noexcept { return largest_[static_cast<std::size_t>(j)]; }
    // The first point, the last, the lowest coordinates, the highest.
    const double* summary(std::ptrdiff_t j) const noexcept {
        return summaries_.data() + j * 4 * dim_;
    }
    const BoxTree& tree(std::ptrdiff_t j) const noexcept {
        return trees_[static_cast<std::size_t>(j)];
    }

   private:
    std::ptrdiff_t dim_ = 0;
    std::vector<double> largest_;  // |coordinate|
    std::vector<double> summaries_;
    std::vector<BoxTree> trees_;
};

// Of one P. For one thread.
class PairBounds {
   public:
    static constexpr int levels = 3;

    // All must outlive this.
    PairBounds(const WarpingOptions& options, const KeptBounds& kept, const CheckedCurve& P,
               const PackedCurve& packed);

    // Those of level 0, of all kept curves.
    void quick(double* bounds) const;
    // That of level 1 or 2 and curve j, whose points are `q`.
    double refined(std::ptrdiff_t j, const PackedCurve& q, int level);
    // What the rest of a path costs at least, for a sweep that leaves out what is above `most`, in
    // the unit of the table. Nothing where the measure's own pruning does better, or where there
    // are no bounds. Valid until the next call.
    std::optional<CostToGo> cost_to_go(std::ptrdiff_t j, const PackedCurve& q, double most);

   private:
    bool is_bounded(std::ptrdiff_t j) const noexcept;
    bool is_frechet() const noexcept { return options_.recurrence == kernels::Recurrence::frechet; }
    bool is_open() const noexcept { return options_.open_begin || options_.open_end; }
    template <class Norm>
    double quick_bound(std::ptrdiff_t j) const noexcept;
    // Writes the distance of every point of a curve to the nearest box of the other.
    void least(const PackedCurve& points, PointOrder order, const BoxTree& boxes,
               std::ptrdiff_t most_boxes, AlignedBuffer& out);
    void compute_terms(std::ptrdiff_t j, const PackedCurve& q, int level);

    const WarpingOptions& options_;
    const KeptBounds& kept_;
    const PackedCurve& P_;
    Metric metric_;
    kernels::LeastFunction kernel_;
    double largest_;
    BoxTree tree_;
    std::vector<double> summary_;
    // The terms that were computed last: of P's points in order, of Q's as they are stored.
    AlignedBuffer row_terms_;
    AlignedBuffer column_terms_;
    std::ptrdiff_t terms_of_ = -1;
    int terms_level_ = 0;
    std::vector<std::ptrdiff_t> first_box_;
    std::vector<std::ptrdiff_t> last_box_;
    CostSums sums_;
};

}  // namespace curvewise::detail
