// The continuous Fréchet distance of two closed curves: the least over where either begins. The
// first curve gives the rows of a free-space diagram, and the second, twice around, its columns. A
// path that goes once around both leads from a point t of the first row to the point one turn
// behind it in the last row. Both rows are of the same vertex, so that both points are free.
//
// A section of the first row that is free as a whole has a path or none. What any of its points
// reaches is reached from its first point. So a path from a point behind t ends at or behind the
// first point, one turn behind t or later, that t reaches. If this is one turn behind t, it ends a
// path. Otherwise no path begins before that place, where the next walk begins. Each walk that is
// not the last has passed a point where an edge enters the reach of a vertex. One or two walks
// nearly always suffice. Every answer is exact, as in reachable.hpp: places are compared as bounds
// of edges, never as numbers. (Alt & Godau (1995) build the reachable points of all beginnings.)
//
// The value begins with the largest distance of a vertex from the other curve, below which there is
// no path. The first curve begins at that vertex, so that the first row has few free sections.
// Time: a walk for many similar curves, and about 60 otherwise. Memory O(n + m).
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "continuous/boxed_curve.hpp"
#include "continuous/free_space.hpp"
#include "continuous/leash_search.hpp"
#include "continuous/least_double.hpp"
#include "continuous/reachable.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"

namespace curvewise::continuous {

template <int Dim>
class ClosedLeashSearch {
   public:
    // The first curve once around and the second twice, each with its first point at the end, and
    // both boxed and scaled.
    ClosedLeashSearch(const CurveView& P, const CurveView& Q, const BoxedCurve& p,
                      const BoxedCurve& q, const RangeScale& range, Poller& poller)
        : poller_(poller),
          search_(P, Q, p, q, range, poller, memory_, PathEnds::anywhere),
          diagram_(search_.diagram()),
          turn_(diagram_.cells() / 2) {}

    // Whether the distance is at most, or below, a number.
    bool is_within(double distance, FreeSet set = FreeSet::closed) {
        const Radius radius = search_.radius_of(distance, set);
        diagram_.start(radius, starts_);
        for (const Run& section : starts_) {
            // Those behind one turn are the first ones again.
            if (section.first >= turn_) return false;
            if (leads_around(section, radius)) return true;
        }
        return false;
    }

    // The real number rounded up. `square` is the rounded square of the distance of the first
    // vertex from the second curve, in scaled units.
    double value(double square) {
        const double low = search_.least_of_row({square, 0});
        if (is_within(low)) return low;
        const double bound = search_.least_through(low);
        if (bound > low && is_within(bound)) return bound;
        return least_double(bound, std::numeric_limits<double>::infinity(), search_.first_stride, 1,
                            [&](double x) { return is_within(x); });
    }

    // A matching within a distance that is sufficient, and its largest pair distance. It begins at
    // a vertex of the second curve if one will do.
    std::pair<double, LeashPath> matching(double distance, std::ptrdiff_t vertex) {
        const Radius radius = search_.radius_of(distance);
        const std::ptrdiff_t blocked =
            diagram_.second_edges().first_blocked_vertex(vertex, diagram_.cells(), 0, radius);
        start_ = {vertex, std::min(blocked, diagram_.cells()) - 1, {}};
        const bool is_free = blocked > vertex;
        if (!is_free || !walk(radius) || !has_returned()) is_within(distance);
        return search_.traced(distance, [&](auto& trace) { return trace.around(start_, turn_); });
    }

   private:
    // Whether a path leads around from a point of a free section of the first row.
    bool leads_around(const Run& section, const Radius& radius) {
        const std::ptrdiff_t last = std::min(section.last, turn_ - 1);
        start_ = section;
        while (start_.first <= last) {
            if (!walk(radius)) return false;
            if (has_returned()) return true;
            const Run* const reached = first_reached();
            if (reached == nullptr || reached->first > section.last + turn_) return false;
            start_.first = reached->first - turn_;
            start_.low = reached->low;
        }
        return false;
    }

    // Advances runs_ from start_ to the last row, unless nothing of a row is reached.
    bool walk(const Radius& radius) {
        runs_.assign(1, start_);
        for (std::ptrdiff_t i = 0; i < diagram_.rows() - 1; ++i) {
            poller_.spend(8 + 2 * diagram_.advance(i, runs_, radius, next_));
            std::swap(runs_, next_);
            if (runs_.empty()) return false;
        }
        return true;
    }
    // The first run of the last row that does not end before the edge one turn behind start_.
    const Run* first_reached() const noexcept {
        for (const Run& run : runs_) {
            if (run.last >= start_.first + turn_) return &run;
        }
        return nullptr;
    }
    // Whether the point one turn behind start_ is reached. It is free, since start_ is.
    bool has_returned() const {
        const Run* const run = first_reached();
        const std::ptrdiff_t edge = start_.first + turn_;
        return run != nullptr &&
               (run->first < edge || (run->first == edge && !diagram_.second_edges().is_behind(
                                                                edge, run->low, start_.low)));
    }

    Poller& poller_;
    LeashMemory memory_;
    LeashSearch<Dim> search_;
    const Diagram<Dim>& diagram_;
    std::ptrdiff_t turn_;  // edges
    Runs starts_, runs_, next_;
    Run start_{};  // of the last walk
};

}  // namespace curvewise::continuous
