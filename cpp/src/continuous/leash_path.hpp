// A matching of two curves whose pair distances are all at most a given radius. It is a path
// through the free space from corner to corner, as parameters (vertex index + fraction) of both
// curves. It has one row for every side of a cell that it crosses. The path is traced backwards
// through the parts that a walk (reachable.hpp) reached. A cell can have been entered by more than
// one side. The trace takes the side with the nearer curves, at their nearest point. So the curves
// are close along the path, and it uses the whole radius only where it must.
//
// The reachable runs are kept for every sqrt(n)-th row, and for the rows between two of those at a
// time. Time: two walks and O(n + m). Memory: O(n + m) for the matching, and O(sqrt(n) r) if a row
// has r runs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "continuous/reachable.hpp"
#include "curves/range_scale.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

using LeashPath = std::vector<std::array<double, 2>>;

// Measures a matching, whose parameters are rounded, exactly.
template <int Dim>
class LeashMeasure {
   public:
    LeashMeasure(const Diagram<Dim>& diagram, const Radius& radius, const RangeScale& range,
                 Poller& poller) noexcept
        : diagram_(diagram), radius_(radius), range_(range), poller_(poller) {}

    // The least double that is not below the radius nor below the pair distance of any row. A row
    // that is longer than all rows before it is first moved by a unit in the last place, if that
    // helps. Rows at vertices of both curves are not moved, because the walks before and behind are
    // on different edges.
    double longest(LeashPath& matched) {
        for (std::size_t k = 1; k + 1 < matched.size(); ++k) {
            poller_.spend(64);
            std::array<double, 2>& row = matched[k];
            if (holds(row)) continue;
            const std::size_t side = row[0] == std::floor(row[0]) ? 1 : 0;
            std::array<double, 2> nearest = row;
            double least = leash(row);
            if (row[side] != std::floor(row[side])) {
                for (const auto& other : {matched[k - 1], matched[k + 1]}) {
                    std::array<double, 2> moved = row;
                    moved[side] = std::nextafter(row[side], other[side]);
                    const double moved_leash = holds(moved) ? radius_.given() : leash(moved);
                    if (moved_leash >= least) continue;
                    nearest = moved;
                    least = moved_leash;
                }
            }
            row = nearest;
            radius_ = Radius(least, range_, diagram_.first_edges().dim(), FreeSet::closed);
        }
        return radius_.given();
    }

    // The same where the first and the last row are not at vertices of both curves.
    double longest_with_ends(LeashPath& matched) {
        double found = longest(matched);
        for (const auto& row : {matched.front(), matched.back()}) {
            if (!holds(row)) found = std::max(found, leash(row));
        }
        return found;
    }

   private:
    // The edge that a row is on, the place on it, and the vertex of the other curve.
    template <class Use>
    auto with_place(const std::array<double, 2>& row, Use use) const {
        const bool is_at_first = row[0] == std::floor(row[0]);
        const EdgeFamily<Dim>& edges =
            is_at_first ? diagram_.second_edges() : diagram_.first_edges();
        const double at = row[is_at_first ? 1 : 0];
        const auto edge = std::min(static_cast<std::ptrdiff_t>(at), edges.vertices() - 2);
        return use(edges, edge, at - static_cast<double>(edge),
                   static_cast<std::ptrdiff_t>(row[is_at_first ? 0 : 1]));
    }
    bool holds(const std::array<double, 2>& row) const {
        return with_place(row, [&](const auto& edges, auto edge, double t, auto k) {
            return edges.point_is_free(edge, t, k, radius_);
        });
    }
    // The distance of a row, if it exceeds the radius.
    double leash(const std::array<double, 2>& row) const {
        return with_place(row, [&](const auto& edges, auto edge, double t, auto k) {
            return edges.distance_at(edge, t, k, radius_.given());
        });
    }

    const Diagram<Dim>& diagram_;
    Radius radius_;  // the largest pair distance so far
    const RangeScale& range_;
    Poller& poller_;
};

template <int Dim>
class LeashPathTrace {
   public:
    // A walk with this radius succeeds.
    LeashPathTrace(const Diagram<Dim>& diagram, const Radius& radius, Poller& poller)
        : diagram_(diagram), radius_(radius), poller_(poller) {}

    LeashPath parameters() {
        Runs start;
        diagram_.start(radius_, start);
        const Blocks blocks = blocks_from(std::move(start));
        const std::ptrdiff_t last = diagram_.rows() - 1;
        j_ = diagram_.cells() - 1;
        note(static_cast<double>(last), static_cast<double>(diagram_.cells()));
        trace(blocks);
        while (y_ > 0.0) note(0.0, std::ceil(y_) - 1.0);
        return reversed();
    }

    // Of a path that begins and ends anywhere in the first and the last row.
    LeashPath part() {
        Runs start;
        diagram_.start(radius_, start);
        const Blocks blocks = blocks_from(std::move(start));
        const std::ptrdiff_t last = diagram_.rows() - 1;
        ScratchRows rows;
        walk(blocks.first, last, blocks.marks.back(), rows);
        note(static_cast<double>(last), nearest_end(last, rows.back()));
        trace(blocks);
        return reversed();
    }

    // Of a path that begins at the first point of a run of the first row, and ends in the last row
    // so many edges behind that point.
    LeashPath around(const Run& section, std::ptrdiff_t turn) {
        const FreePart rest{false, section.low, {}};
        const double start = diagram_.second_edges().ends(section.first, rest).first;
        const double begin = static_cast<double>(section.first) + start;
        Runs runs;
        runs.push_back(section);
        const Blocks blocks = blocks_from(std::move(runs));
        j_ = section.first + turn;
        note(static_cast<double>(diagram_.rows() - 1), static_cast<double>(j_) + start);
        trace(blocks);
        // What rounding alone puts before the beginning is there.
        for (auto& row : found_) row[1] = std::max(row[1], begin);
        while (y_ > begin) note(0.0, std::max(std::ceil(y_) - 1.0, begin));
        return reversed();
    }

   private:
    using ScratchRows = runtime::ScratchVector<Runs>;

    // The reachable runs of every row whose number is a multiple of `size`; the last one is
    // `first`.
    struct Blocks {
        std::ptrdiff_t size, first;
        ScratchRows marks;
    };

    Blocks blocks_from(Runs start) const {
        const std::ptrdiff_t last = diagram_.rows() - 1;
        Blocks blocks{
            static_cast<std::ptrdiff_t>(std::ceil(std::sqrt(static_cast<double>(last)))), 0, {}};
        blocks.marks.push_back(std::move(start));
        ScratchRows rows;
        for (; blocks.first + blocks.size < last; blocks.first += blocks.size) {
            walk(blocks.first, blocks.first + blocks.size, blocks.marks.back(), rows);
            blocks.marks.push_back(std::move(rows.back()));
        }
        return blocks;
    }
    // From the last row, where the path is on edge j_, to the first one.
    void trace(const Blocks& blocks) {
        ScratchRows rows;
        i_ = diagram_.rows() - 1;
        for (std::size_t k = blocks.marks.size(); k-- > 0;) {
            const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(k) * blocks.size;
            walk(first, i_, blocks.marks[k], rows);
            while (i_ > first) trace_row(rows[static_cast<std::size_t>(i_ - 1 - first)]);
        }
    }
    LeashPath reversed() {
        std::reverse(found_.begin(), found_.end());
        return std::move(found_);
    }

    // The reachable place of a row that is nearest to its vertex. Puts its edge into j_.
    double nearest_end(std::ptrdiff_t i, const Runs& runs) {
        const auto& edges = diagram_.second_edges();
        double place = 0.0, least = std::numeric_limits<double>::infinity();
        for (const Run& run : runs) {
            for (std::ptrdiff_t j = run.first; j <= run.last; ++j) {
                FreePart part = diagram_.part_of_row(i, j, radius_);
                if (j == run.first) part.low = run.low;
                const auto [low, high] = edges.ends(j, part);
                const double t = chosen(part, low, high, edges.nearest(j, i), 1.0);
                const double square = edges.square_distance_at(j, t, i);
                if (square >= least) continue;
                least = square;
                place = static_cast<double>(j) + t;
                j_ = j;
            }
            poller_.spend(run.last - run.first);
        }
        return place;
    }

    void walk(std::ptrdiff_t first, std::ptrdiff_t last, const Runs& start,
              ScratchRows& rows) const {
        rows.resize(static_cast<std::size_t>(last - first + 1));
        rows[0] = start;
        for (std::ptrdiff_t i = first; i < last; ++i) {
            const auto k = static_cast<std::size_t>(i - first);
            poller_.spend(8 + 2 * diagram_.advance(i, rows[k], radius_, rows[k + 1]));
        }
    }

    void note(double x, double y) {
        if (!found_.empty() && x == x_ && y == y_) return;
        x_ = x;
        y_ = y;
        found_.push_back({x, y});
    }

    // From a point of row i_ on edge j_ down to the row below, whose reachable runs are `runs`.
    void trace_row(const Runs& runs) {
        const std::ptrdiff_t i = i_ - 1;
        chain_of_ = runs.size();
        for (;;) {
            const FreePart below = reached_below(i, runs);
            const FreePart left = reached_left(i, runs);
            if (!leave_cell(i, below, left)) break;
            if (j_ == 0) {  // down the side of the diagram
                note(static_cast<double>(i), 0.0);
                break;
            }
            --j_;
        }
        i_ = i;
    }

    // Notes where the path enters cell (i, j_) and returns whether this is on its left side.
    bool leave_cell(std::ptrdiff_t i, const FreePart& below, const FreePart& left) {
        const auto& rows = diagram_.second_edges();
        const auto& columns = diagram_.first_edges();
        const auto i0 = static_cast<double>(i);
        const auto j0 = static_cast<double>(j_);
        const auto [below_low, below_high] = rows.ends(j_, below);
        const auto [left_low, left_high] = columns.ends(i, left);
        // What rounding alone puts out of reach is in reach.
        const bool can_go_down = !below.is_empty && (j0 + below_low <= y_ || left.is_empty);
        const bool can_go_left =
            !left.is_empty && (i0 + left_low <= x_ || below.is_empty || !can_go_down);
        const double new_y =
            j0 + chosen(below, below_low, below_high, rows.nearest(j_, i), y_ - j0);
        const double new_x =
            i0 + chosen(left, left_low, left_high, columns.nearest(i, j_), x_ - i0);
        const bool goes_left =
            can_go_left && (!can_go_down || columns.square_distance_at(i, new_x - i0, j_) <
                                                rows.square_distance_at(j_, new_y - j0, i));
        if (goes_left) {
            note(std::min(new_x, x_), j0);
        } else {
            note(i0, std::min(new_y, y_));
        }
        return goes_left;
    }

    // The parameter between low and high, and at most `most`, that is nearest to `wished`. It keeps
    // off the exact end of a vertex's reach if the interval allows, because rounding there
    // increases the distance.
    static double chosen(const FreePart& part, double low, double high, double wished,
                         double most) noexcept {
        constexpr double margin = 0x1p-10;
        const double room = std::max(std::min(high, most) - low, 0.0);
        const double least = part.low.is_own_end() ? low : low + margin * room;
        const double greatest = part.high.is_own_end() ? high : high - margin * room;
        return std::min(std::max(std::min(wished, greatest), least), most);
    }

    // The reachable part of the lower side of cell (i, j_).
    FreePart reached_below(std::ptrdiff_t i, const Runs& runs) const {
        const std::size_t r = run_at(runs, j_ + 1);
        if (r == runs.size() || runs[r].last < j_) return {true, {}, {}};
        FreePart part = diagram_.part_of_row(i, j_, radius_);
        if (runs[r].first == j_) part.low = runs[r].low;
        return part;
    }

    // The reachable part of its left side.
    FreePart reached_left(std::ptrdiff_t i, const Runs& runs) {
        if (j_ == 0) {
            const bool is_reached = runs[0].first == 0 && runs[0].low.is_own_end();
            return is_reached ? diagram_.part_of_column(i, 0, radius_) : FreePart{true, {}, {}};
        }
        const std::size_t r = run_at(runs, j_);
        if (r == runs.size()) return {true, {}, {}};
        if (j_ <= runs[r].last) return diagram_.part_of_column(i, j_, radius_);
        if (chain_of_ != r) follow_chain(i, runs[r].last + 1, r);
        const auto k = static_cast<std::size_t>(j_ - runs[r].last - 1);
        return k < chain_.size() ? chain_[k] : FreePart{true, {}, {}};
    }

    // The left sides that are reached from cell to cell behind run r, up to cell j_.
    void follow_chain(std::ptrdiff_t i, std::ptrdiff_t first, std::size_t r) {
        chain_.clear();
        chain_of_ = r;
        Bound low;
        for (std::ptrdiff_t j = first; j <= j_; ++j) {
            FreePart part = diagram_.part_of_column(i, j, radius_);
            if (!part.is_empty) part = diagram_.first_edges().from(i, low, part, radius_);
            if (part.is_empty) return;
            chain_.push_back(part);
            low = part.low;
        }
    }

    // The index of the last run that begins before column j, or the number of runs if there is no
    // such run.
    static std::size_t run_at(const Runs& runs, std::ptrdiff_t j) noexcept {
        const auto behind = std::partition_point(runs.begin(), runs.end(),
                                                 [j](const Run& run) { return run.first < j; });
        return behind == runs.begin() ? runs.size()
                                      : static_cast<std::size_t>(behind - runs.begin()) - 1;
    }

    const Diagram<Dim>& diagram_;
    const Radius radius_;
    Poller& poller_;
    LeashPath found_;       // from the last to the first
    std::ptrdiff_t i_ = 0;  // the path is in row i_, on edge j_
    std::ptrdiff_t j_ = 0;
    double x_ = 0.0, y_ = 0.0;
    runtime::ScratchVector<FreePart> chain_;
    std::size_t chain_of_ = 0;  // the run that the chain begins behind
};

}  // namespace curvewise::continuous
