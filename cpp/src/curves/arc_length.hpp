// Arc length along a polyline, and the one walk along it by arc length. O(n).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "curves/polyline.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::curves {

// Edges in a row, whose norms are taken side by side: two roots take little longer than one.
struct EdgeBlock {
    static constexpr std::size_t size = 16;

    std::array<double, size> x, y;
    std::size_t count;

    // Writes the arc length at the end of each edge. The first edge begins at lengths[-1].
    void write_lengths(double* lengths) const noexcept {
        std::array<double, size> squares, roots;
        for (std::size_t k = 0; k < count; ++k) squares[k] = x[k] * x[k] + y[k] * y[k];
        for (std::size_t k = 0; k < count; ++k) roots[k] = std::sqrt(squares[k]);
        double length = lengths[-1];
        for (std::size_t k = 0; k < count; ++k) {
            length += is_in_range_of_squares(squares[k]) ? roots[k] : std::hypot(x[k], y[k]);
            lengths[k] = length;
        }
    }
};

// The arc length at every one of `size` vertices: 0 first, the curve's length last.
// write(first, edges) writes the edges from vertex `first` on. Throws Stopped where the poller says
// so.
template <class Write>
runtime::ScratchVector<double> summed_edges(std::ptrdiff_t size, Poller& poller, Write write) {
    runtime::ScratchVector<double> lengths(static_cast<std::size_t>(size));
    EdgeBlock edges;
    poller.in_runs(size - 1, 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        constexpr auto most = static_cast<std::ptrdiff_t>(EdgeBlock::size);
        for (std::ptrdiff_t i = first; i < end; i += most) {
            edges.count = static_cast<std::size_t>(std::min(most, end - i));
            write(i, edges);
            edges.write_lengths(lengths.data() + i + 1);
        }
    });
    return lengths;
}

// Both throw Stopped where the poller says so.
runtime::ScratchVector<double> arc_lengths(const Polyline& curve, Poller& poller);

// Arc lengths of a curve scaled by a box, from differences of the unscaled coordinates. If the
// curve lies far from the box, scaled coordinates have lost the bits in which they differ.
runtime::ScratchVector<double> box_scaled_arc_lengths(const CurveView& curve, const Box& box,
                                                      Poller& poller);

// Throws std::invalid_argument for a curve whose points are all equal.
void check_length(const CurveView& curve, const std::string& name, const char* measure,
                  Poller& poller);

// A polyline with the arc length at every vertex.
class ArcCurve {
   public:
    ArcCurve(Polyline points, runtime::ScratchVector<double> arc_lengths)
        : points_(std::move(points)), arc_lengths_(std::move(arc_lengths)) {}

    const Polyline& points() const noexcept { return points_; }
    const runtime::ScratchVector<double>& arc_lengths() const noexcept { return arc_lengths_; }
    double length() const noexcept { return arc_lengths_.back(); }

   private:
    Polyline points_;
    runtime::ScratchVector<double> arc_lengths_;
};

// A place on a curve, given by the arc lengths of its vertices, that moves forward, in O(1)
// amortised.
class ArcPosition {
   public:
    explicit ArcPosition(const runtime::ScratchVector<double>& arc_lengths) noexcept
        : arc_lengths_(&arc_lengths) {}

    // To arc length u, cut at the curve's length; not before where it was.
    void move_to(double u) noexcept {
        const runtime::ScratchVector<double>& t = *arc_lengths_;
        at_ = std::min(u, t.back());
        while (segment_ + 2 < t.size() && t[segment_ + 1] <= at_) ++segment_;
    }
    std::size_t segment() const noexcept { return segment_; }
    // Of the segment: 0 at its start, 1 at its end and if its length is zero.
    double fraction() const noexcept {
        const double start = (*arc_lengths_)[segment_];
        const double length = (*arc_lengths_)[segment_ + 1] - start;
        return length > 0.0 ? (at_ - start) / length : 1.0;
    }
    Point point_on(const Polyline& curve) const noexcept {
        return interpolate(curve[segment_], curve[segment_ + 1], fraction());
    }

   private:
    const runtime::ScratchVector<double>* arc_lengths_;
    std::size_t segment_ = 0;
    double at_ = 0.0;
};

}  // namespace curvewise::curves
