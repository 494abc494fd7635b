// Of curves in one dimension: the values of one that the points of another may be matched to, as
// intervals. A point costs at least its distance to the nearest of them.
//
// Without a band these are the values of all runs of the curve, the same for every point: boxes
// that overlap, or nearly, become one, and few are left, since a curve passes most values more than
// once. With a band each point has the interval of the points in its band, the bound of Keogh &
// Ratanamahatana (2005), by the running minimum and maximum of van Herk (1992). O(n + m) time for
// all points.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/aligned_buffer.hpp"
#include "warping/band.hpp"
#include "warping/kernels/boxes.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

// Writes what is left of `count` intervals, each its lower end and then its upper one; returns how
// many. Gaps of at most `most_gap` are closed. O(count) for each that is left.
std::ptrdiff_t merge_intervals(const double* intervals, std::ptrdiff_t count, double most_gap,
                               double* merged);

class BandedValues {
   public:
    // For `count` points beside a curve of `size`, the ones stored in this order, the other in the
    // other one; kept as long as these numbers stay as they are. False where there is no band.
    bool assign(std::ptrdiff_t count, PointOrder order, std::ptrdiff_t size,
                std::optional<std::ptrdiff_t> window);
    // Whether enclose() has not been called since the numbers changed.
    bool is_new() const noexcept { return is_new_; }
    void enclose(const PackedCurve& curve);

    // The interval of each point for the kernel, which needs the points besides.
    kernels::PointsAndBoxes each() const noexcept {
        kernels::PointsAndBoxes own{};
        own.low = low_.data();
        own.high = high_.data();
        return own;
    }

   private:
    // An interval is that of a block's points from `begins` on and of a block's up to `ends`,
    // either of which may be none.
    struct Parts {
        std::ptrdiff_t begins;
        std::ptrdiff_t ends;
    };
    Parts parts_of(std::ptrdiff_t first, std::ptrdiff_t last) const noexcept;

    std::ptrdiff_t count_ = -1;
    std::ptrdiff_t size_ = -1;
    bool is_limited_ = false;
    bool is_new_ = false;
    std::ptrdiff_t block_ = 1;
    std::vector<Parts> parts_;
    AlignedBuffer running_;  // minima and maxima, from each block's begin and to its end
    AlignedBuffer low_;
    AlignedBuffer high_;
};

}  // namespace curvewise::warping
