// Index: the curves, prepared by their measure, which keeps their points, and queries shared out
// among threads. A query is one thread's, so that the number of threads changes nothing.
//
// A call sees the curves that were there when it began. It neither waits for add() nor keeps it
// waiting: add() writes behind the curves that others see, and then shows the new ones to the calls
// that begin later.
#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "curves/owned_curve.hpp"
#include "curvewise/nearest.hpp"
#include "nearest/neighbor_search.hpp"
#include "pairwise/batch.hpp"
#include "runtime/workers.hpp"

namespace curvewise {
namespace {

using curves::CheckedCurve;
using curves::CurveInDoubles;
using curves::CurveList;
using curves::LoadedCurve;
using nearest::NeighborSearch;
using pairwise::Seen;
using pairwise::TargetQuery;
using pairwise::Targets;
using runtime::Poller;

// Answers one query: for curve `i` of the queries, without the target `left_out`, or -1.
using Answer = std::function<void(NeighborSearch& search, TargetQuery& query, std::size_t i,
                                  std::int64_t all_steps, std::ptrdiff_t left_out)>;

// The queries of one call: curves of the caller's, or all of the index, each without itself.
struct Queries {
    std::vector<CheckedCurve> curves;
    bool are_targets;
};

class QueryRun {
   public:
    QueryRun(const Targets& targets, const Seen& seen, const Queries& queries, const Answer& answer)
        : targets_(targets), seen_(seen), queries_(queries), answer_(answer) {}

    SearchRecord run(std::ptrdiff_t workers, Poller& poller) {
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

   private:
    std::int64_t steps(const CheckedCurve& P) const noexcept {
        return targets_.steps(P.curve.size(), seen_);
    }
    void take_queries(Poller& poller) noexcept {
        try {
            NeighborSearch search(targets_, seen_.size, poller);
            for (std::size_t i = next_++; i < queries_.curves.size() && !has_failed_; i = next_++) {
                const LoadedCurve loaded(queries_.curves[i], poller);
                const CheckedCurve& P = loaded.checked();
                const std::unique_ptr<TargetQuery> query = targets_.query(P, seen_, poller);
                answer_(search, *query, i, steps(P),
                        queries_.are_targets ? static_cast<std::ptrdiff_t>(i) : -1);
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

    const Targets& targets_;
    const Seen& seen_;
    const Queries& queries_;
    const Answer& answer_;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> has_failed_{false};
    std::mutex mutex_;
    std::exception_ptr failure_;
    SearchRecord record_;
};

// The threads that run calls; a thread is listed once for each of its calls.
class Callers {
   public:
    void add() {
        const std::lock_guard<std::mutex> lock(mutex_);
        threads_.push_back(std::this_thread::get_id());
    }
    void remove() noexcept {
        const std::lock_guard<std::mutex> lock(mutex_);
        threads_.erase(std::find(threads_.begin(), threads_.end(), std::this_thread::get_id()));
    }
    bool have_this_thread() const {
        const std::lock_guard<std::mutex> lock(mutex_);
        const auto end = threads_.end();
        return std::find(threads_.begin(), end, std::this_thread::get_id()) != end;
    }

   private:
    mutable std::mutex mutex_;
    std::vector<std::thread::id> threads_;
};

// As long as this is there, its thread is among the callers.
class Caller {
   public:
    explicit Caller(Callers& callers) : callers_(callers) { callers_.add(); }
    Caller(const Caller&) = delete;
    Caller(Caller&&) = delete;
    Caller& operator=(const Caller&) = delete;
    Caller& operator=(Caller&&) = delete;
    ~Caller() { callers_.remove(); }

   private:
    Callers& callers_;
};

// What a call sees of an index.
struct View {
    Seen seen;
    std::shared_ptr<const std::set<std::ptrdiff_t>> sizes =  // the numbers of points of the curves
        std::make_shared<const std::set<std::ptrdiff_t>>();
};

}  // namespace

class Index::State {
   public:
    explicit State(const Measure& measure)
        : measure_(std::visit([](const auto& options) { return pairwise::batch_measure(options); },
                              measure)),
          targets_(measure_->make_targets()) {}

    void add(const std::vector<CurveView>& curves, Control* control) {
        Poller poller(control);
        if (callers_.have_this_thread()) {
            throw std::logic_error(
                "add was called by the report of a call of the same index, which does not see the "
                "curves; add them after that call");
        }
        const Caller adding(callers_);
        check_like_first({curves, "curves"}, view());
        const std::unique_ptr<Targets> added = prepared(curves, poller);
        poller.finish();  // the last that may throw Stopped
        const std::lock_guard<std::mutex> lock(adding_);
        View next = view();
        check_like_first({curves, "curves"}, next);  // another may have added the first meanwhile
        next.sizes = with_sizes(next.sizes, curves);
        targets_->make_room(*added);
        targets_->take(*added);  // does not fail
        next.seen = targets_->seen();
        show(std::move(next));
    }

    std::size_t size() const { return static_cast<std::size_t>(view().seen.size); }

    std::vector<CurveView> curves() const {
        const std::ptrdiff_t size = view().seen.size;
        std::vector<CurveView> views;
        for (std::ptrdiff_t j = 0; j < size; ++j) views.push_back(targets_->curve(j).curve);
        return views;
    }

    // Of the curves of X, or, where that is null, of the index.
    void kneighbors(const std::vector<CurveView>* X, std::ptrdiff_t count, double* distances,
                    std::int64_t* indices, const SearchOptions& options, Control* control) const {
        const Caller asking(callers_);
        const View view = this->view();
        check_count(count, view.seen.size, X == nullptr);
        ask(X, view, options, control,
            [=](NeighborSearch& search, TargetQuery& query, std::size_t i, std::int64_t all_steps,
                std::ptrdiff_t left_out) {
                auto place = static_cast<std::ptrdiff_t>(i) * count;
                for (const Neighbor& found : search.nearest(query, all_steps, count, left_out)) {
                    distances[place] = found.distance;
                    indices[place++] = found.index;
                }
            });
    }

    std::vector<std::vector<Neighbor>> radius_neighbors(const std::vector<CurveView>* X,
                                                        double radius, const SearchOptions& options,
                                                        Control* control) const {
        const Caller asking(callers_);
        const View view = this->view();
        curves::check_limit("radius", radius, measure_->may_be_negative());
        std::vector<std::vector<Neighbor>> results(
            X == nullptr ? static_cast<std::size_t>(view.seen.size) : X->size());
        ask(X, view, options, control,
            [&](NeighborSearch& search, TargetQuery& query, std::size_t i, std::int64_t all_steps,
                std::ptrdiff_t left_out) {
                results[i] =
                    search.within(query, all_steps, radius,
                                  options.with_distances || options.sort_results, left_out);
                if (options.sort_results) {
                    std::sort(results[i].begin(), results[i].end(), nearest::is_nearer);
                }
            });
        return results;
    }

   private:
    using Sizes = std::shared_ptr<const std::set<std::ptrdiff_t>>;

    View view() const {
        const std::lock_guard<std::mutex> lock(showing_);
        return view_;
    }
    void show(View&& next) noexcept {
        const std::lock_guard<std::mutex> lock(showing_);
        std::swap(view_, next);
    }

    // The same, unless one of the curves has another number of points.
    static Sizes with_sizes(const Sizes& sizes, const std::vector<CurveView>& curves) {
        std::set<std::ptrdiff_t> others;
        for (const CurveView& curve : curves) {
            if (sizes->count(curve.size()) == 0) others.insert(curve.size());
        }
        if (others.empty()) return sizes;
        others.insert(sizes->begin(), sizes->end());
        return std::make_shared<const std::set<std::ptrdiff_t>>(std::move(others));
    }

    // Made ready without a lock, while others search.
    std::unique_ptr<Targets> prepared(const std::vector<CurveView>& curves, Poller& poller) const {
        std::unique_ptr<Targets> added = measure_->make_targets();
        std::int64_t total = 0;
        for (const CurveView& curve : curves) total += curve.size();
        poller.begin(total);
        added->reserve(curves);
        for (std::size_t i = 0; i < curves.size(); ++i) {
            const std::string name = CurveList(curves, "curves").name_of(i);
            const CurveInDoubles curve(curves[i], poller);
            added->add(checked_curve(curve.view(), name, poller), poller);
            if (poller.count_steps(curves[i].size())) throw Stopped();
        }
        return added;
    }

    void ask(const std::vector<CurveView>* X, const View& view, const SearchOptions& options,
             Control* control, const Answer& answer) const {
        Poller poller(control);
        const std::ptrdiff_t workers = runtime::resolve_workers(options.workers);
        const Queries queries = checked(X, view, poller);
        const SearchRecord record =
            QueryRun(*targets_, view.seen, queries, answer).run(workers, poller);
        if (options.record == nullptr) return;
        options.record->pairs += record.pairs;
        options.record->refined += record.refined;
        options.record->computed += record.computed;
    }

    Queries checked(const std::vector<CurveView>* X, const View& view, Poller& poller) const {
        Queries queries{{}, X == nullptr};
        if (X == nullptr) {
            for (std::ptrdiff_t j = 0; j < view.seen.size; ++j) {
                poller.poll_in_loop(static_cast<std::size_t>(j));
                queries.curves.push_back(targets_->curve(j));
                // It may have been added behind others.
                queries.curves.back().name = "curves[" + std::to_string(j) + "]";
            }
        } else {
            const CurveList list(*X, "X");
            check_like_first(list, view);
            for (std::size_t i = 0; i < X->size(); ++i) {
                queries.curves.push_back(checked_curve(list[i], list.name_of(i), poller));
            }
        }
        std::set<std::ptrdiff_t> sizes;
        for (const CheckedCurve& P : queries.curves) {
            sizes.insert(P.curve.size());
            targets_->check(LoadedCurve(P, poller).checked(), poller);
        }
        for (const std::ptrdiff_t n : sizes) {
            for (const std::ptrdiff_t m : *view.sizes) measure_->check_sizes(n, m);
        }
        return queries;
    }

    CheckedCurve checked_curve(const CurveView& curve, std::string name, Poller& poller) const {
        return curves::checked_listed(curve, std::move(name), poller,
                                      measure_->requirements().on_sphere);
    }

    // The shapes of a list, which must agree with those of the index.
    void check_like_first(const CurveList& list, const View& view) const {
        if (view.seen.size == 0) {
            check_shapes(measure_->requirements(), list);
        } else {
            const CurveView& first = targets_->curve(0).curve;
            check_shapes(measure_->requirements(), {first, "curve 0 of the index"}, list);
        }
    }

    static void check_count(std::ptrdiff_t count, std::ptrdiff_t size, bool leaves_itself_out) {
        const std::ptrdiff_t most = size - (leaves_itself_out ? 1 : 0);
        if (count >= 1 && count <= most) return;
        throw std::invalid_argument(
            "n_neighbors is " + std::to_string(count) + "; give a whole number from 1 to " +
            std::to_string(most) +
            (leaves_itself_out ? ", the other curves of the index" : ", the curves of the index"));
    }

    std::unique_ptr<const pairwise::BatchMeasure> measure_;
    std::unique_ptr<Targets> targets_;
    std::mutex adding_;           // has who makes the targets more
    mutable std::mutex showing_;  // has who reads or replaces the view, for a moment
    View view_;
    mutable Callers callers_;
};

Index::Index(const std::vector<CurveView>& curves, const Measure& measure, Control* control)
    : state_(std::make_unique<State>(measure)) {
    state_->add(curves, control);
}
Index::Index(Index&&) noexcept = default;
Index& Index::operator=(Index&&) noexcept = default;
Index::~Index() = default;

Index::State& Index::state() const {
    if (state_) return *state_;
    throw std::logic_error("the index has been moved from; make another, or assign one to it");
}

void Index::add(const std::vector<CurveView>& curves, Control* control) {
    state().add(curves, control);
}
std::size_t Index::size() const { return state_ ? state_->size() : 0; }
std::vector<CurveView> Index::curves() const {
    return state_ ? state_->curves() : std::vector<CurveView>();
}

void Index::kneighbors(const std::vector<CurveView>& X, std::ptrdiff_t n_neighbors,
                       double* distances, std::int64_t* indices, const SearchOptions& options,
                       Control* control) const {
    state().kneighbors(&X, n_neighbors, distances, indices, options, control);
}

void Index::kneighbors(std::ptrdiff_t n_neighbors, double* distances, std::int64_t* indices,
                       const SearchOptions& options, Control* control) const {
    state().kneighbors(nullptr, n_neighbors, distances, indices, options, control);
}

std::vector<std::vector<Neighbor>> Index::radius_neighbors(const std::vector<CurveView>& X,
                                                           double radius,
                                                           const SearchOptions& options,
                                                           Control* control) const {
    return state().radius_neighbors(&X, radius, options, control);
}

std::vector<std::vector<Neighbor>> Index::radius_neighbors(double radius,
                                                           const SearchOptions& options,
                                                           Control* control) const {
    return state().radius_neighbors(nullptr, radius, options, control);
}

}  // namespace curvewise
