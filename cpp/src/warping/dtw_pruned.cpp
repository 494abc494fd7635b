#include "warping/dtw_pruned.hpp"

#include <algorithm>

#include "curves/range_scale.hpp"
#include "runtime/scratch.hpp"
#include "runtime/stopwatch.hpp"
#include "warping/cost_sums.hpp"
#include "warping/least_distances.hpp"
#include "warping/sweep.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// With fewer cells, it would take more than about 3 % of the full sweep's time to find that curves
// are not similar.
constexpr std::ptrdiff_t fewest_cells = 1'200'000;

// The table's cells for each that is swept, roughly: threads are worth their start by these.
constexpr std::ptrdiff_t expected_pruning = 16;

// If a larger share of a coarse table is active, the full sweep of the fine one is expected to be
// as fast.
constexpr double most_live_share = 0.6;

// Work before the work that the caller counts.
class Uncounted {
   public:
    explicit Uncounted(Poller& poller) noexcept
        : poller_(poller), was_counting_(poller.set_counting(false)) {}
    Uncounted(const Uncounted&) = delete;
    Uncounted(Uncounted&&) = delete;
    Uncounted& operator=(const Uncounted&) = delete;
    Uncounted& operator=(Uncounted&&) = delete;
    ~Uncounted() { poller_.set_counting(was_counting_); }

   private:
    Poller& poller_;
    bool was_counting_;
};

std::int64_t cells(const SweepProblem& problem) noexcept {
    return problem.curves.rows() * problem.curves.columns();
}

double last_value(const SweepProblem& problem, bool open_end) {
    const Row& row = last_row(problem);
    return row[open_end ? row.argmin() : problem.curves.columns() - 1];
}

// What the rows and columns to come cost at least, with an open end the rows alone.
CostSums cost_bounds(const SweepProblem& problem, bool open_end) {
    CostSums sums;
    sums.assign(problem.curves.rows(), problem.curves.columns(),
                problem.rule == kernels::Rule::dtw_symmetric2);
    const BoxTree P(problem.curves.p, PointOrder::forward);
    const BoxTree Q(problem.curves.q, PointOrder::reversed);
    const Metric metric = metric_of_boxes(problem.cost.metric);
    const auto least = [&](const BoxTree& from, const BoxTree& to, double* bounds) {
        least_distances(from, to, metric, problem.poller, bounds);
        if (metric == problem.cost.metric) return;
        problem.kernels.arcs(bounds, from.size(), problem.metric_parameter);
    };
    least(P, Q, sums.rows());
    if (!open_end) least(Q, P, sums.columns());
    sums.add_up();
    return sums;
}

// Both curves with `decimation` times fewer points, their ends among them, and their table.
class CoarseProblem {
   public:
    CoarseProblem(const SweepProblem& fine, std::ptrdiff_t decimation)
        : p_points_(decimated(fine.curves.p, PointOrder::forward, decimation)),
          q_points_(decimated(fine.curves.q, PointOrder::reversed, decimation)),
          p_(view(p_points_, fine), RangeScale(1.0), PointOrder::forward, fine.poller),
          q_(view(q_points_, fine), RangeScale(1.0), PointOrder::reversed, fine.poller),
          problem_{fine.kernels,  {p_, q_}, fine.rule, fine.cost,   fine.metric_parameter,
                   columns(fine), false,    1,         fine.poller, fine.memory} {}

    SweepProblem& problem() noexcept { return problem_; }

    // The point that is left of each run of them.
    static std::ptrdiff_t fine_index(std::ptrdiff_t coarse, std::ptrdiff_t coarse_size,
                                     std::ptrdiff_t fine_size) noexcept {
        return coarse_size > 1 ? coarse * (fine_size - 1) / (coarse_size - 1) : 0;
    }

   private:
    static runtime::ScratchVector<double> decimated(const PackedCurve& curve, PointOrder order,
                                                    std::ptrdiff_t decimation) {
        const PointAccess points(curve, order);
        const std::ptrdiff_t size =
            std::min(curve.size(), std::max<std::ptrdiff_t>(2, curve.size() / decimation));
        runtime::ScratchVector<double> values;
        values.reserve(static_cast<std::size_t>(size * curve.dim()));
        for (std::ptrdiff_t k = 0; k < size; ++k) {
            const std::ptrdiff_t point = fine_index(k, size, curve.size());
            for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) values.push_back(points(point, c));
        }
        return values;
    }

    static CurveView view(const runtime::ScratchVector<double>& values,
                          const SweepProblem& fine) noexcept {
        const std::ptrdiff_t dim = fine.curves.dim();
        return {values.data(), static_cast<std::ptrdiff_t>(values.size()) / dim, dim};
    }

    // The band, where there is one, a column wider on either side.
    LiveColumns columns(const SweepProblem& fine) {
        const std::ptrdiff_t rows = p_.size(), columns = q_.size();
        const Band all(rows, columns, std::nullopt);
        if (!fine.columns.is_limited()) return all;
        const std::ptrdiff_t last = columns - 1, fine_last = fine.curves.columns() - 1;
        band_.rows.reserve(static_cast<std::size_t>(rows));
        for (std::ptrdiff_t i = 0; i < rows; ++i) {
            const ColumnRange range = fine.columns.columns(fine_index(i, rows, fine.curves.rows()));
            const auto scaled = [&](std::ptrdiff_t j) {
                return fine_last > 0 ? j * last / fine_last : 0;
            };
            band_.rows.push_back({std::max<std::ptrdiff_t>(scaled(range.first) - 1, 0),
                                  std::min(scaled(range.last) + 2, last)});
        }
        return {all, band_};
    }

    runtime::ScratchVector<double> p_points_;
    runtime::ScratchVector<double> q_points_;
    PackedCurve p_;
    PackedCurve q_;
    SweptColumns band_;
    SweepProblem problem_;
};

// The columns within `reach` of a path of the coarse table, as far as `fine` holds them. Empty
// where that leaves a row without columns.
runtime::ScratchVector<ColumnRange> corridor_around(const IndexPairs& path,
                                                    const SweepProblem& coarse,
                                                    const SweepProblem& fine,
                                                    std::ptrdiff_t reach) {
    const std::ptrdiff_t n = fine.curves.rows(), m = fine.curves.columns();
    runtime::ScratchVector<ColumnRange> corridor(static_cast<std::size_t>(n), {m, -1});
    const auto include = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
        ColumnRange& range = corridor[static_cast<std::size_t>(i)];
        range.first = std::min(range.first, j);
        range.last = std::max(range.last, j);
    };
    std::ptrdiff_t row = 0, column = 0;
    for (const auto& [p, q] : path) {
        const std::ptrdiff_t i = CoarseProblem::fine_index(p, coarse.curves.rows(), n);
        const std::ptrdiff_t j = CoarseProblem::fine_index(q, coarse.curves.columns(), m);
        for (std::ptrdiff_t between = row; between < i; ++between) {
            include(between, column + (j - column) * (between - row) / (i - row));
        }
        include(i, j);
        row = i;
        column = j;
    }
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const ColumnRange allowed = fine.columns.columns(i);
        ColumnRange& range = corridor[static_cast<std::size_t>(i)];
        range.first = std::max(range.first - reach, allowed.first);
        range.last = std::min(range.last + reach, allowed.last);
        if (range.first > range.last) return {};
    }
    return corridor;
}

class DtwSearch {
   public:
    DtwSearch(const SweepProblem& problem, const DtwPruningOptions& options,
              DtwPruningRecord& record)
        : problem_(problem), options_(options), record_(record) {
        problem_.give_up_above = infinity;  // the narrowed sweep knows better
    }

    std::optional<double> value() {
        if (!find_upper_bound()) return std::nullopt;
        const double most = std::min(record_.upper, options_.cutoff);
        const CostSums bounds = cost_bounds(problem_, options_.open_end);
        const CostToGo cost_to_go = bounds.cost_to_go(most);
        record_.lower = bounds.all();
        record_.lower_seconds = stopwatch_.lap();
        if (record_.lower * cost_to_go.slack > options_.cutoff) {
            problem_.poller.count_steps(cells(problem_));
            return infinity;
        }
        const double value = narrowed_value(problem_, cost_to_go);
        record_.swept_cells = swept_.cells;
        record_.sweep_seconds = stopwatch_.lap();
        return value > options_.cutoff ? infinity : value;
    }

    // The path, after the value, within the columns that were swept for the value.
    Path path() const {
        SweepProblem within = problem_;
        within.columns = LiveColumns(problem_.columns, swept_);
        // Threads are worth their start by the cells that are left.
        const std::int64_t swept = std::max<std::int64_t>(swept_.cells, 1);
        within.cells_per_worker *= std::max<std::int64_t>(cells(problem_) / swept, 1);
        return find_path(within, options_.open_end);
    }

   private:
    double narrowed_value(const SweepProblem& problem, const CostToGo& cost_to_go) {
        SweepProblem narrowed = problem;
        swept_ = SweptColumns();
        narrowed.columns = LiveColumns(problem.columns, cost_to_go, swept_);
        narrowed.cells_per_worker *= expected_pruning;
        return last_value(narrowed, options_.open_end);
    }

    // False where the full sweep is expected to be as fast.
    bool find_upper_bound() {
        const Uncounted uncounted(problem_.poller);
        CoarseProblem coarse(problem_, options_.decimation);
        const IndexPairs path = coarse_path(coarse.problem());
        record_.path_seconds = stopwatch_.lap();
        const bool has_cutoff = options_.cutoff < infinity;
        if (options_.gives_up && !is_alike() && !has_cutoff) return false;
        record_.upper = value_around(path, coarse.problem());
        record_.upper_seconds = stopwatch_.lap();
        if (!options_.gives_up || options_.cutoff < record_.upper) return true;
        return is_alike() && record_.upper < infinity;
    }

    // Judged by the coarse table. More than two threads are of use to the full sweep alone, whose
    // strips are longer.
    bool is_alike() const noexcept {
        const std::ptrdiff_t useful = cells(problem_) / problem_.cells_per_worker;
        const std::ptrdiff_t threads =
            std::clamp<std::ptrdiff_t>(useful, 2, std::max<std::ptrdiff_t>(problem_.workers, 2));
        return coarse_share_ * static_cast<double>(threads) / 2.0 <= most_live_share;
    }

    // The best path of a coarse problem, by this same search if it is long. If that search gives
    // up, its coarse curves may have been too coarse. A full sweep of them is short compared with
    // the fine one.
    IndexPairs coarse_path(const SweepProblem& coarse) {
        if (cells(coarse) > options_.most_coarse_cells) {
            DtwPruningOptions options = options_;
            options.cutoff = infinity;
            DtwPruningRecord record;
            DtwSearch search(coarse, options, record);
            if (search.value()) {
                coarse_share_ = share(record.swept_cells, coarse);
                return search.path().pairs;
            }
        }
        Path path = find_path(coarse, options_.open_end);
        if (options_.gives_up) {
            const CostSums bounds = cost_bounds(coarse, options_.open_end);
            narrowed_value(coarse, bounds.cost_to_go(path.value));
            coarse_share_ = share(swept_.cells, coarse);
        }
        return std::move(path.pairs);
    }

    static double share(std::int64_t swept, const SweepProblem& problem) noexcept {
        return static_cast<double>(swept) / static_cast<double>(cells(problem));
    }

    // The value of the best path near that of the coarse problem; infinity if there is no such
    // path.
    double value_around(const IndexPairs& path, const SweepProblem& coarse) {
        SweptColumns corridor;
        corridor.rows = corridor_around(path, coarse, problem_, corridor_reach());
        if (corridor.rows.empty()) return infinity;
        for (const ColumnRange& range : corridor.rows) {
            record_.corridor_cells += range.last - range.first + 1;
        }
        SweepProblem within = problem_;
        within.columns = LiveColumns(problem_.columns, corridor);
        within.workers = 1;
        const Row& row = last_row(within);
        if (!options_.open_end) return row[problem_.curves.columns() - 1];
        const ColumnRange last = corridor.rows.back();
        return *std::min_element(row.data() + last.first, row.data() + last.last + 1);
    }

    // Wide enough for the best path between two points of the coarse one, and wider where the
    // corridor is a smaller part of the table.
    std::ptrdiff_t corridor_reach() const noexcept {
        return options_.decimation / 2 + problem_.curves.columns() / 4096;
    }

    SweepProblem problem_;
    const DtwPruningOptions& options_;
    DtwPruningRecord& record_;
    runtime::Stopwatch stopwatch_;
    SweptColumns swept_;
    double coarse_share_ = 1.0;  // active share of the coarse table
};

bool has_bounds(const SweepProblem& problem) noexcept {
    return has_box_bounds(problem.cost.metric) && !problem.open_begin;
}

bool is_worth_trying(const SweepProblem& problem, const DtwPruningOptions& options) noexcept {
    return has_bounds(problem) && (!options.gives_up || cells(problem) >= fewest_cells);
}

}  // namespace

std::optional<double> dtw_pruned(const SweepProblem& problem, const DtwPruningOptions& options,
                                 DtwPruningRecord& record) {
    if (!is_worth_trying(problem, options)) return std::nullopt;
    return DtwSearch(problem, options, record).value();
}

std::optional<Path> dtw_path_pruned(const SweepProblem& problem, const DtwPruningOptions& options,
                                    DtwPruningRecord& record) {
    if (!is_worth_trying(problem, options)) return std::nullopt;
    DtwSearch search(problem, options, record);
    const std::optional<double> value = search.value();
    if (!value || *value > options.cutoff) return std::nullopt;
    return search.path();
}

}  // namespace curvewise::warping
