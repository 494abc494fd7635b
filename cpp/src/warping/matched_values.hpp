// The values of one curve to which the points of the other may be matched, as intervals of each
// coordinate. A point costs at least its distance to the nearest interval, or box.
//
// In one dimension and without a band, these are the values of all runs of the curve, the same for
// every point. Boxes that overlap, or nearly, are merged. Few remain, since a curve passes most
// values more than once. With a band, each point has the box of the points in its band, the bound
// of Keogh & Ratanamahatana (2005; several coordinates: Rath & Manmatha 2003). The extremes of runs
// of points come from runs a quarter as long, in SIMD. This takes O((n + m) d log(window)) for all
// points, in SIMD less time than the O((n + m) d) of running extremes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "runtime/aligned_buffer.hpp"
#include "runtime/scratch.hpp"
#include "warping/band.hpp"
#include "warping/kernels/boxes.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {

// Writes the merged intervals of `count` intervals, each its lower end and then its upper one;
// returns their number. Gaps of at most `most_gap` are closed. O(count) for each remaining
// interval.
std::ptrdiff_t merge_intervals(const double* intervals, std::ptrdiff_t count, double most_gap,
                               double* merged);

class BandedValues {
   public:
    // For `count` points against a curve of `size`, both stored in reverse. The result is kept
    // while these numbers do not change. Returns false if there is not a band.
    bool assign(std::ptrdiff_t count, std::ptrdiff_t size, std::optional<std::ptrdiff_t> window);
    // Whether enclose() has not been called since the numbers changed.
    bool is_new() const noexcept { return is_new_; }
    // Coordinate c of the curve begins at curve + c * stride.
    void enclose(const double* curve, std::ptrdiff_t stride, std::ptrdiff_t dim,
                 kernels::ExtremesFunction extremes);

    // The box of each point for the kernel, which needs the points besides.
    kernels::PointsAndBoxes each() const noexcept {
        kernels::PointsAndBoxes own{};
        own.low = (is_every_run_ ? all_low_ : low_).data();
        own.high = (is_every_run_ ? all_high_ : high_).data();
        own.corner_stride = room();
        return own;
    }

   private:
    // The number of runs, from the first that a point has to the last.
    std::ptrdiff_t runs() const noexcept { return begins_.back() + 1; }
    // Of a coordinate, in each of the buffers.
    std::ptrdiff_t room() const noexcept {
        return runtime::AlignedBuffer::rounded(std::max(runs() + length_ - 1, count_) +
                                               kernels::padding);
    }

    std::ptrdiff_t count_ = -1;
    std::ptrdiff_t size_ = -1;
    bool is_limited_ = false;
    bool is_new_ = false;
    // The other curve's points in the band of point k are among the `length_` points from first_ +
    // begins_[k] on. Beyond either end, the curve continues with its end value.
    std::ptrdiff_t first_ = 0;
    std::ptrdiff_t length_ = 1;
    runtime::ScratchVector<std::ptrdiff_t> begins_;
    bool is_every_run_ = true;  // begins_[k] is k
    runtime::AlignedBuffer continued_;
    runtime::AlignedBuffer all_low_;
    runtime::AlignedBuffer all_high_;
    runtime::AlignedBuffer low_;
    runtime::AlignedBuffer high_;
};

}  // namespace curvewise::warping
