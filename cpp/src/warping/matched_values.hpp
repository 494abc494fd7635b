// Of curves in one dimension: the values of one that the points of another may be matched to, as
// intervals. A point costs at least its distance to the nearest of them.
//
// Without a band these are the values of all runs of the curve, the same for every point: boxes
// that overlap, or nearly, become one, and few are left, since a curve passes most values more than
// once. With a band each point has the interval of the points in its band, the bound of Keogh &
// Ratanamahatana (2005): the extremes of runs of points, from those of runs a quarter as long, in
// SIMD. O((n + m) log(window)) time for all points, in SIMD less than the O(n + m) of running ones.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/aligned_buffer.hpp"
#include "warping/band.hpp"
#include "warping/kernels/boxes.hpp"

namespace curvewise::warping {

// Writes what is left of `count` intervals, each its lower end and then its upper one; returns how
// many. Gaps of at most `most_gap` are closed. O(count) for each that is left.
std::ptrdiff_t merge_intervals(const double* intervals, std::ptrdiff_t count, double most_gap,
                               double* merged);

class BandedValues {
   public:
    // For `count` points beside a curve of `size`, both stored in reverse; kept as long as these
    // numbers stay as they are. False where there is no band.
    bool assign(std::ptrdiff_t count, std::ptrdiff_t size, std::optional<std::ptrdiff_t> window);
    // Whether enclose() has not been called since the numbers changed.
    bool is_new() const noexcept { return is_new_; }
    void enclose(const double* curve, kernels::ExtremesFunction extremes);

    // The interval of each point for the kernel, which needs the points besides.
    kernels::PointsAndBoxes each() const noexcept {
        kernels::PointsAndBoxes own{};
        own.low = (is_every_run_ ? all_low_ : low_).data();
        own.high = (is_every_run_ ? all_high_ : high_).data();
        return own;
    }

   private:
    std::ptrdiff_t count_ = -1;
    std::ptrdiff_t size_ = -1;
    bool is_limited_ = false;
    bool is_new_ = false;
    // The other curve's points in the band of point k are among those from first_ + begins_[k] on,
    // `length_` of them, where the curve goes on at either end as it ends.
    std::ptrdiff_t first_ = 0;
    std::ptrdiff_t length_ = 1;
    std::vector<std::ptrdiff_t> begins_;
    bool is_every_run_ = true;  // begins_[k] is k
    runtime::AlignedBuffer continued_;
    runtime::AlignedBuffer all_low_;
    runtime::AlignedBuffer all_high_;
    runtime::AlignedBuffer low_;
    runtime::AlignedBuffer high_;
};

}  // namespace curvewise::warping
