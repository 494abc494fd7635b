#include "warping/frechet_pruned.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/stopwatch.hpp"
#include "warping/block_recursion.hpp"
#include "warping/block_values.hpp"
#include "warping/coarse_table.hpp"
#include "warping/nearest_point_bound.hpp"
#include "warping/reach.hpp"
#include "warping/sweep.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The time of a cell in a swept block, relative to a cell of the full sweep.
constexpr double reach_cost = 0.45;
constexpr double value_cost = 2.5;

constexpr double block_cost = 64.0;  // of a tested block, in addition

// Shares of the full sweep's time. The first two may be lost if the full sweep is needed after all:
// in any case, and if success is likely. The third limits a search that succeeds.
constexpr double small_share = 0.02;
constexpr double risked_share = 0.25;
constexpr double worthwhile_share = 0.8;
constexpr double hopeless_share = 1.2;

// One point of every `step`, in the order in which the curve is stored.
PackedCurve decimated(const PackedCurve& curve, std::ptrdiff_t step, Poller& poller) {
    const CurveView points(curve.data(), (curve.size() + step - 1) / step, curve.dim(), step,
                           curve.stride());
    return {points, RangeScale(1.0), PointOrder::forward, poller};
}

// The distance of decimated curves: close to the distance of the curves, above or below it.
double decimated_distance(const SweepProblem& problem, std::ptrdiff_t step) {
    const PackedCurve p = decimated(problem.curves.p, step, problem.poller);
    const PackedCurve q = decimated(problem.curves.q, step, problem.poller);
    Poller poller(nullptr);
    SweepMemory memory;
    const SweepProblem small{problem.kernels,
                             {p, q},
                             problem.rule,
                             problem.cost,
                             problem.metric_parameter,
                             Band(p.size(), q.size(), std::nullopt),
                             false,
                             1,
                             poller,
                             memory};
    return last_row(small)[q.size() - 1];
}

template <class Norm>
class FrechetSearch {
   public:
    FrechetSearch(const SweepProblem& problem, const PruningOptions& options, PruningRecord& record)
        : problem_(problem),
          kernels_(problem.kernels),
          curves_(problem.curves),
          metric_(problem.cost.metric),
          poller_(problem.poller),
          options_(options),
          record_(record),
          cells_(static_cast<double>(curves_.rows()) * static_cast<double>(curves_.columns())),
          P_(curves_.p, PointOrder::forward),
          Q_(curves_.q, PointOrder::reversed),
          coarse_(P_, Q_, metric_, most_boxes()) {}

    std::optional<double> value() {
        const bool is_promising = find_bounds();
        record_.bound_seconds += stopwatch_.lap();
        std::optional<double> found;
        if (record_.lower > options_.cutoff) {
            found = infinity;
        } else if (is_promising) {
            found = search();
        }
        if (!found) poller_.take_back(counted_steps_);
        if (found) poller_.count_steps(options_.steps - counted_steps_, 0);
        record_.search_seconds += stopwatch_.lap();
        return found;
    }

   private:
    double& lower() noexcept { return record_.lower; }
    double& upper() noexcept { return record_.upper; }

    // Blocks of `block_side`, which show exactly what a recursion will sweep, or larger ones.
    std::ptrdiff_t most_boxes() const noexcept {
        constexpr std::ptrdiff_t most = 1 << 14;
        return std::min(runs_of(P_.size()) * runs_of(Q_.size()), most);
    }

    double reach_share(double threshold) const {
        return reach_cost * coarse_.undecided_share(threshold, threshold);
    }
    double value_share(double from, double to) const {
        return value_cost * coarse_.undecided_share(from, to);
    }

    // Whether to go on.
    bool find_bounds() {
        const std::ptrdiff_t dim = P_.dim();
        lower() = std::max(coarse_.lower(),
                           std::max(point_distance<Norm>(P_.points(), 0, Q_.points(), 0, dim),
                                    point_distance<Norm>(P_.points(), P_.size() - 1, Q_.points(),
                                                         Q_.size() - 1, dim)));
        upper() = coarse_.upper();
        // As on noise, whose boxes all lie over each other: no lower bound will help.
        if (options_.gives_up && value_share(lower(), lower()) > hopeless_share) return false;
        lower() = nearest_point_bound(P_, Q_, metric_, lower(), cells_ * small_share / 2, poller_);
        return true;
    }

    // Whether the last cell is reached over ground distances of at most `threshold`.
    bool is_within(double threshold) {
        const PointArray p{curves_.p.data(), curves_.p.stride(), 1};
        const PointArray q{curves_.q.data() + Q_.size() - 1, curves_.q.stride(), -1};
        ReachFront front(p, P_.size(), q, Q_.size(), P_.dim(), threshold,
                         kernels_.reach(metric_, P_.dim()));
        run(front, threshold, threshold, true);
        ++record_.reach_passes;
        return front.is_reached();
    }

    // The last cell, which must be above `lower` or at it, and at most `upper`.
    double value_between(double lower, double upper) {
        ValueFront front(curves_, upper, kernels_.values(metric_, P_.dim()));
        run(front, lower, upper, lower);
        ++record_.value_passes;
        return front.last_cell();
    }

    template <class Front>
    void run(Front& front, double lower, double upper, typename Front::Value corner) {
        // Half of the remaining steps, because this pass may not be the last.
        const std::int64_t steps = (options_.steps - counted_steps_) / 2;
        counted_steps_ += steps;
        BlockRecursion<Norm, Front> recursion(P_, Q_, lower, upper, front, poller_, steps);
        recursion.run(corner);
        record_.blocks += recursion.counts().blocks;
        record_.swept_cells += recursion.counts().swept_cells;
    }

    // Where to look first: at the lower bound, unless curves of every few points say that the
    // distance is well above it.
    double first_threshold(double estimate) const {
        const double error = std::max(longest_run(P_), longest_run(Q_));
        const double lower = record_.lower * first_factor;
        if (in_length(estimate) - error <= in_length(lower)) return record_.lower;
        return std::min(estimate * first_factor, record_.upper);
    }

    // One of this number of points is taken. The estimate is then a small part of the work.
    std::ptrdiff_t decimation() const noexcept {
        constexpr double most_cells = 1 << 16;
        std::ptrdiff_t step = 16;
        while (cells_ / static_cast<double>(step * step) > most_cells) step *= 2;
        return step;
    }

    // The largest extent of the runs that lie between two points of the decimated curves.
    double longest_run(const BoxTree& tree) const noexcept {
        std::ptrdiff_t level = 0;
        while (BoxTree::leaf_points << level < decimation() && level + 1 < tree.levels()) ++level;
        double longest = 0.0;
        for (std::ptrdiff_t b = 0; b < tree.boxes(level); ++b) {
            const double* const box = tree.box(level, b);
            longest = std::max(longest, largest_distance<Norm>(box, box, tree.dim()));
        }
        return in_length(longest);
    }

    static double in_length(double value) noexcept {
        return Norm::degree == 2 ? std::sqrt(value) : value;
    }

    // Raises the lower bound until the distance is found.
    std::optional<double> search() {
        double factor = first_factor;
        const double estimate = decimated_distance(problem_, decimation());
        double threshold = std::min(first_threshold(estimate), options_.cutoff);
        while (lower() < upper()) {
            if (!is_worth_trying(threshold)) return std::nullopt;
            if (is_within(threshold)) {
                upper() = threshold;
                break;
            }
            if (threshold >= options_.cutoff) return infinity;
            lower() = threshold;
            threshold = lower() > 0.0 ? lower() * factor : upper() * smallest_step;
            // If passes are expensive, a second one that fails would be too many.
            if (spent() > small_share) threshold = std::max(threshold, estimate);
            threshold = std::min(std::min(threshold, upper()), options_.cutoff);
            factor *= factor * factor;
        }
        if (lower() < upper()) {
            if (options_.gives_up && value_share(lower(), upper()) > 1.0) return std::nullopt;
            lower() = upper() = value_between(lower(), upper());
        }
        return lower() > options_.cutoff ? infinity : lower();
    }

    // What the search has taken, as a share of the full sweep.
    double spent() const noexcept {
        return (reach_cost * static_cast<double>(record_.swept_cells) +
                block_cost * static_cast<double>(record_.blocks)) /
               cells_;
    }

    // Whether to find out if the distance is at most `threshold`, and to go on from there.
    bool is_worth_trying(double threshold) const {
        if (!options_.gives_up) return true;
        const double share = reach_share(threshold);
        if (spent() + share <= small_share) return true;
        const double upper = std::max(threshold, record_.lower * first_factor);
        return spent() + share <= risked_share &&
               share + value_share(record_.lower, upper) <= worthwhile_share;
    }

    // Steps of the bound, in squares for the Euclidean distance.
    static constexpr double first_factor = 1.04;
    static constexpr double smallest_step = 0x1p-20;

    const SweepProblem& problem_;
    const kernels::KernelSet& kernels_;
    PackedPair curves_;
    Metric metric_;
    Poller& poller_;
    const PruningOptions& options_;
    PruningRecord& record_;
    runtime::Stopwatch stopwatch_;
    std::int64_t counted_steps_ = 0;
    double cells_;
    BoxTree P_;
    BoxTree Q_;
    CoarseTable coarse_;
};

}  // namespace

std::optional<double> frechet_pruned(const SweepProblem& problem, const PruningOptions& options,
                                     PruningRecord& record) {
    // Below, trees and bounds take longer than they save.
    constexpr std::ptrdiff_t fewest_cells = 3 << 18;
    const PackedPair& curves = problem.curves;
    const Metric metric = problem.cost.metric;
    if (problem.kernels.reach(metric, curves.dim()) == nullptr) return std::nullopt;
    if (options.gives_up && curves.rows() * curves.columns() < fewest_cells) return std::nullopt;
    return with_norm(metric, [&](auto norm) {
        return FrechetSearch<decltype(norm)>(problem, options, record).value();
    });
}

}  // namespace curvewise::warping
