// The search for the nearest targets of several queries at once, by one thread, for pairs that take
// less time together than one by one (pairwise::TargetBlock).
//
// Each query has lower bounds of its pairs with all targets, many at once, and takes its targets in
// the order of these bounds, until the next one is above its k-th best distance. The queries take
// turns, so that the pairs of several queries fill the lanes of a kernel: a query's next target is
// chosen when its last distance is known, as in neighbor_search.hpp. Where the bounds take as long
// as the distances, or leave most of the pairs, all distances are computed.
//
// For N targets, O(N) time for each query and O(log N) for each distance, in addition to bounds and
// distances. Memory: the targets in lanes, and a bound for each pair of the block.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "nearest/found_neighbors.hpp"
#include "nearest/left_out.hpp"
#include "pairwise/bounded.hpp"
#include "pairwise/targets.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::nearest {

// A query: its curve, and the targets that it skips.
struct BlockQuery {
    const curves::CheckedCurve* curve;
    LeftOut left_out;
};

// How many pairs are computed at once, and their cost.
struct BlockSize {
    std::ptrdiff_t lanes = 1;
    pairwise::BesideEffort effort;
};

class BlockSearch {
   public:
    // Most queries at once.
    static constexpr std::ptrdiff_t most_queries = 32;

    // Of these targets, which have the same number of points.
    BlockSearch(const pairwise::Targets& all, const std::vector<std::ptrdiff_t>& targets,
                const BlockSize& size, runtime::Poller& poller);

    // Answers the queries, which have the same number of points. Throws Stopped.
    void answer(const BlockQuery* queries, std::ptrdiff_t count, const Question& question);
    // Of query i.
    runtime::ScratchVector<Neighbor>& found(std::ptrdiff_t i) {
        return rows_[static_cast<std::size_t>(i)].found.sorted();
    }

    // The counts since the last call.
    SearchRecord take_record() noexcept { return std::exchange(record_, {}); }

   private:
    struct Candidate {
        double bound;
        std::int32_t column;
        bool is_raised;
    };
    struct ComesLater {
        bool operator()(const Candidate& a, const Candidate& b) const noexcept {
            return a.bound != b.bound ? a.bound > b.bound : a.column > b.column;
        }
    };
    struct Row {
        FoundNeighbors found;
        LeftOut left_out;
        runtime::ScratchVector<Candidate> candidates;
        std::size_t next = 0;
        const curves::CheckedCurve* curve = nullptr;
        std::unique_ptr<pairwise::TargetQuery> query;  // null until a bound is raised
        runtime::ScratchVector<double> taken;          // bounds of the candidates

        // How many candidates a query takes that knows its last cutoff from the beginning.
        std::ptrdiff_t count_near() const noexcept {
            return std::count_if(taken.begin(), taken.end(),
                                 [most = found.cutoff()](double bound) { return !(bound > most); });
        }
    };

    // Most targets at once, which are in the processor's cache.
    static constexpr std::ptrdiff_t most_columns = 2048;

    std::ptrdiff_t target(std::ptrdiff_t column) const noexcept {
        return targets_[static_cast<std::size_t>(first_ + column)];
    }
    void answer_rows();
    std::ptrdiff_t count_left_out(LeftOut left_out) const noexcept;
    // All queries with a part of the targets.
    void look_at_part(std::ptrdiff_t first, std::ptrdiff_t count);
    // All queries with the columns from one to another.
    void look_at_columns(std::ptrdiff_t column, std::ptrdiff_t end);
    // A query with columns that are in lanes.
    void look_at_row(std::size_t i, std::ptrdiff_t first, std::ptrdiff_t count);
    bool is_left_out(const Row& row, std::ptrdiff_t column) const noexcept {
        return row.left_out.has(target(column));
    }
    void add(Row& row, std::ptrdiff_t column, double bound);
    // Of the values.
    void keep_all(Row& row, std::ptrdiff_t first, std::ptrdiff_t count);
    void keep(Row& row, std::ptrdiff_t column, double distance);
    // Until no query has another target.
    void take_turns();
    void order(Row& row) const;
    void take(std::size_t i, const Candidate& candidate);
    bool take_next(std::size_t i);
    bool take_nearest(std::size_t i);
    void raise(Row& row, Candidate& candidate);
    void compute_pairs();

    const pairwise::Targets& all_;
    const std::vector<std::ptrdiff_t>& targets_;
    std::ptrdiff_t lanes_;
    pairwise::BesideEffort effort_;
    runtime::Poller& poller_;
    std::unique_ptr<pairwise::TargetBlock> block_;
    std::ptrdiff_t first_ = -1;                       // of the targets that are columns
    runtime::ScratchVector<std::ptrdiff_t> columns_;  // 0, 1, ...
    runtime::ScratchVector<Row> rows_;
    runtime::ScratchVector<std::size_t> rows_now_;  // that are answered
    runtime::ScratchVector<double> values_;
    runtime::ScratchVector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> pairs_;
    Question question_;
    bool has_bounds_ = false;
    bool have_paid_ = false;  // the last bounds
    bool raises_bounds_ = false;
    pairwise::Trial trial_{0, 7};
    SearchRecord record_;
};

}  // namespace curvewise::nearest
