// One of two curves that are matched (matched_curves.hpp): where its vertices lie along it, its
// samples, and the walk along it. Everything here is O(n + k), for n points and k samples; points
// that lie side by side are read where they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "curves/box.hpp"
#include "curves/polyline.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"
#include "runtime/aligned_buffer.hpp"
#include "runtime/poller.hpp"

namespace curvewise::planar {

using curves::Point;
using runtime::AlignedBuffer;
using runtime::Poller;

// The box of P. In a direction in which P's extent is zero, the box of Q.
class CommonBox {
   public:
    CommonBox(const CurveView& P, const CurveView& Q) noexcept : CommonBox(Q, curves::Box(P)) {}

    // x and y of every point, side by side.
    AlignedBuffer scaled(const CurveView& curve, Poller& poller) const;
    std::array<double, 2> slopes() const noexcept { return {box_.x.slope(), box_.y.slope()}; }
    const std::array<bool, 2>& is_of_p() const noexcept { return is_of_p_; }

   private:
    CommonBox(const CurveView& Q, const curves::Box& of_p) noexcept;

    std::array<bool, 2> is_of_p_;
    curves::Box box_;
};

// How many widths and heights of the box a scaled curve of `count` points travels.
double travel(const AlignedBuffer& scaled, std::ptrdiff_t count, Poller& poller);

// The x and y of a curve's points in a range, side by side: a copy where they are not so already.
class Coordinates {
   public:
    Coordinates(const CurveView& curve, const curves::RangeScale& range, Poller& poller);
    const double* data() const noexcept { return data_; }

   private:
    AlignedBuffer copy_;
    const double* data_;
};

// Somewhere along a curve.
struct Spot {
    double position;
    std::ptrdiff_t segment;
    double fraction;  // of the segment: 0 at its start, 1 at its end and if its length is zero
    Point point;
};

// Finds the Spots of a curve of these points, given the positions of its vertices. As
// curves::ArcPosition, except that it never goes beyond the last vertex.
class SpotFinder {
   public:
    SpotFinder(const double* points, const double* positions, std::ptrdiff_t count) noexcept
        : points_(points), positions_(positions), last_segment_(count - 2) {}

    // The search starts from the segment `nearby`.
    Spot at(double position, std::ptrdiff_t nearby) const noexcept {
        std::ptrdiff_t segment = std::min(nearby, last_segment_);
        while (positions_[segment] > position) --segment;
        while (positions_[segment + 1] <= position && segment != last_segment_) ++segment;
        double begin = positions_[segment], length = positions_[segment + 1] - begin;
        if (!(length > 0.0)) {  // the last segment: its end is where this is
            begin = positions_[segment + 1] - 1.0;
            length = 1.0;
        }
        const double fraction = (position - begin) / length;
        const double* const start = points_ + 2 * segment;
        if (!(fraction < 1.0)) return {position, segment, fraction, {start[2], start[3]}};
        return {position,
                segment,
                fraction,
                {start[0] + fraction * (start[2] - start[0]),
                 start[1] + fraction * (start[3] - start[1])}};
    }

   private:
    const double* points_;
    const double* positions_;
    std::ptrdiff_t last_segment_;
};

// One of the two curves.
struct Side {
    // `scaled` is the curve, as its length is measured; its positions go from 0 to `samples`.
    Side(const CurveView& curve, const curves::RangeScale& range, const AlignedBuffer& scaled,
         std::size_t samples, Poller& poller);
    CurveView samples() const noexcept { return {sampled.data(), sample_count, 2}; }
    SpotFinder spots() const noexcept { return {points.data(), positions.data(), count}; }

    std::ptrdiff_t count;
    Coordinates points;
    AlignedBuffer positions;  // of the vertices
    std::ptrdiff_t sample_count;
    AlignedBuffer sampled;  // x and y at positions 0, 1, ..., on the grid
};

}  // namespace curvewise::planar
