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
// no path. The first curve begins at that vertex, so that the first row has few free sections. If
// that distance is too small, bisection finds 8 bits of the radius. A section that fails with a
// radius also fails with every smaller radius, and is skipped. Then the sections are searched one
// after the other, each for a radius below the best one so far. For one section, the search from
// both ends (both_ends.hpp) finds a lower bound: paths from the section to the same section one
// turn behind. The bound is nearly always the radius.
//
// Time: a walk for many similar curves. Otherwise about 20 decisions: two or three try all
// sections, and the others try one. Memory O(n + m).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "continuous/both_ends.hpp"
#include "continuous/boxed_curve.hpp"
#include "continuous/exact_signs.hpp"
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
        : first_(P),
          second_(Q),
          first_boxed_(p),
          range_(range),
          poller_(poller),
          search_(P, Q, p, q, range, poller, memory_, PathEnds::anywhere()),
          diagram_(search_.diagram()),
          turn_(diagram_.cells() / 2) {}

    // Whether the distance is at most, or below, a number.
    bool is_within(double distance, FreeSet set = FreeSet::closed) {
        Beginnings all{0, turn_ - 1};
        return leads_around_from(all, distance, set);
    }

    // The real number rounded up. `square` is the rounded square of the distance of the first
    // vertex from the second curve, in scaled units.
    double value(double square) {
        const double low = search_.least_of_row({square, 0});
        if (is_within(low)) return low;
        const double bound = search_.least_through(low);
        if (bound > low && is_within(bound)) return bound;
        return least_above(bound);
    }

    // A matching within a distance that is sufficient, and its largest pair distance. It begins at
    // a vertex of the second curve if one will do.
    std::pair<double, LeashPath> matching(double distance, std::ptrdiff_t vertex) {
        const Radius radius = search_.radius_of(distance);
        const std::ptrdiff_t blocked =
            diagram_.second_edges().first_blocked_vertex(vertex, diagram_.cells(), 0, radius);
        start_ = {vertex, std::min(blocked, diagram_.cells()) - 1, {}};
        const bool is_free = blocked > vertex;
        if (!is_free || !walk(radius, diagram_.cells() - 1) || !has_returned()) is_within(distance);
        return search_.traced(distance, [&](auto& trace) { return trace.around(start_, turn_); });
    }

   private:
    // Edges of the second curve, where paths begin.
    struct Beginnings {
        std::ptrdiff_t first, last;
    };
    // In doubles: 2^-6 and 2^-8 of a radius.
    static constexpr std::uint64_t first_stride = std::uint64_t{1} << 46;
    static constexpr std::uint64_t narrow = std::uint64_t{1} << 44;

    // Whether a path leads around that begins on `edges`. If so, `edges` becomes the first free
    // section where such a path begins.
    bool leads_around_from(Beginnings& edges, double distance, FreeSet set = FreeSet::closed) {
        const Radius radius = search_.radius_of(distance, set);
        diagram_.start(radius, starts_);
        for (const Run& section : starts_) {
            if (section.first > edges.last) return false;
            if (section.last < edges.first) continue;
            if (leads_around(section, radius)) {
                edges = {section.first, std::min(section.last, turn_ - 1)};
                return true;
            }
        }
        return false;
    }

    // The least double with which a path leads around. `low` is too small.
    double least_above(double low) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Beginnings edges{0, turn_ - 1};
        double high = least_double(low, infinity, first_stride, narrow, [&](double x) {
            Beginnings rest{edges.first, turn_ - 1};
            const bool suffices = leads_around_from(rest, x);
            if (suffices) edges = rest;
            return suffices;
        });
        if (high == infinity) return high;
        low = double_of(bits_of(high) - std::min(narrow, bits_of(high) - bits_of(low)));
        for (;; high = next_below(high)) {
            high = least_from(edges, low, high);
            edges = {edges.last + 1, turn_ - 1};
            const double less = next_below(high);
            if (less == low || !leads_around_from(edges, less)) return high;
        }
    }

    // The least double with which a path from `edges` leads around. `low` is too small, and `high`
    // suffices. `edges` becomes a free section where such a path begins.
    double least_from(Beginnings& edges, double low, double high) {
        const auto suffices = [&](double x) { return leads_around_from(edges, x); };
        const double bound = least_between(edges, low, high);
        if (bound > low && suffices(bound)) return bound;
        return least_double(bound, high, std::uint64_t{1} << 20, 1, suffices);
    }

    // The least double, at least `low`, with which a path leads from `edges` to the same edges one
    // turn behind. `high` suffices.
    double least_between(const Beginnings& edges, double low, double high) const {
        const std::ptrdiff_t count = edges.last - edges.first + 1;
        const CurveView section(second_.row_major() + edges.first * second_.dim(),
                                turn_ + count + 1, second_.dim());
        const BoxedCurve boxed(section, range_, poller_);
        const Diagram<Dim> diagram({first_boxed_, boxed, ExactSigns(first_, section)},
                                   {boxed, first_boxed_, ExactSigns(section, first_)},
                                   PathEnds{count});
        return BothEnds<Dim>(first_, section, diagram, range_, poller_).least_within(low, high);
    }

    // Whether a path leads around from a point of a free section of the first row.
    bool leads_around(const Run& section, const Radius& radius) {
        const std::ptrdiff_t last = std::min(section.last, turn_ - 1);
        start_ = section;
        while (start_.first <= last) {
            if (!walk(radius, last + turn_)) return false;
            if (has_returned()) return true;
            const Run* const reached = first_reached();
            if (reached == nullptr || reached->first > last + turn_) return false;
            start_.first = reached->first - turn_;
            start_.low = reached->low;
        }
        return false;
    }

    // Advances runs_ from start_ to the last row. Fails at a row without reachable points up to
    // edge `last`.
    bool walk(const Radius& radius, std::ptrdiff_t last) {
        runs_.assign(1, start_);
        for (std::ptrdiff_t i = 0; i < diagram_.rows() - 1; ++i) {
            poller_.spend(8 + 2 * diagram_.advance(i, runs_, radius, next_));
            std::swap(runs_, next_);
            while (!runs_.empty() && runs_.back().first > last) runs_.pop_back();
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

    CurveView first_, second_;
    const BoxedCurve& first_boxed_;
    RangeScale range_;
    Poller& poller_;
    LeashMemory memory_;
    LeashSearch<Dim> search_;
    const Diagram<Dim>& diagram_;
    std::ptrdiff_t turn_;  // edges
    Runs starts_, runs_, next_;
    Run start_{};  // of the last walk
};

}  // namespace curvewise::continuous
