// The point of one polygonal curve that is farthest from another curve, points between vertices
// included: a directed Hausdorff distance.
//
// The distance from a point of an edge to an edge of the other curve is a convex function of the
// point's place. Two facts follow. If both ends of a section of an edge are near the same edge of
// the other curve, all of the section is. And the farthest point of an edge is one of its ends, or
// a point at which the nearest edge changes.
//
// So the vertices are tested first (nearest.hpp). This gives a distance that most edges do not
// exceed: the edge nearest to one of their ends shows it at once. A section that may exceed the
// distance is cut at the point that is equally far from the edges nearest to its two ends. The
// nearest edge at the cut is then searched for. If it is one of the two, the cut is the farthest
// point of the section; otherwise both parts are treated in the same way. About O(n + log m) for
// similar curves.
//
// Points farther than the one found by less than `slack`, 2^-47 times the largest coordinate, are
// not searched for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "continuous/boxed_curve.hpp"
#include "continuous/nearest.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

// In units of the scaled curves.
struct FoundPoint {
    double distance = 0.0;
    std::ptrdiff_t edge = 0;     // of its curve
    double at = 0.0;             // the part of the edge that lies before it
    std::ptrdiff_t nearest = 0;  // the edge of the other curve
    double nearest_at = 0.0;
};

template <int Dim>
class FarthestPointSearch {
   public:
    // `largest` is the largest |coordinate| of both curves.
    FarthestPointSearch(const BoxedCurve& from, const BoxedCurve& to, double largest,
                        Poller& poller)
        : from_(from),
          edges_(to, poller),
          poller_(poller),
          slack_(std::ldexp(largest, -47)),
          point_(static_cast<std::size_t>(from.dim())) {}

    // Ends early where one is farther than `enough`.
    FoundPoint found(double enough) {
        look_at_vertices();
        std::ptrdiff_t near = 0;
        for (std::ptrdiff_t edge = 0; edge < from_.size() - 1; ++edge) {
            if (best_.distance > enough) break;
            poller_.spend(16);
            if (!is_passed(edge, near)) look_inside(edge, near);
        }
        const double* const z = place(best_.edge, best_.at);
        edges_.nearest(z, best_.nearest);
        best_.nearest_at = edges_.fraction(z, best_.nearest);
        return best_;
    }

   private:
    // A stretch of an edge, with the nearest edges of its ends.
    struct Stretch {
        double begin, end;
        std::ptrdiff_t near_begin, near_end;
    };

    void look_at_vertices() {
        const Furthest vertex = edges_.furthest(from_, {0.0, 0});
        const bool is_last = vertex.vertex == from_.size() - 1;
        best_.edge = vertex.vertex - (is_last ? 1 : 0);
        best_.at = is_last ? 1.0 : 0.0;
        best_.distance = std::sqrt(vertex.square);
    }

    // Whether one edge, near the first end or near the last, is near enough to both. `near` is an
    // edge to begin with, and becomes one near the last end.
    bool is_passed(std::ptrdiff_t edge, std::ptrdiff_t& near) const {
        const double most = (best_.distance + slack_) * (best_.distance + slack_);
        const double* const x = from_.point<Dim>(edge);
        const double* const y = from_.point<Dim>(edge + 1);
        if (edges_.descend(x, near) <= most && edges_.square_to_edge(y, near) <= most) return true;
        return edges_.descend(y, near) <= most && edges_.square_to_edge(x, near) <= most;
    }

    void look_inside(std::ptrdiff_t edge, std::ptrdiff_t& near) {
        Stretch whole{0.0, 1.0, near, near};
        edges_.nearest(from_.point<Dim>(edge), whole.near_begin);
        edges_.nearest(from_.point<Dim>(edge + 1), whole.near_end);
        near = whole.near_end;
        stretches_.assign(1, whole);
        while (!stretches_.empty()) {
            const Stretch one = stretches_.back();
            stretches_.pop_back();
            const double most = best_.distance + slack_;
            if (distance(edge, one.end, one.near_begin) <= most) continue;
            if (distance(edge, one.begin, one.near_end) <= most) continue;
            const double middle = equally_far(edge, one);
            if (!(one.begin < middle && middle < one.end)) continue;
            std::ptrdiff_t nearest = one.near_begin;
            const double far = std::sqrt(edges_.nearest(place(edge, middle), nearest));
            if (far > best_.distance) {
                best_.distance = far;
                best_.edge = edge;
                best_.at = middle;
            }
            stretches_.push_back({one.begin, middle, one.near_begin, nearest});
            stretches_.push_back({middle, one.end, nearest, one.near_end});
        }
    }

    // Where on a stretch the nearest edges of its ends are equally far, by secants and halves in
    // turn. The difference of both distances is below 0 at the beginning and above at the end.
    double equally_far(std::ptrdiff_t edge, const Stretch& one) {
        const auto difference = [&](double t) {
            return distance(edge, t, one.near_begin) - distance(edge, t, one.near_end);
        };
        double low = one.begin, high = one.end;
        double below = difference(low), above = difference(high);
        for (int step = 0; high - low > 0x1p-53; ++step) {
            const double share = step % 2 == 0 ? below / (below - above) : 0.5;
            const double middle = low + share * (high - low);
            if (!(low < middle && middle < high)) continue;
            const double found = difference(middle);
            if (found == 0.0) return middle;
            (found < 0.0 ? low : high) = middle;
            (found < 0.0 ? below : above) = found;
        }
        return low > one.begin ? low : high;
    }

    double distance(std::ptrdiff_t edge, double t, std::ptrdiff_t other) {
        return std::sqrt(edges_.square_to_edge(place(edge, t), other));
    }

    const double* place(std::ptrdiff_t edge, double t) {
        const double* const x = from_.point<Dim>(edge);
        const double* const y = from_.point<Dim>(edge + 1);
        for (std::ptrdiff_t c = 0; c < from_.dim(); ++c) {
            point_[static_cast<std::size_t>(c)] = t == 1.0 ? y[c] : x[c] + t * (y[c] - x[c]);
        }
        return point_.data();
    }

    const BoxedCurve& from_;
    NearestEdges<Dim> edges_;
    Poller& poller_;
    double slack_;
    FoundPoint best_;
    runtime::ScratchVector<double> point_;
    runtime::ScratchVector<Stretch> stretches_;
};

}  // namespace curvewise::continuous
