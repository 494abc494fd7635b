// The queries of one call of an index, shared out among threads. A query is one thread's, so that
// the number of threads changes nothing. Short curves are searched in blocks of queries.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "curves/checks.hpp"
#include "nearest/block_search.hpp"
#include "nearest/index_view.hpp"
#include "nearest/neighbor_search.hpp"
#include "pairwise/targets.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::nearest {

using curves::CheckedCurve;
using pairwise::Targets;

// Writes the targets that are found for curve `i` of the queries.
using Write = std::function<void(std::size_t i, runtime::ScratchVector<Neighbor>& found)>;

// The queries of one call: curves of the caller's, or those of the index, each without itself and
// the `exclusion` curves next to it on either side.
struct Queries {
    runtime::ScratchVector<CheckedCurve> curves;
    std::vector<std::ptrdiff_t> targets;  // none where they are the caller's
    std::ptrdiff_t exclusion = 0;

    LeftOut left_out(std::size_t i, std::ptrdiff_t size) const noexcept {
        if (targets.empty()) return {};
        const std::ptrdiff_t own = targets[i];
        return {own - std::min(exclusion, own), own + std::min(exclusion, size - 1 - own)};
    }
};

class QueryRun {
   public:
    QueryRun(const Targets& targets, const IndexView& view, const Queries& queries,
             const Question& question, const Write& write)
        : targets_(targets), view_(view), queries_(queries), question_(question), write_(write) {}

    SearchRecord run(std::ptrdiff_t workers, Poller& poller);

   private:
    std::int64_t steps(const CheckedCurve& P) const noexcept {
        return targets_.steps(P.curve.size(), view_.seen);
    }
    void run_one_by_one(std::ptrdiff_t workers, Poller& poller);
    // Returns the counts.
    SearchRecord answer(NeighborSearch& search, std::size_t i, Poller& poller);
    // Of all pairs, if these have one size; otherwise for pairs one by one.
    BlockSize block_size() const;
    void run_blocks(const BlockSize& size, std::ptrdiff_t workers, Poller& poller);
    // What a thread keeps from one block to the next.
    struct Searches {
        Searches(QueryRun& run, const BlockSize& its_size, Poller& own);
        bool trees_have_paid(const SearchRecord& record) const noexcept;
        NeighborSearch one;
        bool has_trees;
        pairwise::Trial trees;  // whether they pay
        BlockSize size;
        std::unique_ptr<BlockSearch> block;  // null until it is needed
    };
    void answer_block(Searches& searches, std::size_t first, std::size_t end, Poller& poller);
    SearchRecord add(const SearchRecord& record);
    // Those that are seen, made where they are needed.
    const std::vector<std::ptrdiff_t>& all_targets();

    const Targets& targets_;
    const IndexView& view_;
    const Queries& queries_;
    const Question& question_;
    const Write& write_;
    std::once_flag has_all_targets_;
    std::vector<std::ptrdiff_t> all_targets_;
    std::mutex mutex_;
    SearchRecord record_;
};

}  // namespace curvewise::nearest
