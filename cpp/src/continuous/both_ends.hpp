// The least radius for which two walks through the free-space diagram meet, one from its first
// corner and one from its last. This search is for pairs for which a large part of the diagram is
// reachable, such as white noise. There the row in which a single walk ends seldom shows the
// bottleneck. The walk may have passed the bottleneck hundreds of rows before, in a part of the
// diagram that leads nowhere. The search of leash_search.hpp would enlarge its window around that
// row again and again.
//
//   1. Decisions use both walks; the walk that has passed fewer cells makes the next step. If one
//      walk ends at once, a no is cheap. A yes costs two small triangles instead of a large one.
//      Radii rise from the least by steps that double; then the interval is divided at a quarter,
//      since a no is the cheaper answer.
//   2. If the interval [low, high] is small, the rows reachable with `low` from either end are
//      completed. The backward walk with `high` meets the first of them in some row. The forward
//      walk from there with `high` meets the rows reachable from the other end with `low` in a
//      later row. The bottleneck lies between the two rows. Bisection over these rows alone gives
//      the least radius that connects them. It suffices for the curves, since every larger radius
//      reaches the points that `low` reaches.
//   3. A decision about the double below that radius shows that the radius is necessary. Otherwise
//      step 1 continues with that double as `high`, and step 2 with rows further outside. If these
//      are all rows, this is plain bisection.
//
// Time: about five decisions for white noise, at worst about 100. Memory: O(n + m).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "continuous/boxed_curve.hpp"
#include "continuous/exact_signs.hpp"
#include "continuous/free_space.hpp"
#include "continuous/least_double.hpp"
#include "continuous/reachable.hpp"
#include "continuous/trail.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

// A curve from its last point to its first, as a copy.
class BackwardCurve {
   public:
    BackwardCurve(const CurveView& curve, const RangeScale& range, Poller& poller)
        : points_(backward(curve)),
          view_(points_.data(), curve.size(), curve.dim()),
          boxed_(view_, range, poller) {}

    const CurveView& view() const noexcept { return view_; }
    const BoxedCurve& boxed() const noexcept { return boxed_; }

   private:
    static runtime::ScratchVector<double> backward(const CurveView& curve) {
        runtime::ScratchVector<double> points;
        points.reserve(static_cast<std::size_t>(curve.size() * curve.dim()));
        for (std::ptrdiff_t i = curve.size() - 1; i >= 0; --i) {
            for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) points.push_back(curve(i, c));
        }
        return points;
    }

    runtime::ScratchVector<double> points_;
    CurveView view_;
    BoxedCurve boxed_;
};

// A walk from the first corner of a diagram, or from a row with known reachable runs.
template <int Dim>
class EndWalk {
   public:
    EndWalk(const Diagram<Dim>& diagram, Poller& poller)
        : diagram_(diagram), poller_(poller), marks_(most_runs()), trail_(most_runs()) {}

    void begin(const Radius& radius) {
        diagram_.start(radius, runs_);
        row_ = cells_ = 0;
        trail_.forget_from(0);
        trail_.note(0, runs_);
    }
    // The first row may begin elsewhere with another radius.
    void resume(const Trail::Mark& mark, const Radius& radius) {
        row_ = mark.row;
        cells_ = 0;
        if (row_ > 0) {
            runs_ = mark.runs;
        } else {
            diagram_.start(radius, runs_);
        }
    }
    // Whether anything is reached of the next row, which the walk then is in.
    bool advance(const Radius& radius) {
        const std::ptrdiff_t cells = diagram_.advance(row_, runs_, radius, next_);
        poller_.spend(8 + 2 * cells);
        cells_ += cells;
        if (next_.empty()) return false;
        std::swap(runs_, next_);
        ++row_;
        return true;
    }
    void note() { trail_.note(row_, runs_); }

    // The marks of the walk since begin() are those that stay.
    void keep_marks() noexcept { std::swap(marks_, trail_); }
    // Continues from the last mark to the last row that has reachable points.
    void complete_marks(const Radius& radius) {
        resume(marks_.before(diagram_.rows()), radius);
        while (row_ < diagram_.rows() - 1 && advance(radius)) marks_.note(row_, runs_);
    }
    const Trail& marks() const noexcept { return marks_; }

    std::ptrdiff_t row() const noexcept { return row_; }
    std::ptrdiff_t cells() const noexcept { return cells_; }
    const Runs& runs() const noexcept { return runs_; }

   private:
    std::ptrdiff_t most_runs() const noexcept { return 4 * (diagram_.rows() + diagram_.cells()); }

    const Diagram<Dim>& diagram_;
    Poller& poller_;
    Trail marks_, trail_;
    Runs runs_, next_;
    std::ptrdiff_t row_ = 0;
    std::ptrdiff_t cells_ = 0;  // passed since it began, or began again
};

template <int Dim>
class BothEnds {
   public:
    // The curves, and their diagram.
    BothEnds(const CurveView& P, const CurveView& Q, const Diagram<Dim>& diagram,
             const RangeScale& range, Poller& poller)
        : range_(range),
          last_(diagram.rows() - 1),
          p_(P, range, poller),
          q_(Q, range, poller),
          diagram_(diagram),
          back_diagram_({p_.boxed(), q_.boxed(), ExactSigns(p_.view(), q_.view())},
                        {q_.boxed(), p_.boxed(), ExactSigns(q_.view(), p_.view())}, diagram.ends()),
          forth_(diagram_, poller),
          back_(back_diagram_, poller) {}

    // The least double within which the curves are. `low` holds the ends of the curves together,
    // and `high` suffices.
    double least_within(double low, double high = std::numeric_limits<double>::infinity()) {
        if (is_within(low)) return low;
        std::uint64_t stride = first_stride;
        for (bool is_low_new = true;;) {
            const std::uint64_t width = bits_of(high) - bits_of(low);
            if (width == 1) return high;
            if (is_low_new && width <= narrow) {
                is_low_new = false;
                high = least_between(low, high);
                const double less = next_below(high);
                if (less == low || !is_within(less)) return high;
                high = less;
                continue;
            }
            const std::uint64_t step = std::max(std::min(stride, width / 4), std::uint64_t{1});
            const double middle = double_of(bits_of(low) + step);
            is_low_new = !is_within(middle);
            (is_low_new ? low : high) = middle;
            stride *= is_low_new && stride < width ? 2 : 1;
        }
    }

   private:
    // In doubles: 2^-6 and 2^-8 of a radius.
    static constexpr std::uint64_t first_stride = std::uint64_t{1} << 46;
    static constexpr std::uint64_t narrow = std::uint64_t{1} << 44;

    Radius radius_of(double distance) const noexcept {
        return {distance, range_, diagram_.first_edges().dim(), FreeSet::closed};
    }

    // The marks of a radius that does not suffice are kept.
    bool is_within(double distance) {
        const Radius radius = radius_of(distance);
        forth_.begin(radius);
        back_.begin(radius);
        if (walks_meet(radius, true)) return true;
        forth_.keep_marks();
        back_.keep_marks();
        return false;
    }

    // Continues both walks until they are in one row, and marks rows on the way.
    bool walks_meet(const Radius& radius, bool is_marking) {
        while (forth_.row() + back_.row() < last_) {
            EndWalk<Dim>& walk = forth_.cells() <= back_.cells() ? forth_ : back_;
            if (!walk.advance(radius)) return false;
            if (is_marking) walk.note();
        }
        return have_met(forth_.runs(), back_.runs(), radius);
    }

    // Step 2. The marks are of `low`.
    double least_between(double low, double high) {
        const Radius least = radius_of(low), most = radius_of(high);
        forth_.complete_marks(least);
        back_.complete_marks(least);

        back_.begin(most);
        while (!meets_mark(back_, forth_, most)) back_.advance(most);
        const Trail::Mark& from = forth_.marks().before(last_ - back_.row() - margin_);
        forth_.resume(from, most);
        while (!meets_mark(forth_, back_, most)) forth_.advance(most);
        const Trail::Mark& to = back_.marks().before(last_ - forth_.row() - margin_);
        margin_ *= 4;

        return least_double(low, high, narrow, 1, [&](double x) {
            const Radius radius = radius_of(x);
            forth_.resume(from, radius);
            back_.resume(to, radius);
            return walks_meet(radius, false);
        });
    }

    // Whether a walk has met the marked runs of the other walk in its row. In the last row it has,
    // since the radius suffices.
    bool meets_mark(const EndWalk<Dim>& walk, const EndWalk<Dim>& other,
                    const Radius& radius) const {
        const std::ptrdiff_t row = last_ - walk.row();
        if (row == 0) return true;
        const Trail::Mark& mark = other.marks().before(row);
        if (mark.row != row) return false;
        return &walk == &forth_ ? have_met(walk.runs(), mark.runs, radius)
                                : have_met(mark.runs, walk.runs(), radius);
    }

    // Whether the parts of a row that are reachable from either end share a point. The radii may
    // differ, since a point that is free with one radius is free with every larger one. If one of
    // two runs holds an edge from its vertex on, it includes the other run's part of that edge.
    bool have_met(const Runs& forth, const Runs& back, const Radius& radius) const {
        const std::ptrdiff_t last_edge = diagram_.cells() - 1;
        std::size_t b = back.size();
        for (const Run& run : forth) {
            while (b > 0 && last_edge - back[b - 1].first < run.first) --b;
            if (b == 0) return false;
            const Run& other = back[b - 1];
            if (last_edge - other.last > run.last) continue;
            if (last_edge - other.first > run.first || ends_meet(run, other, radius)) return true;
        }
        return false;
    }

    // For the first runs that share an edge: whether the part reachable from below begins before
    // the part reachable from above ends.
    bool ends_meet(const Run& run, const Run& other, const Radius& radius) const {
        Bound high = other.low;
        if (!high.is_own_end()) {
            high = {last_ - high.index, high.radius, high.scaled_radius, 0.0, Bound::unknown};
        }
        return !diagram_.second_edges()
                    .from(run.first, run.low, {false, {}, high}, radius)
                    .is_empty;
    }

    RangeScale range_;
    std::ptrdiff_t last_;  // row
    BackwardCurve p_, q_;
    const Diagram<Dim>& diagram_;
    Diagram<Dim> back_diagram_;
    EndWalk<Dim> forth_, back_;
    std::ptrdiff_t margin_ = 16;  // rows
};

}  // namespace curvewise::continuous
