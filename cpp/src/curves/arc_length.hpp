// Arc length along a polyline, and the one walk along it by arc length. O(n).
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "curves/polyline.hpp"

namespace curvewise::curves {

// The arc length at every one of `size` vertices: 0 first, the curve's length last. edge(i) leads
// from vertex i - 1 to i. All throw Stopped where the poller says so.
template <class Edge>
std::vector<double> summed_edges(std::ptrdiff_t size, Poller& poller, Edge edge) {
    std::vector<double> lengths(static_cast<std::size_t>(size));
    poller.in_runs(size - 1, 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        double length = lengths[static_cast<std::size_t>(first)];  // in a register, in the loop
        for (std::ptrdiff_t i = first + 1; i <= end; ++i) {
            length += norm(edge(i));
            lengths[static_cast<std::size_t>(i)] = length;
        }
    });
    return lengths;
}

// The same, given the vertices.
template <class Vertex>
std::vector<double> summed_lengths(std::ptrdiff_t size, Poller& poller, Vertex vertex) {
    Point last = vertex(0);
    return summed_edges(size, poller, [&](std::ptrdiff_t i) {
        const Point before = last;
        last = vertex(i);
        return last - before;
    });
}

std::vector<double> arc_lengths(const Polyline& curve, Poller& poller);

// Those of a curve scaled by a box, by the differences of its own coordinates: where it lies far
// from the box, scaled coordinates have lost the bits in which they differ.
std::vector<double> box_scaled_arc_lengths(const CurveView& curve, const Box& box, Poller& poller);

// Throws std::invalid_argument for a curve whose points are all equal.
void check_length(const CurveView& curve, const std::string& name, const char* measure,
                  Poller& poller);

// A polyline with the arc length at every vertex.
class ArcCurve {
   public:
    ArcCurve(Polyline points, std::vector<double> arc_lengths)
        : points_(std::move(points)), arc_lengths_(std::move(arc_lengths)) {}

    const Polyline& points() const noexcept { return points_; }
    const std::vector<double>& arc_lengths() const noexcept { return arc_lengths_; }
    double length() const noexcept { return arc_lengths_.back(); }

   private:
    Polyline points_;
    std::vector<double> arc_lengths_;
};

// A place on a curve, given by the arc lengths of its vertices, that moves forward, in O(1)
// amortised.
class ArcPosition {
   public:
    explicit ArcPosition(const std::vector<double>& arc_lengths) noexcept
        : arc_lengths_(&arc_lengths) {}

    // To arc length u, cut at the curve's length; not before where it was.
    void move_to(double u) noexcept {
        const std::vector<double>& t = *arc_lengths_;
        at_ = std::min(u, t.back());
        while (segment_ + 2 < t.size() && t[segment_ + 1] <= at_) ++segment_;
    }
    std::size_t segment() const noexcept { return segment_; }
    // Of the segment: 0 at its start, 1 at its end and where it has no length.
    double fraction() const noexcept {
        const double start = (*arc_lengths_)[segment_];
        const double length = (*arc_lengths_)[segment_ + 1] - start;
        return length > 0.0 ? (at_ - start) / length : 1.0;
    }
    Point point_on(const Polyline& curve) const noexcept {
        return interpolate(curve[segment_], curve[segment_ + 1], fraction());
    }

   private:
    const std::vector<double>* arc_lengths_;
    std::size_t segment_ = 0;
    double at_ = 0.0;
};

}  // namespace curvewise::curves
