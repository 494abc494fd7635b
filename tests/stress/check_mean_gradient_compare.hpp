// Functions built on the measures. The mean of curves under dtw is compared round by round with its
// definition, and the gradients of dtw and frechet with the textbook's path. compare is compared
// with the measures that it names. Also decisions of the discrete Fréchet distance, and stopped
// calls, which either throw Stopped or return their usual result.
#pragma once

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "check_warping.hpp"
#include "curvewise/curvewise.hpp"
#include "hard_curves.hpp"
#include "record.hpp"
#include "textbook_warping.hpp"

namespace stress {

class MeanGradientCompareChecks {
   public:
    MeanGradientCompareChecks(Choices& choices, Record& record, Kind kind, std::ptrdiff_t dim)
        : choices_(choices), record_(record), kind_(kind), curves_(choices, kind, dim) {
        for (std::ptrdiff_t k = choices.between(2, 4); k > 0; --k) {
            const std::ptrdiff_t n = choices.between(1, 10);
            X_.push_back(X_.empty() ? curves_.curve(n) : curves_.other(X_.front(), n));
        }
        for (const Curve& curve : X_) with_.curves.emplace_back("X", &curve);
    }

    std::ptrdiff_t run() {
        if (is_tame(kind_)) {
            check_mean();
            check_compare();
        }
        check_gradient("dtw", any_dtw_options(choices_, 12));
        check_gradient("frechet", any_frechet_options(choices_));
        if (is_tame(kind_)) check_within();
        check_stopping();
        return static_cast<std::ptrdiff_t>(X_.size()) - 1;
    }

   private:
    // Petitjean's averaging, in the order of the curves.
    struct Averaged {
        double cost = 0.0;
        Curve moved;
    };
    Averaged averaged(const Curve& mean, const std::vector<double>& weights) const {
        textbook::Rules rules;
        rules.ground = {curvewise::Metric::sqeuclidean};
        Averaged result{0.0, mean};
        std::vector<double> sums(mean.values().size(), 0.0), shares(sums);
        for (std::size_t k = 0; k < X_.size(); ++k) {
            const double weight = weights.empty() ? 1.0 : weights[k];
            const textbook::Answer found = textbook::answer(mean, X_[k], rules);
            result.cost += weight * found.value;
            for (const auto& [i, j] : found.path) {
                for (std::ptrdiff_t c = 0; c < mean.dim(); ++c) {
                    const auto at = static_cast<std::size_t>(i * mean.dim() + c);
                    sums[at] += weight * X_[k](j, c);
                    shares[at] += weight;
                }
            }
        }
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= shares[k];
        result.moved = Curve(sums, mean.dim());
        return result;
    }

    void check_mean() {
        std::vector<double> weights;
        if (choices_.one_in(2)) weights.assign(X_.size(), 0.5);
        if (!weights.empty()) weights.back() = 1.5;
        curvewise::DtwMeanOptions options;
        options.iterations = choices_.between(0, 4);
        options.tolerance = 0.0;
        options.workers = any_workers(choices_);
        const std::vector<CurveView> views(X_.begin(), X_.end());
        const curvewise::DtwMean found = curvewise::dtw_mean(views, weights, X_.front(), options);
        Curve mean = X_.front();
        for (std::size_t k = 0; k < found.costs.size(); ++k) {
            const Averaged expected = averaged(mean, weights);
            record_.same("cost of the mean", found.costs[k], expected.cost, with_);
            if (k + 1 < found.costs.size()) mean = expected.moved;
        }
        for (std::size_t k = 0; k < found.points.size(); ++k) {
            record_.same("coordinate of the mean", found.points[k], mean.values()[k], with_);
        }
    }

    void check_compare() {
        const Curve &P = X_[0], &Q = X_[1];
        if (P.dim() == 2) return;  // area and its like refuse what dtw does not
        const auto preset = static_cast<curvewise::Preset>(choices_.index(3));
        const curvewise::Comparison found = curvewise::compare(P, Q, preset);
        std::vector<double> p(P.values().size()), q(Q.values().size());
        curvewise::normalize(P, P, p.data());
        curvewise::normalize(P, Q, q.data());
        for (const curvewise::Condition& condition : curvewise::conditions(preset)) {
            const bool scaled = condition.scaled;
            const Curve a = scaled ? Curve(p, P.dim()) : P, b = scaled ? Curve(q, Q.dim()) : Q;
            if (std::holds_alternative<DtwOptions>(condition.measure)) {
                record_.same("compare, dtw", found.dtw,
                             curvewise::evaluate(condition.measure, a, b), with_);
            } else if (std::holds_alternative<FrechetOptions>(condition.measure)) {
                record_.same("compare, frechet", found.frechet,
                             curvewise::evaluate(condition.measure, a, b), with_);
            }
        }
    }

    // The value; and, where a distance has a derivative, the sum of those along the path.
    template <class Options>
    void check_gradient(const char* measure, const Options& options) {
        const Curve &P = X_[0], &Q = X_[1];
        const textbook::Rules rules = rules_of(options, P.size(), Q.size());
        if (!has_path(rules, P.size(), Q.size())) return;
        std::vector<double> gradient(Q.values().size(), -1.0);
        const double value = curvewise::value_and_gradient(options, P, Q, gradient.data());
        const std::string name = std::string(measure) + " with its gradient";
        const Judge judge(record_, measure, options.ground);
        const textbook::Answer expected = textbook::answer(P, Q, rules);
        const double divided = divisor(options, P.size(), Q.size());
        judge.value("with its gradient", value, expected.value / divided, with_);
        for (const double slope : gradient) {
            record_.is_true(name + " has no nan", !std::isnan(slope), with_);
        }
        const bool is_squared = options.ground.metric == curvewise::Metric::sqeuclidean;
        if (!is_tame(kind_) || rules.largest || !is_squared) return;
        std::vector<double> slopes(gradient.size(), 0.0);
        for (std::size_t k = 0; k < expected.path.size(); ++k) {
            const auto [i, j] = expected.path[k];
            const bool diagonal =
                k > 0 && expected.path[k - 1][0] < i && expected.path[k - 1][1] < j;
            const double weight = diagonal ? rules.diagonal_weight : 1.0;
            for (std::ptrdiff_t c = 0; c < Q.dim(); ++c) {
                slopes[static_cast<std::size_t>(j * Q.dim() + c)] +=
                    2.0 * weight * (Q(j, c) - P(i, c)) / divided;
            }
        }
        for (std::size_t k = 0; k < slopes.size(); ++k) {
            record_.close("gradient of dtw, squared", gradient[k], slopes[k], 1e-12, with_);
        }
    }

    // The squares under the distance's root are rounded when they are added; the decision is about
    // the real number.
    void check_within() {
        constexpr double rounding = 0x1p-48;
        const Curve &P = X_[0], &Q = X_[1];
        textbook::Rules rules;
        rules.largest = true;
        const double value = textbook::value(P, Q, rules);
        if (value < 1e-150) return;  // Squares vanish.
        record_.is_true("frechet_within, discrete",
                        curvewise::frechet_within(P, Q, value * (1.0 + rounding), false), with_);
        record_.is_true("frechet_within less, discrete",
                        !curvewise::frechet_within(P, Q, value * (1.0 - rounding), false), with_);
    }

    void check_stopping() {
        std::ptrdiff_t left = choices_.between(0, 3);
        curvewise::Control control([&](std::int64_t, std::int64_t) { return left-- > 0; },
                                   std::chrono::milliseconds(0));
        const std::vector<CurveView> views(X_.begin(), X_.end());
        std::vector<double> expected(X_.size() * X_.size()), out(expected);
        const FrechetOptions options = any_frechet_options(choices_);
        curvewise::cdist(views, options, expected.data());
        try {
            curvewise::cdist(views, options, out.data(), {any_workers(choices_)}, &control);
        } catch (const curvewise::Stopped&) {
            record_.is_true("stopped when told to", left < 0, with_);
            return;
        }
        for (std::size_t k = 0; k < out.size(); ++k) {
            record_.same("cdist that might have been stopped", out[k], expected[k], with_);
        }
    }

    Choices& choices_;
    Record& record_;
    Kind kind_;
    HardCurves curves_;
    std::vector<Curve> X_;
    About with_;
};

inline std::ptrdiff_t check_mean_gradient_compare(Choices& choices, Record& record) {
    const Kind kind = any_kind(choices);
    return MeanGradientCompareChecks(choices, record, kind, any_dimension(choices)).run();
}

}  // namespace stress
