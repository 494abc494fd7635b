// The mean of curves under dtw (see curvewise/dtw_mean.hpp). Threads find the paths of some curves,
// which are then added to the mean in the order of the curves, so that the number of threads
// changes no bit.
#include "curvewise/dtw_mean.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "curves/checks.hpp"
#include "runtime/workers.hpp"
#include "warping/warping_problem.hpp"

namespace curvewise {
namespace {

using curves::CheckedCurve;
using curves::RangeScale;
using runtime::Poller;
using warping::PackedCurve;
using warping::PointOrder;
using warping::WarpingOptions;

constexpr WholeNumberRange iterations_range{0, "give a whole number >= 0"};

// Paths that are found before they are added up, for each thread.
constexpr std::size_t paths_per_worker = 4;

void check_weights(const std::vector<double>& weights, std::size_t count) {
    if (weights.empty()) return;
    if (weights.size() != count) {
        throw std::invalid_argument("weights has " + std::to_string(weights.size()) +
                                    " entries for " + std::to_string(count) +
                                    " curves; give one for each");
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        sum += weights[i];
        if (weights[i] >= 0.0 && std::isfinite(weights[i])) continue;
        throw std::invalid_argument("weights[" + std::to_string(i) + "] is " +
                                    std::to_string(weights[i]) + "; give a finite number >= 0");
    }
    if (sum <= 0.0) throw std::invalid_argument("all weights are 0; give one that is not");
}

// The mean, and what its curves make of it.
class Averaging {
   public:
    Averaging(const std::vector<CheckedCurve>& curves, const std::vector<double>& weights,
              const CurveView& initial, const WarpingOptions& options)
        : curves_(curves),
          weights_(weights),
          options_(options),
          n_(initial.size()),
          dim_(initial.dim()) {
        for (std::ptrdiff_t i = 0; i < n_; ++i) {
            for (std::ptrdiff_t c = 0; c < dim_; ++c) mean_.push_back(initial(i, c));
        }
    }

    // The cost of the present mean. Where each of its points belongs is known from then on.
    double evaluate(Poller& poller) {
        sums_.assign(mean_.size(), 0.0);
        shares_.assign(static_cast<std::size_t>(n_), 0.0);
        const std::size_t together = paths_per_worker * static_cast<std::size_t>(options_.workers);
        double cost = 0.0;
        for (std::size_t first = 0; first < curves_.size(); first += together) {
            const std::size_t count = std::min(together, curves_.size() - first);
            find_paths(first, count, poller);
            for (std::size_t k = 0; k < count; ++k) {
                cost += weight(first + k) * alignments_[k].distance;
                add(first + k, alignments_[k]);
            }
        }
        return cost;
    }

    void move() {
        for (std::size_t k = 0; k < mean_.size(); ++k) {
            mean_[k] = sums_[k] / shares_[k / static_cast<std::size_t>(dim_)];
        }
    }

    const std::vector<double>& mean() const noexcept { return mean_; }

   private:
    double weight(std::size_t i) const noexcept { return weights_.empty() ? 1.0 : weights_[i]; }

    void find_paths(std::size_t first, std::size_t count, Poller& poller) {
        alignments_.resize(count);
        const CheckedCurve mean(CurveView(mean_.data(), n_, dim_), "the mean", poller);
        runtime::for_each(count, options_.workers, poller, [&](Poller& own) {
            return [&, memory = warping::SweepMemory()](std::size_t k) mutable {
                alignments_[k] = path(mean, curves_[first + k], own, memory);
            };
        });
    }

    Alignment path(const CheckedCurve& mean, const CheckedCurve& curve, Poller& poller,
                   warping::SweepMemory& memory) const {
        const RangeScale range(std::max(mean.largest, curve.largest));
        const PackedCurve p(mean.curve, range, PointOrder::forward, poller);
        const PackedCurve q(curve.curve, range, PointOrder::reversed, poller);
        const std::int64_t steps = n_ * curve.curve.size();
        poller.set_counting(false);
        Alignment found =
            warping::WarpingProblem(options_, {p, q}, range, {0.0, 1, poller, memory}).alignment();
        poller.set_counting(true);
        if (poller.count_steps(steps)) throw Stopped();
        return found;
    }

    void add(std::size_t i, const Alignment& alignment) {
        const CurveView& curve = curves_[i].curve;
        for (const auto& [row, column] : alignment.path) {
            shares_[static_cast<std::size_t>(row)] += weight(i);
            for (std::ptrdiff_t c = 0; c < dim_; ++c) {
                sums_[static_cast<std::size_t>(row * dim_ + c)] += weight(i) * curve(column, c);
            }
        }
    }

    const std::vector<CheckedCurve>& curves_;
    const std::vector<double>& weights_;
    const WarpingOptions& options_;
    std::ptrdiff_t n_;
    std::ptrdiff_t dim_;
    std::vector<double> mean_;
    std::vector<double> sums_;    // of the points that are matched to each of the mean's
    std::vector<double> shares_;  // and of their weights
    std::vector<Alignment> alignments_;
};

WarpingOptions checked_options(const DtwMeanOptions& options) {
    curves::check_whole_number("iterations", options.iterations, iterations_range);
    if (!(options.tolerance >= 0.0)) {
        throw std::invalid_argument("tolerance is " + std::to_string(options.tolerance) +
                                    "; give a number >= 0");
    }
    DtwOptions measure;
    measure.ground.metric = Metric::sqeuclidean;
    measure.window = options.window;
    measure.window_fraction = options.window_fraction;
    measure.workers = options.workers;
    return warping::checked_options(measure);
}

}  // namespace

DtwMean dtw_mean(const std::vector<CurveView>& curves, const std::vector<double>& weights,
                 const CurveView& initial, const DtwMeanOptions& options, Control* control) {
    const WarpingOptions measure = checked_options(options);
    if (curves.empty()) throw std::invalid_argument("no curves; a mean needs at least 1");
    const curves::CurveList list(curves, "curves");
    check_shapes({measure.measure, 1, false}, {initial, "initial"}, list);
    check_weights(weights, curves.size());
    Poller poller(control);
    const CheckedCurve checked_initial(initial, "initial", poller);
    std::vector<CheckedCurve> checked;
    std::int64_t steps = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        checked.emplace_back(curves[i], list.name_of(i), poller);
        measure.window.check_sizes(initial.size(), curves[i].size());
        steps += initial.size() * curves[i].size();
    }
    poller.begin((options.iterations + 1) * steps);
    Averaging averaging(checked, weights, initial, measure);
    DtwMean result;
    result.costs.push_back(averaging.evaluate(poller));
    result.points = averaging.mean();
    for (std::ptrdiff_t round = 0; round < options.iterations && !result.converged; ++round) {
        averaging.move();
        const double before = result.costs.back(), cost = averaging.evaluate(poller);
        result.converged = !(before - cost > options.tolerance * before);
        if (cost > before) break;  // by rounding
        result.costs.push_back(cost);
        result.points = averaging.mean();
    }
    poller.finish();
    return result;
}

}  // namespace curvewise
