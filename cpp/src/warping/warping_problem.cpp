#include "warping/warping_problem.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "curves/checks.hpp"
#include "runtime/stopwatch.hpp"
#include "runtime/workers.hpp"
#include "warping/box_tree.hpp"
#include "warping/cheap_cells.hpp"
#include "warping/dispatch.hpp"
#include "warping/dtw_pruned.hpp"
#include "warping/dtw_recurrence.hpp"
#include "warping/frechet_corridor.hpp"
#include "warping/frechet_pruned.hpp"
#include "warping/ground_distance.hpp"
#include "warping/sweep.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Only one thread calls a custom function.
std::ptrdiff_t workers_for(const GroundDistance& ground, std::ptrdiff_t asked_for) {
    const std::ptrdiff_t workers = runtime::resolve_workers(asked_for);
    return ground.own == nullptr ? workers : 1;
}

}  // namespace

WarpingOptions checked_options(const DtwOptions& options) {
    const bool is_open = options.open_begin || options.open_end;
    if (is_open && options.step_pattern == StepPattern::symmetric2) {
        throw std::invalid_argument("open_begin and open_end need step_pattern='symmetric1'");
    }
    if (!is_swept_by_dtw(options)) {
        throw std::invalid_argument(
            "this needs step_pattern='symmetric1' or 'symmetric2', no penalty and no relax");
    }
    check_ground_distance(options.ground);
    curves::check_limit("cutoff", options.cutoff, false);
    const Window window{options.window, options.window_fraction};
    window.check();
    const bool is_symmetric1 = options.step_pattern == StepPattern::symmetric1;
    if (is_open && (options.window || options.window_fraction)) {
        throw std::invalid_argument("open_begin and open_end cannot be combined with window");
    }
    if (options.normalize && is_symmetric1) {
        throw std::invalid_argument(
            "normalize needs step_pattern='symmetric2', whose paths all have the weight n + m");
    }
    return {DtwOptions::measure,
            is_symmetric1 ? kernels::Rule::dtw_symmetric1 : kernels::Rule::dtw_symmetric2,
            options.ground,
            workers_for(options.ground, options.workers),
            options.prune && options.ground.own == nullptr,
            options.cutoff,
            window,
            options.open_begin,
            options.open_end,
            options.normalize};
}

WarpingOptions checked_options(const FrechetOptions& options) {
    check_ground_distance(options.ground);
    curves::check_limit("cutoff", options.cutoff, false);
    return {FrechetOptions::measure,
            kernels::Rule::frechet,
            options.ground,
            workers_for(options.ground, options.workers),
            options.prune && options.ground.own == nullptr,
            options.cutoff};
}

WarpingProblem::WarpingProblem(const WarpingOptions& options, const PackedPair& curves,
                               const RangeScale& range, const pairwise::Call<SweepMemory>& call)
    : range_(range),
      degree_(degree(options.ground.metric)),
      prune_(options.prune),
      sweep_{*active_level().kernels,
             curves,
             options.rule,
             canonical_cost(options.ground, curves),
             options.ground.parameter(),
             Band(curves.rows(), curves.columns(),
                  options.window.between(curves.rows(), curves.columns())),
             options.open_begin,
             call.workers,
             call.poller,
             call.memory} {
    sweep_.open_end = options.open_end;
    sweep_.own = options.ground.own;
    if (is_frechet() && sweep_.own == nullptr) root_ = put_off_root(sweep_.cost, options.ground);
}

double WarpingProblem::distance(double cutoff, bool looks_at_ends) {
    if (cutoff < infinity && range_.is_identity()) {
        sweep_.give_up_above = most_in_table(cutoff);
        if (looks_at_ends && cost_of_ends() > sweep_.give_up_above) {
            sweep_.poller.count_steps(sweep_.curves.rows() * sweep_.curves.columns());
            return infinity;
        }
    }
    if (const std::optional<double> value = pruned_value()) return restore(*value);
    return restore(last_value(sweep_));
}

double WarpingProblem::narrowed_distance(const CostToGo& cost_to_go) {
    SweptColumns swept;
    SweepProblem narrowed = sweep_;
    narrowed.columns = LiveColumns(sweep_.columns, cost_to_go, swept);
    return restore(last_value(narrowed));
}

double WarpingProblem::last_value(const SweepProblem& problem) const {
    const Row& bottom = last_row(problem);
    return bottom[sweep_.open_end ? bottom.argmin() : problem.curves.columns() - 1];
}

WarpingInfo WarpingProblem::info() {
    runtime::Stopwatch all;
    WarpingInfo info;
    std::optional<double> value;
    if (prune_) value = is_frechet() ? frechet_with_info(info) : dtw_with_info(info);
    info.pruned = value.has_value();
    if (!value) {
        for (std::ptrdiff_t i = 0; i < sweep_.curves.rows(); ++i) {
            const ColumnRange columns = sweep_.columns.columns(i);
            info.cells_swept += columns.last - columns.first + 1;
        }
        runtime::Stopwatch sweep;
        value = last_value(sweep_);
        info.phases.push_back({"full sweep", sweep.lap()});
    }
    info.value = restore(*value);
    info.share =
        static_cast<double>(info.cells_swept) /
        (static_cast<double>(sweep_.curves.rows()) * static_cast<double>(sweep_.curves.columns()));
    info.phases.push_back({"all", all.lap()});
    return info;
}

Alignment WarpingProblem::alignment() const {
    std::optional<Path> path = pruned_path();
    if (!path) path = find_path(sweep_, sweep_.open_end);
    return {restore(path->value), {path->pairs.begin(), path->pairs.end()}};
}

void WarpingProblem::write_table(double* out) const {
    sweep_table(sweep_, out);
    if (range_.is_identity() && !root_) return;
    const std::ptrdiff_t n = sweep_.curves.rows(), m = sweep_.curves.columns();
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        double* const row = out + i * m;
        root_.take(row, m);
        for (std::ptrdiff_t j = 0; j < m && !range_.is_identity(); ++j) {
            row[j] = range_.restore(row[j], degree_);
        }
        if (sweep_.poller.poll()) throw Stopped();
    }
}

std::optional<double> WarpingProblem::frechet_with_info(WarpingInfo& info) const {
    PruningRecord record;
    const std::int64_t steps = sweep_.curves.rows() * sweep_.curves.columns();
    const auto value = frechet_pruned(sweep_, {infinity, true, steps}, record);
    info.cells_swept = record.swept_cells;
    info.lower = restore(record.lower);
    info.upper = restore(record.upper);
    info.phases = {{"bounds", record.bound_seconds}, {"search", record.search_seconds}};
    return value;
}

std::optional<double> WarpingProblem::dtw_with_info(WarpingInfo& info) const {
    DtwPruningRecord record;
    const auto value = dtw_pruned(sweep_, {infinity, sweep_.open_end}, record);
    info.cells_swept = record.swept_cells + record.corridor_cells;
    info.lower = restore(record.lower);
    info.upper = restore(record.upper);
    info.phases = {{"coarse path", record.path_seconds},
                   {"upper bound", record.upper_seconds},
                   {"lower bounds", record.lower_seconds},
                   {"sweep", record.sweep_seconds}};
    return value;
}

// Nothing where pruning is off, or does not pay.
std::optional<double> WarpingProblem::pruned_value() const {
    if (!prune_) return std::nullopt;
    if (is_frechet()) {
        PruningRecord record;
        const std::int64_t steps = sweep_.curves.rows() * sweep_.curves.columns();
        return frechet_pruned(sweep_, {sweep_.give_up_above, true, steps}, record);
    }
    DtwPruningRecord record;
    return dtw_pruned(sweep_, {sweep_.give_up_above, sweep_.open_end}, record);
}

std::optional<Path> WarpingProblem::pruned_path() const {
    if (!prune_) return std::nullopt;
    if (is_frechet()) return frechet_path_in_corridor();
    DtwPruningRecord record;
    std::optional<Path> path = dtw_path_pruned(sweep_, {infinity, sweep_.open_end}, record);
    if (!path) path = find_path_of_cheap_cells(sweep_, sweep_.open_end);
    return path;
}

std::optional<Path> WarpingProblem::frechet_path_in_corridor() const {
    PruningRecord record;
    const std::optional<double> value = frechet_pruned(sweep_, {}, record);
    if (!value) return std::nullopt;
    const SweptColumns corridor = frechet_corridor(sweep_, *value);
    SweepProblem narrow = sweep_;
    const std::ptrdiff_t n = sweep_.curves.rows(), m = sweep_.curves.columns();
    narrow.columns = {Band(n, m, std::nullopt), corridor};
    // Threads are worth their start by the cells that are left.
    narrow.cells_per_worker *= std::max<std::int64_t>(1, n * m / corridor.cells);
    return find_path(narrow, sweep_.open_end);
}

// Every path holds the first and the last cell, unless an end is open. Sums in the table's order
// need no slack.
double WarpingProblem::cost_of_ends() const {
    const std::ptrdiff_t n = sweep_.curves.rows(), m = sweep_.curves.columns();
    const double first = sweep_.open_begin ? 0.0 : cell(0, 0);
    const double last = sweep_.open_end ? 0.0 : cell(n - 1, m - 1);
    return is_frechet() || (n == 1 && m == 1) ? std::max(first, last) : first + last;
}

// The ground distance, in the unit of the table.
double WarpingProblem::cell(std::ptrdiff_t i, std::ptrdiff_t j) const {
    if (sweep_.own != nullptr || !has_box_bounds(sweep_.cost.metric)) {
        return lone_cell(sweep_, i, j);
    }
    const PointAccess P(sweep_.curves.p, PointOrder::forward);
    const PointAccess Q(sweep_.curves.q, PointOrder::reversed);
    return with_norm(sweep_.cost.metric, [&](auto norm) {
        return point_distance<decltype(norm)>(P, i, Q, j, sweep_.curves.dim());
    });
}

}  // namespace curvewise::warping
