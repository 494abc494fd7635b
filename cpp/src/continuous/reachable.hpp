// The points of a free-space diagram that a monotone path from its first corner reaches, one row
// after the other. Row i is vertex i of the first curve against the edges of the second. The
// reachable part of a row is stored as runs of edges. Similar curves have few runs, so unreachable
// rows and columns cost nothing. Inside a run, and next to it, boxes of edges are passed in one
// step. Every answer is exact. Memory O(runs of a row), time O(n log m) for similar curves, O(n m)
// at worst.
//
// The reachable part of an edge of a cell is an interval that ends where the free part ends (Alt &
// Godau 1995, Lemma 3). So only its lower bound is carried. The bound is the greatest of the lower
// bounds of free parts of that edge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "continuous/free_space.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

// A run of a row: edges first to last. Each is reached from its first vertex on, the first one from
// `low` on. The vertex behind the last is not free, unless it is the last of the curve.
struct Run {
    std::ptrdiff_t first;
    std::ptrdiff_t last;
    Bound low;
};
using Runs = runtime::ScratchVector<Run>;

// Where paths begin and end: in the corners, or anywhere on the first edges of the first row and
// the last edges of the last row.
struct PathEnds {
    static constexpr PathEnds corners() noexcept { return {0}; }
    static constexpr PathEnds anywhere() noexcept {
        return {std::numeric_limits<std::ptrdiff_t>::max()};
    }
    std::ptrdiff_t edges;  // 0: the corners
};

template <int Dim>
class Diagram {
   public:
    // Row i is compared with the edges of the second curve, column j with the edges of the first.
    Diagram(const EdgeFamily<Dim>& first, const EdgeFamily<Dim>& second,
            PathEnds ends = PathEnds::corners())
        : columns_(first), rows_(second), ends_(ends) {}

    std::ptrdiff_t rows() const noexcept { return columns_.vertices(); }
    // The edges of the second curve; each is a cell of a row.
    std::ptrdiff_t cells() const noexcept { return rows_.vertices() - 1; }

    bool corner_is_free(std::ptrdiff_t i, std::ptrdiff_t j, const Radius& radius) const {
        return rows_.vertex_is_free(j, i, radius);
    }
    // Whether nothing of a row, or a column, is free. `near` is the edge where the search begins,
    // and then the one that is free.
    bool row_is_blocked(std::ptrdiff_t i, const Radius& radius, std::ptrdiff_t& near) const {
        return rows_.is_blocked(i, radius, near);
    }
    bool column_is_blocked(std::ptrdiff_t j, const Radius& radius, std::ptrdiff_t& near) const {
        return columns_.is_blocked(j, radius, near);
    }

    // The free part of edge j of the second curve in row i, and of edge i of the first in column j.
    FreePart part_of_row(std::ptrdiff_t i, std::ptrdiff_t j, const Radius& radius) const {
        return rows_.free_part(j, i, corner_is_free(i, j, radius), corner_is_free(i, j + 1, radius),
                               radius);
    }
    FreePart part_of_column(std::ptrdiff_t i, std::ptrdiff_t j, const Radius& radius) const {
        return columns_.free_part(i, j, corner_is_free(i, j, radius),
                                  corner_is_free(i + 1, j, radius), radius);
    }
    PathEnds ends() const noexcept { return ends_; }
    // The edges of the first curve, seen from columns, and of the second, seen from rows.
    const EdgeFamily<Dim>& first_edges() const noexcept { return columns_; }
    const EdgeFamily<Dim>& second_edges() const noexcept { return rows_; }

    // The reachable part of row 0, whose first corner is free if paths begin there.
    void start(const Radius& radius, Runs& runs) const {
        runs.clear();
        if (ends_.edges > 0) {
            return enter_from_left(-1, 0, std::min(ends_.edges, cells()) - 1, radius, runs);
        }
        runs.push_back({0, 0, {}});
        runs[0].last = rows_.first_blocked_vertex(0, cells(), 0, radius) - 1;
        runs[0].last = std::min(runs[0].last, cells() - 1);
    }

    // Computes the reachable part of row i + 1 from that of row i. Returns the number of cells
    // between the first and the last tested.
    std::ptrdiff_t advance(std::ptrdiff_t i, const Runs& from, const Radius& radius,
                           Runs& to) const {
        to.clear();
        std::ptrdiff_t cells_passed = 0;
        std::ptrdiff_t entered = -1;  // the last tested cell with a reachable left side
        for (std::size_t r = 0; r < from.size(); ++r) {
            const Run& run = from[r];
            const std::ptrdiff_t next = r + 1 < from.size() ? from[r + 1].first : cells() - 1;
            std::ptrdiff_t first = run.first;
            if (!(entered == run.first || (run.first == 0 && run.low.is_own_end()))) {
                enter_from_below(i, run, radius, to);
                ++first;
            }
            entered = last_entered(i, run.last, next, radius);
            const bool again = r + 1 < from.size() && entered == next;
            enter_from_left(i, first, again ? entered - 1 : entered, radius, to);
            cells_passed += entered - run.first + 1;
        }
        return cells_passed;
    }

    // Whether a path that has reached the runs of the last row has reached its end.
    bool is_through(const Runs& last_row, const Radius& radius) const {
        if (ends_.edges > 0) {
            return !last_row.empty() && last_row.back().last >= cells() - ends_.edges;
        }
        return !last_row.empty() && last_row.back().last == cells() - 1 &&
               corner_is_free(rows() - 1, cells(), radius);
    }

   private:
    // The cell above the first edge of a run, whose left side nothing reaches.
    void enter_from_below(std::ptrdiff_t i, const Run& run, const Radius& radius, Runs& to) const {
        const std::ptrdiff_t j = run.first;
        const FreePart top = part_of_row(i + 1, j, radius);
        if (top.is_empty) return;
        const FreePart reached = rows_.from(j, run.low, top, radius);
        if (!reached.is_empty) to.push_back({j, j, reached.low});
    }

    // The cells from `first` to `last`, whose left sides are reached: all that is free above them
    // is, too.
    void enter_from_left(std::ptrdiff_t i, std::ptrdiff_t first, std::ptrdiff_t last,
                         const Radius& radius, Runs& to) const {
        if (first > last) return;
        std::ptrdiff_t j = first;
        if (corner_is_free(i + 1, j, radius)) {
            // A run that ends before cell j continues in it: the free part of the cell before ends
            // in the corner between them.
            if (to.empty() || to.back().last != j - 1) to.push_back({j, j, {}});
            j = extend(i, j, last, radius, to.back());
        }
        while (j <= last) {
            j = rows_.first_free_edge(j, last, i + 1, radius);
            if (j > last) return;
            const bool second_is_free = corner_is_free(i + 1, j + 1, radius);
            to.push_back({j, j, rows_.free_part(j, i + 1, false, second_is_free, radius).low});
            ++j;
            if (second_is_free) j = extend(i, j, last, radius, to.back());
        }
    }

    // Lets a run of row i + 1 go on from edge j, whose first vertex is free, at most to `last`.
    // Returns the edge behind it.
    std::ptrdiff_t extend(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t last,
                          const Radius& radius, Run& run) const {
        if (j > last) return j;
        const std::ptrdiff_t blocked = rows_.first_blocked_vertex(j + 1, last + 1, i + 1, radius);
        run.last = std::min(blocked - 1, last);
        return run.last + 1;
    }

    // The last cell, up to `most`, that a path enters from its left after it has reached the lower
    // edge of cell `from`; `from` itself if there is no such cell.
    std::ptrdiff_t last_entered(std::ptrdiff_t i, std::ptrdiff_t from, std::ptrdiff_t most,
                                const Radius& radius) const {
        Bound low;  // of the edge of the first curve
        for (std::ptrdiff_t j = from + 1; j <= most; ++j) {
            const FreePart left = part_of_column(i, j, radius);
            if (left.is_empty) return j - 1;
            const FreePart reached = columns_.from(i, low, left, radius);
            if (reached.is_empty) return j - 1;
            low = reached.low;
        }
        return std::max(from, most);
    }

    EdgeFamily<Dim> columns_;  // the edges of the first curve
    EdgeFamily<Dim> rows_;     // the edges of the second
    PathEnds ends_;
};

}  // namespace curvewise::continuous
