// For Fréchet with the Euclidean distance the table holds squares and one sqrt is taken at the end:
// sqrt is monotone, so the value has the same bits. The path is decided on the squares, that is
// before the rounding of sqrt can make two of them equal.
#include "table_measure.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "dispatch.hpp"
#include "pair_measures.hpp"
#include "path.hpp"
#include "workers.hpp"

namespace curvewise::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check_dtw(const DtwOptions& options) {
    check_ground_distance(options.ground);
    if (options.window && *options.window < 0) {
        throw std::invalid_argument("window is " + std::to_string(*options.window) +
                                    "; give a whole number >= 0, or None");
    }
    if (!options.open_begin && !options.open_end) return;
    if (options.step_pattern != StepPattern::symmetric1) {
        throw std::invalid_argument("open_begin and open_end need step_pattern='symmetric1'");
    }
    if (options.window) {
        throw std::invalid_argument("open_begin and open_end cannot be combined with window");
    }
}

}  // namespace

TableOptions::TableOptions(const DtwOptions& options)
    : needs{"dtw", 1, false},
      recurrence(options.step_pattern == StepPattern::symmetric1
                     ? kernels::Recurrence::dtw_symmetric1
                     : kernels::Recurrence::dtw_symmetric2),
      ground((check_dtw(options), options.ground)),
      window(options.window),
      open_begin(options.open_begin),
      open_end(options.open_end),
      workers(resolve_workers(options.workers)) {}

TableOptions::TableOptions(const FrechetOptions& options)
    : needs{"frechet", 1, false},
      recurrence(kernels::Recurrence::frechet),
      ground((check_ground_distance(options.ground), options.ground)),
      workers(resolve_workers(options.workers)) {}

void TableOptions::check_window(std::ptrdiff_t n, std::ptrdiff_t m) const {
    if (window && *window == 0 && n != m && n > 1 && m > 1) {
        throw std::invalid_argument("window=0 admits no path between " + std::to_string(n) +
                                    " and " + std::to_string(m) + " points; use at least 1");
    }
}

TableProblem::TableProblem(const TableOptions& options, const PackedPair& curves,
                           const RangeScale& range, Watch& watch, SweepMemory& memory)
    : range_(range),
      degree_(options.ground.metric == Metric::sqeuclidean ? 2 : 1),
      open_end_(options.open_end),
      sweep_{*active_level().kernels,
             curves,
             options.recurrence,
             canonical_cost(options.ground, curves),
             options.ground.p,
             Band(curves.rows(), curves.columns(), options.window),
             options.open_begin,
             options.workers,
             watch,
             memory} {
    if (options.recurrence != kernels::Recurrence::frechet) return;
    squared_ = sweep_.cost == kernels::Cost::euclidean ||
               sweep_.cost == kernels::Cost::euclidean_in_domain;
    if (squared_) sweep_.cost = kernels::Cost::sqeuclidean;
}

double TableProblem::restore(double value) const noexcept {
    return range_.restore(squared_ ? std::sqrt(value) : value, degree_);
}

double TableProblem::distance(double cutoff) {
    if (cutoff < infinity && range_.is_identity()) {
        if (!ends_are_within(cutoff)) {
            sweep_.watch.step(sweep_.curves.rows() * sweep_.curves.columns());
            return infinity;
        }
        // A little above its square, so that the rounding of squares and roots gives nothing up.
        sweep_.give_up_above = squared_ ? cutoff * cutoff * (1.0 + 1e-15) : cutoff;
    }
    const Row& bottom = last_row(sweep_);
    return restore(bottom[open_end_ ? bottom.argmin() : sweep_.curves.columns() - 1]);
}

// Every path holds the first and the last cell, unless an end is open.
bool TableProblem::ends_are_within(double cutoff) const {
    const std::ptrdiff_t n = sweep_.curves.rows(), m = sweep_.curves.columns();
    if (!sweep_.open_begin && restore(lone_cell(sweep_, 0, 0)) > cutoff) return false;
    return open_end_ || restore(lone_cell(sweep_, n - 1, m - 1)) <= cutoff;
}

Alignment TableProblem::alignment() const {
    sweep_.watch.begin(2 * sweep_.curves.rows() * sweep_.curves.columns());
    Path path = find_path(sweep_, open_end_);
    return {restore(path.value), std::move(path.pairs)};
}

void TableProblem::write_table(double* out) const {
    sweep_table(sweep_, out);
    if (range_.is_identity() && !squared_) return;
    const std::ptrdiff_t n = sweep_.curves.rows(), m = sweep_.curves.columns();
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t j = 0; j < m; ++j) out[i * m + j] = restore(out[i * m + j]);
        if (sweep_.watch.poll()) throw Stopped();
    }
}

TableMeasure::Reference::Reference(const CheckedCurve& P)
    : checked(P), packed(P.curve, RangeScale(1.0), PointOrder::forward) {}

TableMeasure::Other::Other(const CheckedCurve& Q)
    : checked(Q), packed(Q.curve, RangeScale(1.0), PointOrder::reversed) {}

double TableMeasure::operator()(const Reference& P, const Other& Q, const PairCall& call) const {
    const RangeScale range(std::max(P.checked.largest, Q.checked.largest));
    TableOptions options = options_;
    options.workers = call.workers;
    if (range.is_identity()) {
        return TableProblem(options, {P.packed, Q.packed}, range, call.watch, call.memory)
            .distance(call.cutoff);
    }
    const PackedCurve p(P.checked.curve, range, PointOrder::forward);
    const PackedCurve q(Q.checked.curve, range, PointOrder::reversed);
    return TableProblem(options, {p, q}, range, call.watch, call.memory).distance(call.cutoff);
}

}  // namespace curvewise::detail
