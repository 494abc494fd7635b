#include "nearest/query_run.hpp"

#include <algorithm>
#include <memory>

#include "curves/owned_curve.hpp"
#include "runtime/workers.hpp"

namespace curvewise::nearest {

using curves::LoadedCurve;

SearchRecord QueryRun::run(std::ptrdiff_t workers, Poller& poller) {
    std::int64_t total = 0;
    for (const CheckedCurve& P : queries_.curves) total += steps(P);
    poller.begin(total);
    const BlockSize size = block_size();
    if (size.lanes > 1) {
        run_blocks(size, workers, poller);
    } else {
        run_one_by_one(workers, poller);
    }
    poller.finish();
    return record_;
}

void QueryRun::run_one_by_one(std::ptrdiff_t workers, Poller& poller) {
    runtime::for_each(queries_.curves.size(), workers, poller, [&](Poller& own) {
        return [&, search = NeighborSearch(targets_, view_.seen, own)](std::size_t i) mutable {
            answer(search, i, own);
        };
    });
}

SearchRecord QueryRun::answer(NeighborSearch& search, std::size_t i, Poller& poller) {
    const LoadedCurve loaded(queries_.curves[i], poller);
    const CheckedCurve& P = loaded.checked();
    const std::unique_ptr<TargetQuery> query = targets_.query(P, poller);
    write_(i, search.answer(*query, steps(P), question_, queries_.left_out(i, view_.seen.size)));
    return add(search.take_record());
}

BlockSize QueryRun::block_size() const {
    if (queries_.curves.empty() || view_.sizes->size() != 1) return {};
    const std::ptrdiff_t n = queries_.curves.front().curve.size();
    const bool are_equal = std::all_of(queries_.curves.begin(), queries_.curves.end(),
                                       [&](const CheckedCurve& P) { return P.curve.size() == n; });
    const std::ptrdiff_t m = *view_.sizes->begin();
    if (!are_equal) return {};
    const pairwise::BesideEffort effort = targets_.effort_beside(n, m);
    return {effort.is_wide ? 1 : targets_.most_beside(n, m), effort};
}

void QueryRun::run_blocks(const BlockSize& size, std::ptrdiff_t workers, Poller& poller) {
    const std::size_t count = queries_.curves.size();
    const auto threads = static_cast<std::size_t>(workers);
    const std::size_t block =
        std::clamp<std::size_t>((count + threads - 1) / threads, 1, BlockSearch::most_queries);
    runtime::for_each((count + block - 1) / block, workers, poller, [&](Poller& own) {
        return [&, searches = Searches(*this, size, own)](std::size_t b) mutable {
            answer_block(searches, b * block, std::min((b + 1) * block, count), own);
        };
    });
}

const std::vector<std::ptrdiff_t>& QueryRun::all_targets() {
    std::call_once(has_all_targets_, [&] { all_targets_ = view_.targets(); });
    return all_targets_;
}

QueryRun::Searches::Searches(QueryRun& run, const BlockSize& its_size, Poller& own)
    : one(run.targets_, run.view_.seen, own),
      has_trees(run.view_.seen.forest != nullptr),
      trees(0, BlockSearch::most_queries - 1),
      size(its_size) {}

// Whether the search by trees took less time than that of all targets at once, by the bounds and
// distances that both have computed. In cells, by measurement.
bool QueryRun::Searches::trees_have_paid(const SearchRecord& record) const noexcept {
    const double first_bound = 100.0, raised_bound = 1500.0;
    const auto pairs = static_cast<double>(record.pairs);
    const double taken = first_bound * static_cast<double>(one.first_bounds()) +
                         raised_bound * static_cast<double>(record.refined);
    return taken <= pairs * std::min(size.effort.value, size.effort.bound);
}

// With trees, some queries are searched for one by one to find out whether these skip most targets.
void QueryRun::answer_block(Searches& searches, std::size_t first, std::size_t end,
                            Poller& poller) {
    runtime::ScratchVector<LoadedCurve> loaded;
    loaded.reserve(end - first);
    std::size_t places[BlockSearch::most_queries];
    BlockQuery queries[BlockSearch::most_queries];
    for (std::size_t i = first; i < end; ++i) {
        if (searches.has_trees && searches.trees.is_due()) {
            const SearchRecord record = answer(searches.one, i, poller);
            searches.trees.record(searches.trees_have_paid(record));
            continue;
        }
        places[loaded.size()] = i;
        loaded.emplace_back(queries_.curves[i], poller);
        queries[loaded.size() - 1] = {&loaded.back().checked(),
                                      queries_.left_out(i, view_.seen.size)};
    }
    if (loaded.empty()) return;
    if (!searches.block) {
        searches.block =
            std::make_unique<BlockSearch>(targets_, all_targets(), searches.size, poller);
    }
    searches.block->answer(queries, static_cast<std::ptrdiff_t>(loaded.size()), question_);
    for (std::size_t k = 0; k < loaded.size(); ++k) {
        write_(places[k], searches.block->found(static_cast<std::ptrdiff_t>(k)));
        if (poller.count_steps(steps(queries_.curves[places[k]]), 0)) throw Stopped();
    }
    add(searches.block->take_record());
}

SearchRecord QueryRun::add(const SearchRecord& record) {
    const std::lock_guard<std::mutex> lock(mutex_);
    record_.pairs += record.pairs;
    record_.refined += record.refined;
    record_.computed += record.computed;
    return record;
}

}  // namespace curvewise::nearest
