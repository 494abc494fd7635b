// The first bound of dtw and frechet between one curve, P, and many stored curves: the distances of
// the ends, and how far one box reaches beyond the other. O(d) for d coordinates. A box around the
// summaries of several curves has a bound, too, for trees over the bounds
// (pairwise/bound_tree.hpp).
//
// No bound is above the computed value. Distances are computed by the monotone operations of the
// ground distance, and those of the ends in the table's own order, without slack. Curves outside
// the usual range, and ground distances without bounds, have the bound 0.
#pragma once

#include <algorithm>
#include <cstddef>

#include "curves/checks.hpp"
#include "pairwise/bound_tree.hpp"
#include "runtime/scratch.hpp"
#include "warping/box_tree.hpp"
#include "warping/kept_bounds.hpp"
#include "warping/warping_problem.hpp"

namespace curvewise::warping {

class FirstBounds {
   public:
    // `tree` is P's. All but it must outlive this.
    FirstBounds(const WarpingOptions& options, const KeptBounds& kept, const CheckedCurve& P,
                const BoxTree& tree);

    // Of `count` kept curves from `first` on, or of those of a leaf.
    void quick(std::ptrdiff_t first, std::ptrdiff_t count, double* bounds) const;
    void quick(std::ptrdiff_t first, const pairwise::BoundTree::Leaf& leaf, double* bounds) const;
    // Of `count` boxes around rows of curves: not above the bound of any curve in the box.
    void of_boxes(const double* boxes, std::ptrdiff_t count, double* bounds) const;

    // Whether there are bounds of a curve whose largest |coordinate| this is.
    bool is_bounded(double largest) const noexcept;
    // The metric of distances to boxes, and what makes bounds of such distances.
    Metric box_metric() const noexcept { return box_metric_; }
    void finish(double* bounds, std::ptrdiff_t count) const noexcept;

   private:
    bool is_frechet() const noexcept { return options_.rule == kernels::Rule::frechet; }
    bool is_open() const noexcept { return options_.open_begin || options_.open_end; }
    // Of a curve that has bounds.
    template <class Norm>
    double of_curve(const KeptCurve& curve) const noexcept;
    template <class Norm>
    double of_box(const double* box) const noexcept;
    // From the distances of the ends, and of the box that reaches farthest beyond the other.
    double bound_of(double first, double last, double beyond, bool is_sum) const noexcept;

    const WarpingOptions& options_;
    const KeptBounds& kept_;
    Metric metric_;
    Metric box_metric_;
    bool has_bounds_;
    double largest_;
    std::ptrdiff_t n_;
    std::ptrdiff_t dim_;
    runtime::ScratchVector<double> summary_;
};

}  // namespace curvewise::warping
