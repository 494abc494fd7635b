// Decides whether a radius is at least the discrete Fréchet distance: the walk of reachable.hpp
// over pairs of vertices alone (Eiter & Mannila 1994), by runs of vertices. It is exact. Time O(n
// log m) for similar curves, O(n m) at worst; memory O(runs of a row).
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "continuous/free_space.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

template <int Dim>
class CouplingWalk {
   public:
    // Rows are the points that `edges` is seen from, `rows` of them; columns its vertices.
    CouplingWalk(const EdgeFamily<Dim>& edges, std::ptrdiff_t rows, Poller& poller)
        : edges_(edges), rows_(rows), last_column_(edges.vertices() - 1), poller_(poller) {}

    bool succeeds(const Radius& radius) const {
        if (!edges_.vertex_is_free(0, 0, radius)) return false;
        runtime::ScratchVector<Run> runs, next;
        runs.push_back({0, last_free(0, 0, radius)});
        for (std::ptrdiff_t i = 1; i < rows_ && !runs.empty(); ++i) {
            advance(i, runs, radius, next);
            std::swap(runs, next);
        }
        return !runs.empty() && runs.back().last == last_column_;
    }

   private:
    // Columns first to last of a row, all of them reached.
    struct Run {
        std::ptrdiff_t first;
        std::ptrdiff_t last;
    };

    void advance(std::ptrdiff_t i, const runtime::ScratchVector<Run>& from, const Radius& radius,
                 runtime::ScratchVector<Run>& to) const {
        to.clear();
        std::ptrdiff_t next = 0;  // first column that no run of `to` has tested
        for (const Run& run : from) {
            // A step up, or up and to the right.
            const std::ptrdiff_t last = std::min(run.last + 1, last_column_);
            std::ptrdiff_t j = std::max(run.first, next);
            poller_.spend(last - j + 2);
            while (j <= last) {
                j = edges_.first_free_vertex(j, last, i, radius);
                if (j > last) break;
                to.push_back({j, last_free(i, j, radius)});
                j = to.back().last + 2;
                next = j;
            }
        }
    }

    // The last of the free columns from j on.
    std::ptrdiff_t last_free(std::ptrdiff_t i, std::ptrdiff_t j, const Radius& radius) const {
        return edges_.first_blocked_vertex(j + 1, last_column_, i, radius) - 1;
    }

    EdgeFamily<Dim> edges_;
    std::ptrdiff_t rows_;
    std::ptrdiff_t last_column_;
    Poller& poller_;
};

}  // namespace curvewise::continuous
