// Derivatives by places along a curve, brought back to the lengths of its segments. O(n).
#pragma once

#include <cstddef>

#include "runtime/scratch.hpp"

namespace curvewise::curves {

// The gradient of places at fixed shares of a curve's length: they move along it if it gets longer
// or shorter before or behind them.
class ArcGradient {
   public:
    explicit ArcGradient(const runtime::ScratchVector<double>& arc_lengths)
        : arc_lengths_(arc_lengths), by_arc_length_(arc_lengths.size(), 0.0) {}

    // By the fraction of `segment` at which a place is, which has `share` of the length before it.
    void add(std::size_t segment, double fraction, double share, double by_fraction) noexcept {
        const double length = arc_lengths_[segment + 1] - arc_lengths_[segment];
        if (!(length > 0.0)) return;
        by_arc_length_[segment] -= (1.0 - fraction) * by_fraction / length;
        by_arc_length_[segment + 1] -= fraction * by_fraction / length;
        by_arc_length_.back() += share * by_fraction / length;
    }

    // By the share of the length before vertex i.
    void add_share(std::size_t i, double share, double by_share) noexcept {
        const double length = arc_lengths_.back();
        if (!(length > 0.0)) return;
        by_arc_length_[i] += by_share / length;
        by_arc_length_.back() -= share * by_share / length;
    }

    // Calls visit(k, length, by_length) for each segment, from vertex k - 1 to k, that has a
    // length.
    template <class Visit>
    void for_each_segment(Visit visit) const {
        double by_length = 0.0;  // all arc lengths from vertex k on hold it
        for (std::size_t k = by_arc_length_.size() - 1; k > 0; --k) {
            by_length += by_arc_length_[k];
            const double length = arc_lengths_[k] - arc_lengths_[k - 1];
            if (length > 0.0) visit(k, length, by_length);
        }
    }

   private:
    const runtime::ScratchVector<double>& arc_lengths_;
    runtime::ScratchVector<double> by_arc_length_;
};

}  // namespace curvewise::curves
