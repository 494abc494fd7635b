// The symmetric difference of two polygons by the nonzero rule, as trapezoids: the basis of
// Crossing::polygon. A point is inside a polygon that winds around it.
//
// Between two neighbouring x of points or crossings, the edges do not cross. There each gap between
// neighbouring edges is inside both polygons, one, or neither (the slabs of Shamos & Hoey, 1976).
// Exact but for rounding. Time O((n + m + k) a log a) if a edges lie above each other and two of
// them cross k times; memory O(n + m + a²).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "curves/polyline.hpp"
#include "planar/quad.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::planar {

class SymmetricDifference {
   public:
    // Throws Stopped where the poller says so.
    SymmetricDifference(const curves::Polyline& P, const curves::Polyline& Q,
                        runtime::Poller& poller);

    // Calls visit(trapezoid, area) for each, from left to right.
    template <class Visit>
    void for_each(Visit visit) {
        for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
            enter_slab(ends_[i], ends_[i + 1]);
            double left = ends_[i];
            for (const double right : crossings_) {
                visit_gaps(left, right, visit);
                left = right;
            }
        }
    }

   private:
    // An edge that is not vertical, from left to right, relative to the origin.
    struct Edge {
        Point a, b;
        std::size_t polygon;  // 0 for P, 1 for Q
        int winding;          // 1 where the polygon's direction is to the right, otherwise -1

        double at(double x) const noexcept {
            if (x <= a.x) return a.y;
            if (x >= b.x) return b.y;
            return interpolate(a, b, (x - a.x) / (b.x - a.x)).y;
        }
    };
    struct Level {
        double y;
        const Edge* edge;
    };
    struct Crossed {
        double low, high;
    };

    void add_edges(const curves::Polyline& points, std::size_t polygon);
    // Finds the active edges, and the x at which they cross within the slab, with its end.
    void enter_slab(double low, double high);
    void find_crossings(double low, double high);
    void sort_levels(double x);

    template <class Visit>
    void visit_gaps(double left, double right, Visit& visit) {
        sort_levels(left + 0.5 * (right - left));
        std::array<int, 2> windings{};
        for (std::size_t k = 0; k + 1 < levels_.size(); ++k) {
            const Edge &low = *levels_[k].edge, &high = *levels_[k + 1].edge;
            windings[low.polygon] += low.winding;
            if ((windings[0] != 0) == (windings[1] != 0)) continue;
            const auto corner = [&](const Edge& edge, double x) -> Point {
                return {x + origin_.x, edge.at(x) + origin_.y};
            };
            visit(Quad{corner(low, left), corner(low, right), corner(high, right),
                       corner(high, left)},
                  (right - left) * (levels_[k + 1].y - levels_[k].y));
        }
    }

    Point origin_;  // P's first point, so that areas far from (0, 0) are as exact
    runtime::ScratchVector<Edge> edges_, active_;
    std::size_t next_ = 0;  // edge to become active
    runtime::ScratchVector<double> ends_, crossings_;
    runtime::ScratchVector<Crossed> sides_;
    runtime::ScratchVector<Level> levels_;
    runtime::Poller& poller_;
};

}  // namespace curvewise::planar
