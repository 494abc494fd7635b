// dtw and frechet: one measure class over the cumulative table, with their paths and tables.
//
// For Fréchet with the Euclidean distance the table holds squares and one sqrt is taken at the end:
// sqrt is monotone, so the value has the same bits. The path is decided on the squares, that is
// before the rounding of sqrt can make two of them equal. Time O(n m), memory O(n + m), except for
// the table.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "curves/range_scale.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "runtime/workers.hpp"
#include "warping/dispatch.hpp"
#include "warping/dtw_pruned.hpp"
#include "warping/frechet_corridor.hpp"
#include "warping/frechet_pruned.hpp"
#include "warping/ground_distance.hpp"
#include "warping/path.hpp"
#include "warping/sweep.hpp"

namespace curvewise {
namespace {

using detail::PackedCurve;
using detail::PackedPair;
using detail::Path;
using detail::PointOrder;
using detail::Poller;
using detail::RangeScale;
using detail::Row;
using detail::SweepMemory;
using detail::SweepProblem;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The options of either measure, as the sweep takes them, checked.
struct WarpingOptions {
    const char* measure;
    kernels::Recurrence recurrence;
    GroundDistance ground;
    std::ptrdiff_t workers;
    bool prune = false;
    double cutoff = infinity;
    std::optional<std::ptrdiff_t> window = std::nullopt;
    std::optional<double> window_fraction = std::nullopt;
    bool open_begin = false;
    bool open_end = false;
    bool normalize = false;

    std::optional<std::ptrdiff_t> window_for(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept {
        if (!window_fraction) return window;
        return static_cast<std::ptrdiff_t>(*window_fraction * static_cast<double>(std::max(n, m)));
    }
    // What a distance is divided by.
    double divisor(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept {
        return normalize ? static_cast<double>(n) + static_cast<double>(m) : 1.0;
    }
};

void check_window(const DtwOptions& options) {
    if (options.window && options.window_fraction) {
        throw std::invalid_argument("window and window_fraction are both given; give one of them");
    }
    if (options.window) detail::check_whole_number("window", *options.window, window_range);
    if (options.window_fraction &&
        !(*options.window_fraction > 0.0 && *options.window_fraction < 1.0)) {
        throw std::invalid_argument("window is " + std::to_string(*options.window_fraction) + "; " +
                                    window_range.advice);
    }
}

WarpingOptions checked(const DtwOptions& options) {
    detail::check_ground_distance(options.ground);
    detail::check_cutoff(options.cutoff);
    check_window(options);
    const bool is_symmetric1 = options.step_pattern == StepPattern::symmetric1;
    if (options.open_begin || options.open_end) {
        if (!is_symmetric1) {
            throw std::invalid_argument("open_begin and open_end need step_pattern='symmetric1'");
        }
        if (options.window || options.window_fraction) {
            throw std::invalid_argument("open_begin and open_end cannot be combined with window");
        }
    }
    if (options.normalize && is_symmetric1) {
        throw std::invalid_argument(
            "normalize needs step_pattern='symmetric2', whose paths all have the weight n + m");
    }
    return {
        DtwOptions::measure,
        is_symmetric1 ? kernels::Recurrence::dtw_symmetric1 : kernels::Recurrence::dtw_symmetric2,
        options.ground,
        detail::resolve_workers(options.workers),
        options.prune,
        options.cutoff,
        options.window,
        options.window_fraction,
        options.open_begin,
        options.open_end,
        options.normalize};
}

WarpingOptions checked(const FrechetOptions& options) {
    detail::check_ground_distance(options.ground);
    detail::check_cutoff(options.cutoff);
    return {FrechetOptions::measure, kernels::Recurrence::frechet,
            options.ground,          detail::resolve_workers(options.workers),
            options.prune,           options.cutoff};
}

// Two packed curves, and the table between them.
class WarpingProblem {
   public:
    WarpingProblem(const WarpingOptions& options, const PackedPair& curves, const RangeScale& range,
                   const detail::Call<SweepMemory>& call)
        : range_(range),
          degree_(detail::degree(options.ground.metric)),
          open_end_(options.open_end),
          prune_(options.prune),
          sweep_{*detail::active_level().kernels,
                 curves,
                 options.recurrence,
                 detail::canonical_cost(options.ground, curves),
                 options.ground.p,
                 detail::Band(curves.rows(), curves.columns(),
                              options.window_for(curves.rows(), curves.columns())),
                 options.open_begin,
                 call.workers,
                 call.poller,
                 call.memory} {
        squared_ = options.recurrence == kernels::Recurrence::frechet &&
                   sweep_.cost.metric == Metric::euclidean;
        if (squared_) sweep_.cost.metric = Metric::sqeuclidean;
    }

    // One above `cutoff` may come back as any other that is.
    double distance(double cutoff) {
        if (cutoff < infinity && range_.is_identity()) {
            if (!ends_are_within(cutoff)) {
                sweep_.poller.count_steps(sweep_.curves.rows() * sweep_.curves.columns());
                return infinity;
            }
            // A little above its square, so that the rounding of squares and roots gives nothing
            // up.
            sweep_.give_up_above = squared_ ? cutoff * cutoff * (1.0 + 1e-15) : cutoff;
        }
        if (const std::optional<double> value = pruned_value()) return restore(*value);
        const Row& bottom = last_row(sweep_);
        return restore(bottom[open_end_ ? bottom.argmin() : sweep_.curves.columns() - 1]);
    }

    // The distance, and how it was found.
    WarpingInfo info() {
        const Clock::time_point start = Clock::now();
        WarpingInfo info;
        std::optional<double> value;
        if (prune_) value = is_frechet() ? frechet_with_info(info) : dtw_with_info(info);
        info.pruned = value.has_value();
        if (!value) {
            for (std::ptrdiff_t i = 0; i < sweep_.curves.rows(); ++i) {
                const detail::ColumnRange columns = sweep_.columns.columns(i);
                info.cells_swept += columns.last - columns.first + 1;
            }
            const Clock::time_point before = Clock::now();
            const Row& bottom = last_row(sweep_);
            value = bottom[open_end_ ? bottom.argmin() : sweep_.curves.columns() - 1];
            info.phases.push_back({"full sweep", seconds_since(before)});
        }
        info.value = restore(*value);
        info.share =
            static_cast<double>(info.cells_swept) / (static_cast<double>(sweep_.curves.rows()) *
                                                     static_cast<double>(sweep_.curves.columns()));
        info.phases.push_back({"all", seconds_since(start)});
        return info;
    }

    Alignment alignment() const {
        sweep_.poller.begin(2 * sweep_.curves.rows() * sweep_.curves.columns());
        std::optional<Path> path = pruned_path();
        if (!path) path = find_path(sweep_, open_end_);
        return {restore(path->value), std::move(path->pairs)};
    }

    void write_table(double* out) const {
        sweep_table(sweep_, out);
        if (range_.is_identity() && !squared_) return;
        const std::ptrdiff_t n = sweep_.curves.rows(), m = sweep_.curves.columns();
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            for (std::ptrdiff_t j = 0; j < m; ++j) out[i * m + j] = restore(out[i * m + j]);
            if (sweep_.poller.poll()) throw Stopped();
        }
    }

   private:
    using Clock = std::chrono::steady_clock;
    static double seconds_since(Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }

    std::optional<double> frechet_with_info(WarpingInfo& info) const {
        detail::PruningRecord record;
        const std::int64_t steps = sweep_.curves.rows() * sweep_.curves.columns();
        const auto value = frechet_pruned(sweep_, {infinity, true, steps}, record);
        info.cells_swept = record.swept_cells;
        info.lower = restore(record.lower);
        info.upper = restore(record.upper);
        info.phases = {{"bounds", record.bound_seconds}, {"search", record.search_seconds}};
        return value;
    }

    std::optional<double> dtw_with_info(WarpingInfo& info) const {
        detail::DtwPruningRecord record;
        const auto value = dtw_pruned(sweep_, {infinity, open_end_}, record);
        info.cells_swept = record.swept_cells + record.corridor_cells;
        info.lower = restore(record.lower);
        info.upper = restore(record.upper);
        info.phases = {{"coarse path", record.path_seconds},
                       {"upper bound", record.upper_seconds},
                       {"lower bounds", record.lower_seconds},
                       {"sweep", record.sweep_seconds}};
        return value;
    }

    double restore(double value) const noexcept {
        return range_.restore(squared_ ? std::sqrt(value) : value, degree_);
    }

    bool is_frechet() const noexcept { return sweep_.recurrence == kernels::Recurrence::frechet; }

    // Nothing where pruning is off, or does not pay.
    std::optional<double> pruned_value() const {
        if (!prune_) return std::nullopt;
        if (is_frechet()) {
            detail::PruningRecord record;
            const std::int64_t steps = sweep_.curves.rows() * sweep_.curves.columns();
            return frechet_pruned(sweep_, {sweep_.give_up_above, true, steps}, record);
        }
        detail::DtwPruningRecord record;
        return dtw_pruned(sweep_, {sweep_.give_up_above, open_end_}, record);
    }

    std::optional<Path> pruned_path() const {
        if (!prune_) return std::nullopt;
        if (is_frechet()) return frechet_path_in_corridor();
        detail::DtwPruningRecord record;
        return dtw_path_pruned(sweep_, {infinity, open_end_}, record);
    }

    std::optional<Path> frechet_path_in_corridor() const {
        detail::PruningRecord record;
        const std::optional<double> value = frechet_pruned(sweep_, {}, record);
        if (!value) return std::nullopt;
        const detail::SweptColumns corridor = frechet_corridor(sweep_, *value);
        SweepProblem narrow = sweep_;
        const std::ptrdiff_t n = sweep_.curves.rows(), m = sweep_.curves.columns();
        narrow.columns = {detail::Band(n, m, std::nullopt), corridor};
        // Threads are worth their start by the cells that are left.
        narrow.cells_per_worker *= std::max<std::int64_t>(1, n * m / corridor.cells);
        return find_path(narrow, open_end_);
    }

    // Every path holds the first and the last cell, unless an end is open.
    bool ends_are_within(double cutoff) const {
        const std::ptrdiff_t n = sweep_.curves.rows(), m = sweep_.curves.columns();
        if (!sweep_.open_begin && restore(lone_cell(sweep_, 0, 0)) > cutoff) return false;
        return open_end_ || restore(lone_cell(sweep_, n - 1, m - 1)) <= cutoff;
    }

    RangeScale range_;
    int degree_;            // of homogeneity in the coordinates
    bool squared_ = false;  // the table holds squares of the values
    bool open_end_;
    bool prune_;
    SweepProblem sweep_;
};

class WarpingMeasure {
   public:
    using Memory = SweepMemory;
    static constexpr bool is_swept = true;
    // Packed without scaling, which curves within the usual range do not need.
    template <PointOrder order>
    struct Side {
        Side(const detail::CheckedCurve& curve, Poller& poller)
            : checked(curve), packed(curve.curve, RangeScale(1.0), order, poller) {}
        detail::CheckedCurve checked;
        PackedCurve packed;
    };
    using PreparedP = Side<PointOrder::forward>;
    using PreparedQ = Side<PointOrder::reversed>;

    // Of dtw, or of frechet.
    template <class Options>
    explicit WarpingMeasure(const Options& options) : options_(checked(options)) {}
    detail::Requirements requirements() const noexcept { return {options_.measure, 1, false}; }
    void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const {
        if (options_.window_for(n, m) == 0 && n != m && n > 1 && m > 1) {
            throw std::invalid_argument("window=0 admits no path between " + std::to_string(n) +
                                        " and " + std::to_string(m) + " points; use at least 1");
        }
    }
    static void check_p(const PreparedP& /*P*/, Poller& /*poller*/) noexcept {}
    std::ptrdiff_t workers() const noexcept { return options_.workers; }
    static std::int64_t steps(std::int64_t n, std::int64_t /*count*/,
                              std::int64_t points) noexcept {
        return n * points;
    }

    // Calls use(problem).
    template <class Use>
    auto with_problem(const PreparedP& P, const PreparedQ& Q, const detail::Call<Memory>& call,
                      Use use) const {
        const RangeScale range(std::max(P.checked.largest, Q.checked.largest));
        if (range.is_identity()) {
            WarpingProblem problem(options_, {P.packed, Q.packed}, range, call);
            return use(problem);
        }
        const PackedCurve p(P.checked.curve, range, PointOrder::forward, call.poller);
        const PackedCurve q(Q.checked.curve, range, PointOrder::reversed, call.poller);
        WarpingProblem problem(options_, {p, q}, range, call);
        return use(problem);
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const detail::Call<Memory>& call) const {
        const double divisor = options_.divisor(P.packed.size(), Q.packed.size());
        // A little more, so that the rounding of the quotient gives nothing up.
        const double more = divisor == 1.0 ? 1.0 : divisor * (1.0 + 1e-15);
        const double cutoff = std::min(call.cutoff, options_.cutoff) * more;
        const double value =
            with_problem(P, Q, call,
                         [&](WarpingProblem& problem) { return problem.distance(cutoff); }) /
            divisor;
        return value > options_.cutoff ? infinity : value;
    }

   private:
    WarpingOptions options_;
};

Alignment path(const WarpingMeasure& measure, const CurveView& P, const CurveView& Q,
               Control* control) {
    return detail::with_pair(
        measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
            return measure.with_problem(
                p, q, call, [](const WarpingProblem& problem) { return problem.alignment(); });
        });
}

WarpingInfo info(const WarpingMeasure& measure, const CurveView& P, const CurveView& Q,
                 Control* control) {
    return detail::with_pair(
        measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
            return measure.with_problem(p, q, call,
                                        [](WarpingProblem& problem) { return problem.info(); });
        });
}

void table(const WarpingMeasure& measure, const CurveView& P, const CurveView& Q, double* out,
           Control* control) {
    detail::with_pair(measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
        measure.with_problem(p, q, call,
                             [&](const WarpingProblem& problem) { problem.write_table(out); });
    });
}

}  // namespace

double dtw(const CurveView& P, const CurveView& Q, const DtwOptions& options, Control* control) {
    return detail::evaluate(WarpingMeasure(options), P, Q, control);
}

double frechet(const CurveView& P, const CurveView& Q, const FrechetOptions& options,
               Control* control) {
    return detail::evaluate(WarpingMeasure(options), P, Q, control);
}

Alignment dtw_path(const CurveView& P, const CurveView& Q, const DtwOptions& options,
                   Control* control) {
    return path(WarpingMeasure(options), P, Q, control);
}

Alignment frechet_path(const CurveView& P, const CurveView& Q, const FrechetOptions& options,
                       Control* control) {
    return path(WarpingMeasure(options), P, Q, control);
}

WarpingInfo dtw_info(const CurveView& P, const CurveView& Q, const DtwOptions& options,
                     Control* control) {
    return info(WarpingMeasure(options), P, Q, control);
}

WarpingInfo frechet_info(const CurveView& P, const CurveView& Q, const FrechetOptions& options,
                         Control* control) {
    return info(WarpingMeasure(options), P, Q, control);
}

void dtw_table(const CurveView& P, const CurveView& Q, double* out, const DtwOptions& options,
               Control* control) {
    table(WarpingMeasure(options), P, Q, out, control);
}

void frechet_table(const CurveView& P, const CurveView& Q, double* out,
                   const FrechetOptions& options, Control* control) {
    table(WarpingMeasure(options), P, Q, out, control);
}

std::unique_ptr<const detail::BatchMeasure> detail::batch_measure(const DtwOptions& options) {
    return std::make_unique<BatchOf<WarpingMeasure>>(WarpingMeasure(options));
}

std::unique_ptr<const detail::BatchMeasure> detail::batch_measure(const FrechetOptions& options) {
    return std::make_unique<BatchOf<WarpingMeasure>>(WarpingMeasure(options));
}

}  // namespace curvewise
