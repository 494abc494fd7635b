// One of two curves that are matched (matched_curves.hpp): where its vertices lie along it, its
// samples, and the walk along it. Everything here is O(n + k), for n points and k samples; points
// that lie side by side are read where they are.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

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

// The box of P; of Q, in a direction in which P has no extent.
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

// One that goes forward along a curve of these points, given the positions of its vertices, and
// looks at a vertex ahead. As curves::ArcPosition, except that it keeps what a segment needs, and
// never goes beyond the last vertex.
class Walker {
   public:
    Walker(const double* points, const double* positions, std::ptrdiff_t count) noexcept
        : first_(positions),
          last_segment_(positions + count - 2),
          segment_(positions),
          start_(points),
          vertex_(positions) {
        begin_segment();
        move_to(0.0);
    }

    void move_to(double position) noexcept {
        if (segment_[1] <= position && segment_ != last_segment_) {
            do {
                ++segment_;
                start_ += 2;
            } while (segment_[1] <= position && segment_ != last_segment_);
            begin_segment();
        }
        position_ = position;
        fraction_ = (position - begin_) / length_;
        point_ = fraction_ < 1.0
                     ? Point{start_[0] + fraction_ * edge_.x, start_[1] + fraction_ * edge_.y}
                     : Point{start_[2], start_[3]};
    }
    double position() const noexcept { return position_; }
    std::size_t segment() const noexcept { return static_cast<std::size_t>(segment_ - first_); }
    double fraction() const noexcept { return fraction_; }
    const Point& point() const noexcept { return point_; }

    // To the first vertex behind a sample, which is not the last.
    void look_behind(double sample) noexcept {
        while (*vertex_ <= sample) ++vertex_;
    }
    void look_further() noexcept { ++vertex_; }
    // The place of the vertex, where the path goes from `sample` at `begin` to the next sample, at
    // `rate` a sample. Infinite for a vertex that is not in between.
    double place(double sample, double begin, double rate) const noexcept {
        return *vertex_ < sample + 1.0 ? begin + (*vertex_ - sample) * rate
                                       : std::numeric_limits<double>::infinity();
    }

   private:
    void begin_segment() noexcept {
        edge_ = {start_[2] - start_[0], start_[3] - start_[1]};
        begin_ = segment_[0];
        length_ = segment_[1] - begin_;
        if (length_ > 0.0) return;
        begin_ = segment_[1] - 1.0;  // the last segment: its end is where the walker is
        length_ = 1.0;
    }

    const double* first_;
    const double* last_segment_;
    const double* segment_;  // the position where it begins
    const double* start_;    // the point there
    double begin_;           // the position there, and
    double length_;          // to the end; or such that the fraction is 1, where that is 0
    Point edge_;
    const double* vertex_;  // its position
    double position_;
    double fraction_;  // of the segment: 0 at its start, 1 at its end and where it has no length
    Point point_;
};

// One of the two curves.
struct Side {
    // `scaled` is the curve, as its length is measured; its positions go from 0 to `samples`.
    Side(const CurveView& curve, const curves::RangeScale& range, const AlignedBuffer& scaled,
         std::size_t samples, Poller& poller);
    CurveView samples() const noexcept { return {sampled.data(), sample_count, 2}; }
    Walker walker() const noexcept { return {points.data(), positions.data(), count}; }

    std::ptrdiff_t count;
    Coordinates points;
    AlignedBuffer positions;  // of the vertices
    std::ptrdiff_t sample_count;
    AlignedBuffer sampled;  // x and y at positions 0, 1, ..., on the grid
};

}  // namespace curvewise::planar
