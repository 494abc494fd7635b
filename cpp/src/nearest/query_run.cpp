#include "nearest/query_run.hpp"

#include <memory>

#include "curves/owned_curve.hpp"
#include "runtime/workers.hpp"

namespace curvewise::nearest {

using curves::LoadedCurve;

SearchRecord QueryRun::run(std::ptrdiff_t workers, Poller& poller) {
    std::int64_t total = 0;
    for (const CheckedCurve& P : queries_.curves) total += steps(P);
    poller.begin(total);
    runtime::for_each(queries_.curves.size(), workers, poller, [&](Poller& own) {
        return [&, search = NeighborSearch(targets_, seen_, own)](std::size_t i) mutable {
            answer(search, i, own);
        };
    });
    poller.finish();
    return record_;
}

void QueryRun::answer(NeighborSearch& search, std::size_t i, Poller& poller) {
    const LoadedCurve loaded(queries_.curves[i], poller);
    const CheckedCurve& P = loaded.checked();
    const std::unique_ptr<TargetQuery> query = targets_.query(P, poller);
    answer_(search, *query, i, steps(P), queries_.left_out(i, seen_.size));
    const SearchRecord record = search.take_record();
    const std::lock_guard<std::mutex> lock(mutex_);
    record_.pairs += record.pairs;
    record_.refined += record.refined;
    record_.computed += record.computed;
}

}  // namespace curvewise::nearest
