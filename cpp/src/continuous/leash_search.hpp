// The continuous Fréchet distance of two curves as a double, and decisions about it, all exact.
//
// A decision is a walk through the rows of the free-space diagram (reachable.hpp), exact for any
// radius. The value is the least double for which the decision is yes: the real number, rounded up.
// Plain bisection would take about 50 walks. Instead, the search has four steps:
//
// 1. The radius must reach between the ends, and from the two vertices farthest from the other
//    curve (nearest.hpp) to that curve. The least such radius needs no walk. A walk with it
//    succeeds for many similar curves.
// 2. A walk that fails ends in the row of a bottleneck. Bisection finds the least radius that
//    passes it, on walks from `window` rows before it to `window` rows behind it. The window grows
//    if one eight times as wide gives another radius, or if the walk only enters a dead end.
// 3. The walk continues with that radius, to its end or to the next bottleneck.
// 4. The final radius r is sufficient. A whole walk with the double below r, which ends at the
//    bottleneck, shows that r is necessary. If that walk succeeds, the bottleneck was elsewhere,
//    and the search repeats with a window eight times as wide. Once the window is as wide as the
//    diagram, this is plain bisection.
//
// Steps 2 to 4 first run to 10 bits, which finds the deciding bottleneck, and then to the last bit.
// Every larger radius reaches all points that a smaller one reaches. So a walk may begin where one
// with a smaller radius passed. The search takes one walk if the ends or the farthest vertices
// decide, and four or five for other similar curves. Memory is O(n + m). If the windows of step 2
// get too large (white noise), the search from both ends (both_ends.hpp) takes over.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "continuous/both_ends.hpp"
#include "continuous/boxed_curve.hpp"
#include "continuous/coupling.hpp"
#include "continuous/exact_signs.hpp"
#include "continuous/free_space.hpp"
#include "continuous/leash_path.hpp"
#include "continuous/least_double.hpp"
#include "continuous/nearest.hpp"
#include "continuous/reachable.hpp"
#include "continuous/trail.hpp"
#include "continuous/vertex_walk.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"

namespace curvewise::continuous {

// What a search keeps from one pair to the next.
struct LeashMemory {
    Runs runs, next;
};

template <int Dim>
class LeashSearch {
   public:
    // The curves, and the same boxed and scaled. The first one gives the rows.
    LeashSearch(const CurveView& P, const CurveView& Q, const BoxedCurve& p, const BoxedCurve& q,
                const RangeScale& range, Poller& poller, LeashMemory& memory,
                PathEnds ends = PathEnds::corners())
        : P_(P),
          Q_(Q),
          range_(range),
          poller_(poller),
          p_(p),
          q_(q),
          second_signs_(Q, P),
          diagram_({p, q, ExactSigns(P, Q)}, {q, p, second_signs_}, ends),
          last_(p.size() - 1),
          runs_(memory.runs),
          next_(memory.next),
          trail_(p.size() + q.size()) {}

    // Whether the distance is at most, or below, a number.
    bool is_within(double distance, FreeSet set = FreeSet::closed) {
        const Radius radius = radius_of(distance, set);
        VertexWalk<Dim> vertices({p_.point<Dim>(0), p_.size(), p_.dim()},
                                 {q_.point<Dim>(0), q_.size(), q_.dim()}, second_signs_, radius);
        return !is_too_short(radius) &&
               (vertices.succeeds(poller_, few_dead_ends) || is_within_after(vertices, radius));
    }
    // The same where a walk over vertices has not succeeded with few dead ends. Filters come before
    // most of the walk through the diagram, but not before a few of its rows, where some end.
    static constexpr std::ptrdiff_t few_dead_ends = 16;
    bool is_within_after(VertexWalk<Dim>& vertices, const Radius& radius) {
        if (boxes_surely_miss(radius)) return false;
        begin(radius);
        const std::ptrdiff_t row = walk(0, last_, radius, &trail_, p_.size() + q_.size());
        if (next_.empty()) return is_through(row, radius);  // nothing is reached of the next row
        // A search has found the vertices farthest from the other curve, and asks close to the
        // value.
        if (!has_witnesses_) {
            if (misses_behind(vertices.furthest(), radius)) return false;
            if (vertices.succeeds(poller_)) return true;
        }
        return is_through(walk(row, last_, radius, &trail_), radius);
    }

    // The same of the discrete distance, and at most.
    bool is_coupled_within(double distance) const {
        return CouplingWalk<Dim>({q_, p_, second_signs_}, last_ + 1, poller_)
            .succeeds(radius_of(distance));
    }

    // A matching within a distance that is sufficient, and its largest pair distance.
    std::pair<double, LeashPath> matching(double distance) {
        const Radius radius = radius_of(distance);
        LeashPath matched = LeashPathTrace<Dim>(diagram_, radius, poller_).parameters();
        const double longest =
            LeashMeasure<Dim>(diagram_, radius, range_, poller_).longest(matched);
        return {longest, std::move(matched)};
    }

    // For paths that begin and end anywhere: the matching of the first curve and the section of the
    // second that is nearest to it.
    std::pair<double, LeashPath> part() {
        double distance =
            least_through(least_of_row(NearestEdges<Dim>(q_, poller_).furthest(p_, {0.0, 0})));
        if (is_astray()) {
            distance = least_double(distance, std::numeric_limits<double>::infinity(), first_stride,
                                    1, [&](double x) { return walks_through(radius_of(x)); });
        }
        return traced(distance, [](auto& trace) { return trace.part(); });
    }
    // The least double within which the first curve's vertex is of the second curve.
    double least_of_row(const Furthest& vertex) const {
        return least_double_near(range_.restore(std::sqrt(vertex.square), 1), [&](double x) {
            std::ptrdiff_t near = 0;
            return !diagram_.row_is_blocked(vertex.vertex, radius_of(x), near);
        });
    }
    // The least double, not below `low`, with which a path leads through the diagram. If the search
    // is astray, a double with which none does.
    double least_through(double low) {
        if (walks_through(radius_of(low))) return low;
        const double found = narrow(low);
        return is_astray() ? low : found;
    }
    // The matching that trace(LeashPathTrace) finds within a distance, and its largest distance.
    template <class Trace>
    std::pair<double, LeashPath> traced(double distance, Trace trace) {
        const Radius radius = radius_of(distance);
        LeashPathTrace<Dim> tracer(diagram_, radius, poller_);
        LeashPath matched = trace(tracer);
        const double longest =
            LeashMeasure<Dim>(diagram_, radius, range_, poller_).longest_with_ends(matched);
        return {longest, std::move(matched)};
    }
    // In doubles, 2^-12 of a radius: for bisections above a lower bound.
    static constexpr std::uint64_t first_stride = std::uint64_t{1} << 40;

    const Diagram<Dim>& diagram() const noexcept { return diagram_; }
    Radius radius_of(double distance, FreeSet set = FreeSet::closed) const noexcept {
        return {distance, range_, p_.dim(), set};
    }

    // The real number rounded up; inf beyond the range of a double, and where it is above
    // `cutoff`.
    double value(double cutoff) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        if (cutoff < infinity && !is_within(cutoff)) return infinity;
        find_witnesses();
        const double low = least_of_witnesses();
        const double found = value_above(low);
        if (!is_astray()) return found;
        return BothEnds<Dim>(P_, Q_, diagram_, range_, poller_).least_within(low);
    }

   private:
    using Pair = typename VertexWalk<Dim>::Pair;
    static constexpr double none = -1.0;

    // Whether a path leads through the diagram, row by row. Leaves a trail.
    bool walks_through(const Radius& radius) {
        begin(radius);
        return is_through(walk(0, last_, radius, &trail_), radius);
    }
    void begin(const Radius& radius) {
        diagram_.start(radius, runs_);
        trail_.forget_from(0);
        trail_.note(0, runs_);
        trail_radius_ = none;
    }
    // The same for a walk that ended in `row`.
    bool is_through(std::ptrdiff_t row, const Radius& radius) {
        trail_radius_ = radius.given();
        trail_end_ = row;
        return row == last_ && diagram_.is_through(runs_, radius);
    }

    // Whether one of some vertices behind those of a pair is nowhere near the other curve: the
    // negative filter of Bringmann, Künnemann & Nusser (2019), with the vertices 1, 3, 7, 15, ...
    // behind and three between two of these. It is exact.
    bool misses_behind(const Pair& pair, const Radius& radius) const {
        const std::ptrdiff_t cells = diagram_.cells();
        std::ptrdiff_t i = pair.i, j = pair.j, row_near = pair.j, column_near = pair.i;
        for (std::ptrdiff_t step = 1, gap = 1; i < last_ || j < cells; step += gap) {
            if (step == 8 * gap) gap *= 2;
            i += gap;
            j += gap;
            poller_.spend(64);
            // Curves that are alike advance by about the same number of edges.
            row_near = std::min(row_near + gap - 1, cells - 1);
            column_near = std::min(column_near + gap - 1, last_ - 1);
            if (i < last_ && diagram_.row_is_blocked(i, radius, row_near)) return true;
            if (j < cells && diagram_.column_is_blocked(j, radius, column_near)) return true;
        }
        return false;
    }

    // The least double within which the curves are. It is not below `low`, which holds the
    // witnesses. Of no use where the search is astray.
    double value_above(double low) {
        if (is_within(low)) return low;  // and nothing below it holds the witnesses
        return narrow(low);
    }

    // The least double with which a path leads through the diagram. None does with `low`, which is
    // raised. Of no use where the search is astray.
    double narrow(double& low) {
        double high = std::numeric_limits<double>::infinity();
        std::ptrdiff_t window = 16;
        for (const std::uint64_t tolerance : {std::uint64_t{1} << 42, std::uint64_t{1}}) {
            for (;;) {
                high = climb(low, high, window, tolerance);
                if (is_astray()) return high;
                const double less = below(high, tolerance, low);
                if (less == low || !walks_through(radius_of(less))) {
                    low = less;
                    break;
                }
                high = less;
                window *= 8;
            }
        }
        return high;
    }

    // Whether the windows have taken as many steps as half a walk does if all is reachable. Rows
    // with few reachable points are passed sooner than that pays.
    bool is_astray() const noexcept {
        return cells_around_ > 128 * (p_.size() + q_.size()) && rows_around_ > last_ / 2;
    }

    // The number that is `tolerance` doubles below x, not below `low`.
    static double below(double x, std::uint64_t tolerance, double low) noexcept {
        return double_of(bits_of(x) - std::min(tolerance, bits_of(x) - bits_of(low)));
    }

    // The vertices of either curve that are furthest from the other.
    void find_witnesses() {
        has_witnesses_ = true;
        const double first = square_distance<Dim>(p_.point<Dim>(0), q_.point<Dim>(0), p_.dim());
        const double last =
            square_distance<Dim>(p_.point<Dim>(last_), q_.point<Dim>(q_.size() - 1), p_.dim());
        Furthest found{std::max(first, last), 0};
        found = NearestEdges<Dim>(q_, poller_).furthest(p_, found);
        row_witness_ = found.vertex;
        found.vertex = 0;
        found = NearestEdges<Dim>(p_, poller_).furthest(q_, found);
        column_witness_ = found.vertex;
        guess_ = range_.restore(std::sqrt(found.square), 1);
    }

    // Whether the ends, or the witnesses, are too far apart, or the curves reach too far beyond
    // each other in a coordinate.
    bool is_too_short(const Radius& radius) const {
        poller_.spend(p_.size() + q_.size());
        std::ptrdiff_t near = 0;
        return !diagram_.corner_is_free(0, 0, radius) ||
               !diagram_.corner_is_free(last_, diagram_.cells(), radius) ||
               boxes_surely_miss(radius) ||
               (row_witness_ > 0 && diagram_.row_is_blocked(row_witness_, radius, near)) ||
               (column_witness_ > 0 &&
                diagram_.column_is_blocked(column_witness_, radius, near = 0));
    }

    // What reaches furthest in a coordinate must meet something that reaches nearly as far.
    bool boxes_surely_miss(const Radius& radius) const noexcept {
        const double* const p = p_.box<Dim>(p_.levels() - 1, 0);
        const double* const q = q_.box<Dim>(q_.levels() - 1, 0);
        for (std::ptrdiff_t k = 0; k < 2 * p_.dim(); ++k) {
            const double delta = p[k] - q[k];
            if (radius.surely_misses(delta * delta)) return true;
        }
        return false;
    }

    double least_of_witnesses() const {
        return least_double_near(guess_, [&](double x) { return !is_too_short(radius_of(x)); });
    }

    // Advances runs_, the reachable runs of row `from`, to row `to`, or until the steps are `most`.
    // Returns the last row with reachable points.
    std::ptrdiff_t walk(std::ptrdiff_t from, std::ptrdiff_t to, const Radius& radius, Trail* trail,
                        std::ptrdiff_t most = std::numeric_limits<std::ptrdiff_t>::max()) {
        for (std::ptrdiff_t i = from; i < to; ++i) {
            const std::ptrdiff_t cells = diagram_.advance(i, runs_, radius, next_);
            poller_.spend(8 + 2 * cells);
            if (next_.empty()) return i;
            if (trail == nullptr) {
                cells_around_ += cells;
                rows_around_ += 1;
                if (is_astray()) return i;
            }
            std::swap(runs_, next_);
            if (trail != nullptr) trail->note(i + 1, runs_);
            most -= 8 + 2 * cells;
            if (most < 0) return i + 1;
        }
        return to;
    }

    // Rows before and behind a bottleneck, and the reachable runs of the first of them.
    struct Stretch {
        const Trail::Mark& mark;
        std::ptrdiff_t goal;
    };

    Stretch around(std::ptrdiff_t row, std::ptrdiff_t window) const noexcept {
        return {trail_.before(row - window), std::min(row + window, last_)};
    }

    // The first row may begin elsewhere with another radius.
    void resume(const Trail::Mark& mark, const Radius& radius) {
        if (mark.row > 0) {
            runs_ = mark.runs;
        } else {
            diagram_.start(radius, runs_);
        }
    }

    bool passes(const Stretch& stretch, double distance) {
        const Radius radius = radius_of(distance);
        resume(stretch.mark, radius);
        return walk(stretch.mark.row, stretch.goal, radius, nullptr) == stretch.goal &&
               (stretch.goal < last_ || diagram_.is_through(runs_, radius));
    }

    // A sufficient radius above `low`, which is not, from one bottleneck to the next. Nearly the
    // least that passes the last one, within `tolerance` doubles, as far as the window shows; or
    // `high`, which is sufficient.
    double climb(double low, double high, std::ptrdiff_t& window, std::uint64_t tolerance) {
        if (trail_radius_ != low) walks_through(radius_of(low));
        std::ptrdiff_t dead = trail_end_;
        for (;;) {
            const Stretch stretch = around(dead, window);
            const double found = least_double(low, high, first_stride, tolerance,
                                              [&](double x) { return passes(stretch, x); });
            if (found == high) return high;
            const Stretch wider = around(dead, 8 * window);
            if (!passes(wider, found) || passes(wider, below(found, tolerance, low))) {
                window *= 8;
                continue;
            }
            const Radius radius = radius_of(found);
            const std::ptrdiff_t from = stretch.mark.row;  // marks move when the trail grows
            resume(stretch.mark, radius);
            trail_.forget_from(from + 1);
            trail_radius_ = none;
            const std::ptrdiff_t reached = walk(from, last_, radius, &trail_);
            if (reached == last_ && diagram_.is_through(runs_, radius)) return found;
            if (reached < stretch.goal + window) {
                // Pushed on into a blind alley: the way out of it begins earlier.
                window *= 4;
                trail_.forget_from(from + 1);
            } else {
                low = found;
                dead = reached;
            }
        }
    }

    CurveView P_, Q_;
    RangeScale range_;
    Poller& poller_;
    const BoxedCurve& p_;
    const BoxedCurve& q_;
    ExactSigns second_signs_;  // of the edges of the second curve
    Diagram<Dim> diagram_;
    std::ptrdiff_t last_;  // row
    bool has_witnesses_ = false;
    std::ptrdiff_t row_witness_ = 0;
    std::ptrdiff_t column_witness_ = 0;
    double guess_ = 0.0;
    Runs& runs_;
    Runs& next_;
    Trail trail_;
    std::ptrdiff_t cells_around_ = 0;  // passed in windows
    std::ptrdiff_t rows_around_ = 0;
    double trail_radius_ = none;  // of the walk from row 0 that left the trail
    std::ptrdiff_t trail_end_ = 0;
};

}  // namespace curvewise::continuous
