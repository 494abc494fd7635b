// Lower bounds of the continuous Fréchet distance between one curve, P, and many stored curves, Q,
// from cheap to expensive. A search tests them before it computes a distance.
//
//   level 0   O(d)       the distances of the ends; how far one box reaches beyond the other
//   level 1   O(64 d)    both curves cut into about 8 runs of edges: the largest distance of a
//                        run's box to the nearest box of the other curve
//   level 2   O(1000 d)  the same with about 32 runs
//
// The distance is the real number, rounded up. Each bound is reduced by a little more than rounding
// can have raised it. Curves outside the usual range have the bound 0.
#pragma once

#include <cstddef>

#include "continuous/boxed_curve.hpp"
#include "curves/checks.hpp"
#include "pairwise/bound_tree.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

// The first point of a curve, the last, and its box; and the largest |coordinate|.
class CurveSummary {
   public:
    CurveSummary(const curves::CheckedCurve& checked, const BoxedCurve& boxed);

    // A lower bound from the summaries of two curves with `dim` coordinates.
    double bound(const CurveSummary& other, std::ptrdiff_t dim) const noexcept;
    double largest() const noexcept { return largest_; }

    // The row of this curve for trees over these bounds (pairwise/bound_tree.hpp): all its numbers,
    // the largest |coordinate| last.
    pairwise::RowShape row_shape() const noexcept {
        const auto count = static_cast<std::ptrdiff_t>(numbers_.size());
        return {count + 1, count};
    }
    void write_row(double* row) const noexcept;
    // Not above the bound of any curve with its row in the box, if all of these are plain.
    double bound_of_box(const double* box, std::ptrdiff_t dim) const noexcept;

   private:
    double largest_;
    runtime::ScratchVector<double> numbers_;
};

// At most `most_runs` of either curve.
double run_bound(const BoxedCurve& P, const BoxedCurve& Q, std::ptrdiff_t most_runs);

}  // namespace curvewise::continuous
