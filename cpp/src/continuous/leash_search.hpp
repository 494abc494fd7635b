// The continuous Fréchet distance of two curves as a double, and decisions about it, all certified.
//
// The decision is a walk through the rows of the free-space diagram (reachable.hpp), exact for any
// radius. The value is the least double for which it says yes: the real number rounded up. Looking
// for it by bisection would take some 50 walks; instead,
//
//   1. the leash must hold the ends together, and the two vertices that lie furthest from the other
//      curve (nearest.hpp): the least radius that does is found without a walk, and a walk with it
//      succeeds for many curves that are alike;
//   2. a walk that fails dies at the row of a bottleneck. The least radius that passes it is found
//      by bisection on walks that begin `window` rows before it and end as many behind it;
//   3. the walk goes on with that radius, to its end or to the next bottleneck;
//   4. the radius r it ends with is sufficient; a whole walk with the double below r, which dies at
//      the bottleneck, shows that it is necessary. If that walk ends well, the bottleneck was not
//      where the walks died: again with a window eight times as wide. Once it is as wide as the
//      diagram this is plain bisection.
//
// What a walk reached with one radius is reached with every larger one, so that a walk may begin
// where one with a smaller radius passed. About three walks in all; memory O(n + m).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "checks.hpp"
#include "continuous/boxed_curve.hpp"
#include "continuous/exact_signs.hpp"
#include "continuous/free_space.hpp"
#include "continuous/least_double.hpp"
#include "continuous/nearest.hpp"
#include "continuous/reachable.hpp"
#include "curvewise/curve.hpp"
#include "watch.hpp"

namespace curvewise::detail {

// What was reached of some rows, a few of them and not more than so many runs in all.
class Trail {
   public:
    struct Mark {
        std::ptrdiff_t row;
        Runs runs;
    };

    explicit Trail(std::ptrdiff_t most_runs) noexcept : most_runs_(most_runs) {}

    void note(std::ptrdiff_t row, const Runs& runs) {
        if (row % stride_ != 0) return;
        marks_.push_back({row, runs});
        held_ += static_cast<std::ptrdiff_t>(runs.size());
        if (held_ > most_runs_) thin_out();
    }
    void forget_from(std::ptrdiff_t row) {
        while (!marks_.empty() && marks_.back().row >= row) {
            held_ -= static_cast<std::ptrdiff_t>(marks_.back().runs.size());
            marks_.pop_back();
        }
    }
    // The last mark at `row` or before it. Row 0 is always marked.
    const Mark& before(std::ptrdiff_t row) const noexcept {
        std::size_t k = marks_.size() - 1;
        while (k > 0 && marks_[k].row > row) --k;
        return marks_[k];
    }

   private:
    void thin_out() {
        stride_ *= 2;
        held_ = 0;
        std::size_t kept = 0;
        for (Mark& mark : marks_) {
            if (mark.row % stride_ != 0) continue;
            held_ += static_cast<std::ptrdiff_t>(mark.runs.size());
            std::swap(marks_[kept++], mark);
        }
        marks_.resize(kept);
    }

    std::ptrdiff_t most_runs_;
    std::ptrdiff_t held_ = 0;
    std::ptrdiff_t stride_ = 8;
    std::vector<Mark> marks_;
};

template <int Dim>
class LeashSearch {
   public:
    // Two curves of at least two points each.
    LeashSearch(const CurveView& P, const CurveView& Q, const RangeScale& range, Watch& watch)
        : range_(range),
          watch_(watch),
          p_(P, range),
          q_(Q, range),
          diagram_(EdgeFamily<Dim>(p_, q_, ExactSigns(P, Q)),
                   EdgeFamily<Dim>(q_, p_, ExactSigns(Q, P))),
          last_(diagram_.rows() - 1),
          trail_(P.size() + Q.size()) {}

    // Whether the distance is at most, or below, a number.
    bool is_within(double distance, FreeSet set = FreeSet::closed) {
        const Radius radius = radius_of(distance, set);
        if (is_too_short(radius)) return false;
        diagram_.start(radius, runs_);
        trail_.forget_from(0);
        trail_.note(0, runs_);
        trail_radius_ = distance;
        trail_end_ = walk(0, last_, radius, &trail_);
        return trail_end_ == last_ && diagram_.is_through(runs_, radius);
    }

    // The real number rounded up; inf beyond the range of a double.
    double value() {
        find_witnesses();
        double low = least_of_witnesses();
        if (is_within(low)) return low;  // and nothing below it holds the witnesses
        double high = std::numeric_limits<double>::infinity();
        std::ptrdiff_t window = 16;
        for (const std::uint64_t tolerance : {std::uint64_t{1} << 42, std::uint64_t{1}}) {
            for (;;) {
                high = climb(low, high, window, tolerance);
                const std::uint64_t gap = bits_of(high) - bits_of(low);
                const double below = double_of(bits_of(high) - std::min(tolerance, gap));
                if (below == low || !is_within(below)) {
                    low = below;
                    break;
                }
                high = below;
                window *= 8;
            }
        }
        return high;
    }

   private:
    static constexpr double none = -1.0;

    Radius radius_of(double distance, FreeSet set = FreeSet::closed) const noexcept {
        return {distance, range_.shrink(distance), p_.dim(), set};
    }

    // The vertices of either curve that are furthest from the other.
    void find_witnesses() {
        Furthest floor{std::max(square_distance<Dim>(p_.point(0), q_.point(0), p_.dim()),
                                square_distance<Dim>(p_.point(last_), q_.point(q_.size() - 1),
                                                     p_.dim())),
                       0};
        floor = NearestEdges<Dim>(q_).furthest(p_, floor);
        row_witness_ = floor.vertex;
        floor.vertex = 0;
        floor = NearestEdges<Dim>(p_).furthest(q_, floor);
        column_witness_ = floor.vertex;
        guess_ = range_.restore(std::sqrt(floor.square), 1);
    }

    // Whether the ends, or the witnesses, are too far apart.
    bool is_too_short(const Radius& radius) const {
        return !diagram_.corner_is_free(0, 0, radius) ||
               !diagram_.corner_is_free(last_, diagram_.cells(), radius) ||
               (row_witness_ > 0 && diagram_.row_is_blocked(row_witness_, radius)) ||
               (column_witness_ > 0 && diagram_.column_is_blocked(column_witness_, radius));
    }

    double least_of_witnesses() const {
        const auto holds = [&](double x) { return !is_too_short(radius_of(x)); };
        if (holds(0.0)) return 0.0;
        const double below = guess_ * (1.0 - 0x1p-50);
        const double infinity = std::numeric_limits<double>::infinity();
        return least_double(holds(below) ? 0.0 : below, infinity, 2, 1, holds);
    }

    // From what runs_ reached of row `from` to row `to`. Returns the last row of which anything
    // was reached.
    std::ptrdiff_t walk(std::ptrdiff_t from, std::ptrdiff_t to, const Radius& radius,
                        Trail* trail) {
        for (std::ptrdiff_t i = from; i < to; ++i) {
            diagram_.advance(i, runs_, radius, next_);
            if (next_.empty()) return i;
            std::swap(runs_, next_);
            if (trail != nullptr) trail->note(i + 1, runs_);
            if (watch_.step(0)) throw Stopped();
        }
        return to;
    }

    // A sufficient radius above `low`, which is not, from one bottleneck to the next. Nearly the
    // least that passes the last one, within `tolerance` doubles, as far as the window shows; or
    // `high`, which is sufficient.
    double climb(double low, double high, std::ptrdiff_t window, std::uint64_t tolerance) {
        if (trail_radius_ != low) is_within(low);
        std::ptrdiff_t dead = trail_end_;
        for (;;) {
            const Trail::Mark mark = trail_.before(dead - window);
            const std::ptrdiff_t goal = std::min(dead + window, last_);
            const auto passes = [&](double x) {
                const Radius tried = radius_of(x);
                runs_ = mark.runs;
                return walk(mark.row, goal, tried, nullptr) == goal &&
                       (goal < last_ || diagram_.is_through(runs_, tried));
            };
            const double found =
                least_double(low, high, std::uint64_t{1} << 40, tolerance, passes);
            if (found == high) return high;
            const Radius radius = radius_of(found);
            runs_ = mark.runs;
            trail_.forget_from(mark.row + 1);
            trail_radius_ = none;
            const std::ptrdiff_t reached = walk(mark.row, last_, radius, &trail_);
            if (reached == last_ && diagram_.is_through(runs_, radius)) return found;
            if (reached < goal + window) {
                // Pushed on into a blind alley: the way out of it begins earlier.
                window *= 4;
                trail_.forget_from(mark.row + 1);
            } else {
                low = found;
                dead = reached;
            }
        }
    }

    RangeScale range_;
    Watch& watch_;
    BoxedCurve<Dim> p_, q_;
    Diagram<Dim> diagram_;
    std::ptrdiff_t last_;  // row
    std::ptrdiff_t row_witness_ = 0;
    std::ptrdiff_t column_witness_ = 0;
    double guess_ = 0.0;
    Runs runs_, next_;
    Trail trail_;
    double trail_radius_ = none;  // of the walk from row 0 that left the trail
    std::ptrdiff_t trail_end_ = 0;
};

}  // namespace curvewise::detail
