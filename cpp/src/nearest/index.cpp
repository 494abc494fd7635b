// Index: the curves, prepared by their measure, which keeps their points.
//
// A call sees the curves that were there when it began. It neither waits for add() or remove() nor
// keeps them waiting: add() writes behind the curves that others see, remove() only marks curves,
// and both then show another view to the calls that begin later.
#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "curves/checks.hpp"
#include "curves/owned_curve.hpp"
#include "curvewise/nearest.hpp"
#include "nearest/callers.hpp"
#include "nearest/index_checks.hpp"
#include "nearest/index_file.hpp"
#include "nearest/index_view.hpp"
#include "nearest/query_run.hpp"
#include "pairwise/batch.hpp"
#include "runtime/scratch.hpp"
#include "runtime/workers.hpp"

namespace curvewise {
namespace {

using curves::CheckedCurve;
using curves::CurveInDoubles;
using curves::CurveList;
using nearest::Caller;
using nearest::Callers;
using nearest::IndexView;
using nearest::OpenedIndex;
using nearest::Queries;
using nearest::QueryRun;
using nearest::SizeCounts;
using nearest::TargetIndices;
using pairwise::PointSource;
using pairwise::Seen;
using pairwise::Targets;
using runtime::Poller;

constexpr WholeNumberRange exclusion_range{0, "give a whole number >= 0"};

}  // namespace

class Index::State {
   public:
    // The indices of curves to be added first, and of those behind them.
    State(TargetIndices indices, const Measure& measure)
        : indices_(std::move(indices)),
          measure_(std::visit([](const auto& options) { return pairwise::batch_measure(options); },
                              measure)),
          targets_(measure_->make_targets()) {}

    // Curves of the caller's, or of a file that was opened.
    void add(const std::vector<CurveView>& curves, const OpenedIndex* opened, Control* control) {
        Poller poller(control);
        refuse_reports("add", "does not see the curves; add them after that call");
        const Caller adding(callers_);
        checks().check_like_first({curves, "curves"}, view());
        const std::unique_ptr<Targets> added = prepared(curves, opened, poller);
        SizeCounts::Counts more;
        for (const CurveView& curve : curves) ++more[curve.size()];
        poller.finish();  // the last that may throw Stopped
        const std::lock_guard<std::mutex> lock(changing_);
        IndexView next = view();
        checks().check_like_first({curves, "curves"}, next);  // another may have added the first
        next.sizes = counts_.with(more, std::move(next.sizes));
        const Seen seen = added->seen();
        next.seen.size += seen.size;
        next.seen.remaining += seen.size;
        next.seen.points += seen.points;
        targets_->make_room(*added);
        targets_->take(*added);  // from here on nothing fails
        next.seen.forest = targets_->seen().forest;
        counts_.add(more);
        show(std::move(next));
    }

    void remove(const std::vector<std::int64_t>& indices) {
        refuse_reports("remove", "still sees the curves; remove them after that call");
        SizeCounts::Counts fewer;
        const std::lock_guard<std::mutex> lock(changing_);
        IndexView next = without(view(), indices, indices_, *targets_, fewer);
        next.sizes = counts_.without(fewer, std::move(next.sizes));
        counts_.remove(fewer);
        show(std::move(next));
    }

    void save(const std::string& path, const std::string& note, Control* control) const {
        Poller poller(control);
        const Caller saving(callers_);
        const IndexView view = this->view();
        const std::vector<std::ptrdiff_t> targets = view.targets();
        poller.begin(view.seen.points);
        nearest::save_index(
            path, {*targets_, targets, indices_of(targets), indices_[view.seen.size], note},
            poller);
    }

    std::size_t size() const { return static_cast<std::size_t>(view().seen.remaining); }
    std::int64_t next_index() const { return indices_[view().seen.size]; }

    std::vector<CurveView> curves() const {
        std::vector<CurveView> views;
        for (const std::ptrdiff_t j : view().targets()) views.push_back(targets_->curve(j).curve);
        return views;
    }
    std::vector<std::int64_t> indices() const { return indices_of(view().targets()); }

    // Of the curves of X, or, where that is null, of the index. Calls begin(the number of rows),
    // then write(row, neighbors) in any thread.
    template <class Begin, class Write>
    void kneighbors(const std::vector<CurveView>* X, std::ptrdiff_t count,
                    const SearchOptions& options, Control* control, Begin begin,
                    Write write) const {
        const Caller asking(callers_);
        const IndexView view = this->view();
        nearest::check_count(count, view.seen.remaining, X == nullptr);
        begin(X == nullptr ? static_cast<std::size_t>(view.seen.remaining) : X->size());
        nearest::Question question;
        question.count = count;
        const auto write_found = [&](std::size_t i, runtime::ScratchVector<Neighbor>& found) {
            give_indices(found);
            found.resize(static_cast<std::size_t>(count),
                         {-1, std::numeric_limits<double>::infinity()});
            write(i, found);
        };
        ask(X, view, question, options, control, std::ref(write_found));
    }

    std::vector<std::vector<Neighbor>> radius_neighbors(const std::vector<CurveView>* X,
                                                        double radius, const SearchOptions& options,
                                                        Control* control) const {
        const Caller asking(callers_);
        const IndexView view = this->view();
        curves::check_limit("radius", radius, measure_->may_be_negative());
        std::vector<std::vector<Neighbor>> results(
            X == nullptr ? static_cast<std::size_t>(view.seen.remaining) : X->size());
        nearest::Question question;
        question.radius = radius;
        question.with_distances = options.with_distances || options.sort_results;
        const auto write = [&](std::size_t i, runtime::ScratchVector<Neighbor>& found) {
            if (options.sort_results) std::sort(found.begin(), found.end(), nearest::is_nearer);
            give_indices(found);
            results[i].assign(found.begin(), found.end());
        };
        ask(X, view, question, options, control, std::ref(write));
        return results;
    }

   private:
    IndexView view() const {
        const std::lock_guard<std::mutex> lock(showing_);
        return view_;
    }
    void show(IndexView&& next) noexcept {
        const std::lock_guard<std::mutex> lock(showing_);
        std::swap(view_, next);
    }

    std::vector<std::int64_t> indices_of(const std::vector<std::ptrdiff_t>& targets) const {
        std::vector<std::int64_t> indices;
        indices.reserve(targets.size());
        for (const std::ptrdiff_t j : targets) indices.push_back(indices_[j]);
        return indices;
    }
    // Replaces the number of each target.
    void give_indices(runtime::ScratchVector<Neighbor>& targets) const noexcept {
        for (Neighbor& found : targets) found.index = indices_[found.index];
    }

    void refuse_reports(const std::string& call, const std::string& why) const {
        if (!callers_.have_this_thread()) return;
        throw std::logic_error(call + " was called by the report of a call of the same index, " +
                               "which " + why);
    }

    // Made ready without a lock, while others search.
    std::unique_ptr<Targets> prepared(const std::vector<CurveView>& curves,
                                      const OpenedIndex* opened, Poller& poller) const {
        std::unique_ptr<Targets> added = measure_->make_targets();
        std::int64_t total = 0;
        for (const CurveView& curve : curves) total += curve.size();
        poller.begin(total);
        const bool are_here = opened != nullptr && opened->layout == added->layout();
        std::vector<const double*> bounds(curves.size());
        if (opened != nullptr) {
            opened->check_points(poller);
            bounds = opened->bounds_for(*added);
        }
        if (are_here) added->hold(opened->file);
        const bool have_bounds = !bounds.empty() && bounds[0] != nullptr;
        added->reserve(curves, !are_here     ? PointSource::others
                               : have_bounds ? PointSource::held_with_bounds
                                             : PointSource::held);
        for (std::size_t i = 0; i < curves.size(); ++i) {
            const std::string name = CurveList(curves, "curves").name_of(i);
            const CurveInDoubles curve(curves[i], poller);
            if (are_here && !measure_->requirements().on_sphere) {
                // It was checked before it was written.
                CheckedCurve checked(curves[i], opened->stored[i].largest, false);
                checked.name = name;
                added->look_at(checked, opened->stored[i], bounds[i], poller);
            } else if (are_here) {
                added->look_at(checks().curve(curves[i], name, poller), opened->stored[i], nullptr,
                               poller);
            } else {
                added->add(checks().curve(curve.view(), name, poller), poller);
            }
            if (poller.count_steps(curves[i].size())) throw Stopped();
        }
        added->plant(poller);
        return added;
    }

    void ask(const std::vector<CurveView>* X, const IndexView& view,
             const nearest::Question& question, const SearchOptions& options, Control* control,
             const nearest::Write& write) const {
        Poller poller(control);
        const std::ptrdiff_t workers = runtime::resolve_workers(options.workers);
        curves::check_whole_number("exclusion", options.exclusion, exclusion_range);
        Queries queries = checks().queries(X, view, poller);
        queries.exclusion = options.exclusion;
        const SearchRecord record =
            QueryRun(*targets_, view, queries, question, write).run(workers, poller);
        if (options.rows != nullptr && X == nullptr) {
            *options.rows = indices_of(queries.targets);
        }
        if (options.record == nullptr) return;
        options.record->pairs += record.pairs;
        options.record->refined += record.refined;
        options.record->computed += record.computed;
    }

    nearest::IndexChecks checks() const noexcept { return {*measure_, *targets_, indices_}; }

    TargetIndices indices_;
    std::unique_ptr<const pairwise::BatchMeasure> measure_;
    std::unique_ptr<Targets> targets_;
    std::mutex changing_;         // has who makes the targets more, or removes some
    mutable std::mutex showing_;  // has who reads or replaces the view, for a moment
    IndexView view_;
    SizeCounts counts_;
    mutable Callers callers_;
};

Index::Index(const std::vector<CurveView>& curves, const Measure& measure, Control* control)
    : state_(std::make_unique<State>(TargetIndices(), measure)) {
    state_->add(curves, nullptr, control);
}
Index::Index(const std::vector<CurveView>& curves, std::vector<std::int64_t> indices,
             std::int64_t next_index, const Measure& measure, Control* control) {
    if (indices.size() != curves.size()) {
        throw std::invalid_argument("there are " + std::to_string(indices.size()) +
                                    " indices for " + std::to_string(curves.size()) +
                                    " curves; give one for each");
    }
    state_ = std::make_unique<State>(TargetIndices(std::move(indices), next_index), measure);
    state_->add(curves, nullptr, control);
}
Index::Index(Index&&) noexcept = default;
Index& Index::operator=(Index&&) noexcept = default;
Index::~Index() = default;

Index::Index(TakenState, std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}

IndexFile::IndexFile(const std::string& path)
    : opened_(std::make_shared<const OpenedIndex>(path)) {}
const std::string& IndexFile::note() const noexcept { return opened_->note; }

Index Index::open(const IndexFile& file, const Measure& measure, Control* control) {
    const OpenedIndex& opened = *file.opened_;
    auto state = std::make_unique<State>(TargetIndices(opened.indices, opened.next_index), measure);
    state->add(opened.curves, &opened, control);
    return {TakenState(), std::move(state)};
}
Index Index::open(const std::string& path, const Measure& measure, Control* control) {
    return open(IndexFile(path), measure, control);
}
void Index::save(const std::string& path, const std::string& note, Control* control) const {
    state().save(path, note, control);
}

Index::State& Index::state() const {
    if (state_) return *state_;
    throw std::logic_error("the index has been moved from; make another, or assign one to it");
}

void Index::add(const std::vector<CurveView>& curves, Control* control) {
    state().add(curves, nullptr, control);
}
std::size_t Index::size() const { return state_ ? state_->size() : 0; }
std::vector<CurveView> Index::curves() const {
    return state_ ? state_->curves() : std::vector<CurveView>();
}

void Index::remove(const std::vector<std::int64_t>& indices) { state().remove(indices); }
std::vector<std::int64_t> Index::indices() const {
    return state_ ? state_->indices() : std::vector<std::int64_t>();
}
std::int64_t Index::next_index() const { return state_ ? state_->next_index() : 0; }

namespace {

// Writes rows of `count` neighbors.
auto writer(std::ptrdiff_t count, double* distances, std::int64_t* indices) {
    return [=](std::size_t row, const runtime::ScratchVector<Neighbor>& neighbors) {
        std::ptrdiff_t place = static_cast<std::ptrdiff_t>(row) * count;
        for (const Neighbor& found : neighbors) {
            distances[place] = found.distance;
            indices[place++] = found.index;
        }
    };
}

}  // namespace

void Index::kneighbors(const std::vector<CurveView>& X, std::ptrdiff_t n_neighbors,
                       double* distances, std::int64_t* indices, const SearchOptions& options,
                       Control* control) const {
    state().kneighbors(
        &X, n_neighbors, options, control, [](std::size_t) {},
        writer(n_neighbors, distances, indices));
}

void Index::kneighbors(std::ptrdiff_t n_neighbors, double* distances, std::int64_t* indices,
                       const SearchOptions& options, Control* control) const {
    state().kneighbors(
        nullptr, n_neighbors, options, control, [](std::size_t) {},
        writer(n_neighbors, distances, indices));
}

std::vector<Neighbor> Index::kneighbors(std::ptrdiff_t n_neighbors, const SearchOptions& options,
                                        Control* control) const {
    std::vector<Neighbor> all;
    state().kneighbors(
        nullptr, n_neighbors, options, control,
        [&](std::size_t rows) { all.resize(rows * static_cast<std::size_t>(n_neighbors)); },
        [&](std::size_t row, const runtime::ScratchVector<Neighbor>& neighbors) {
            std::copy(neighbors.begin(), neighbors.end(),
                      all.begin() + static_cast<std::ptrdiff_t>(row) * n_neighbors);
        });
    return all;
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
