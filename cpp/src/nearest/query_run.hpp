// The queries of one call of an index, shared out among threads. A query is one thread's, so that
// the number of threads changes nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "curves/checks.hpp"
#include "nearest/neighbor_search.hpp"
#include "pairwise/targets.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::nearest {

using curves::CheckedCurve;
using pairwise::Seen;
using pairwise::Targets;

// Answers one query: for curve `i` of the queries.
using Answer = std::function<void(NeighborSearch& search, TargetQuery& query, std::size_t i,
                                  std::int64_t all_steps, LeftOut left_out)>;

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
    QueryRun(const Targets& targets, const Seen& seen, const Queries& queries, const Answer& answer)
        : targets_(targets), seen_(seen), queries_(queries), answer_(answer) {}

    SearchRecord run(std::ptrdiff_t workers, Poller& poller);

   private:
    std::int64_t steps(const CheckedCurve& P) const noexcept {
        return targets_.steps(P.curve.size(), seen_);
    }
    void answer(NeighborSearch& search, std::size_t i, Poller& poller);

    const Targets& targets_;
    const Seen& seen_;
    const Queries& queries_;
    const Answer& answer_;
    std::mutex mutex_;
    SearchRecord record_;
};

}  // namespace curvewise::nearest
