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
    const auto useful = static_cast<std::ptrdiff_t>(queries_.curves.size());
    run_workers(std::min(workers, useful), poller,
                [this](std::ptrdiff_t /*w*/, Poller& own) { take_queries(own); });
    if (failure_) std::rethrow_exception(failure_);
    poller.finish();
    return record_;
}

void QueryRun::take_queries(Poller& poller) noexcept {
    try {
        NeighborSearch search(targets_, seen_, poller);
        for (std::size_t i = next_++; i < queries_.curves.size() && !has_failed_; i = next_++) {
            const LoadedCurve loaded(queries_.curves[i], poller);
            const CheckedCurve& P = loaded.checked();
            const std::unique_ptr<TargetQuery> query = targets_.query(P, poller);
            answer_(search, *query, i, steps(P), queries_.left_out(i));
        }
        const std::lock_guard<std::mutex> lock(mutex_);
        record_.pairs += search.record().pairs;
        record_.refined += search.record().refined;
        record_.computed += search.record().computed;
    } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        has_failed_ = true;
    }
}

}  // namespace curvewise::nearest
