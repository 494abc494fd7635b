// Gradients by both curves: against central differences of the measure, in every direction at once.
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/gradient.hpp"
#include "curvewise/measure.hpp"
#include "curvewise/pointwise.hpp"

namespace {

using curvewise::value_and_gradient;
using test::Curve;
using test::Random;

constexpr double step = 1e-5;

// Q moved by `h` times a direction, and the product of a gradient with that direction.
Curve moved(const Curve& Q, const Curve& direction, double h) {
    Curve result = Q;
    for (std::ptrdiff_t i = 0; i < Q.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < Q.dim(); ++c) result(i, c) += h * direction(i, c);
    }
    return result;
}

double product(const std::vector<double>& gradient, const Curve& direction) {
    double sum = 0.0;
    for (std::size_t k = 0; k < gradient.size(); ++k) sum += gradient[k] * direction.values()[k];
    return sum;
}

template <class Options>
void check_slope(const Options& options, const Curve& P, const Curve& Q, const Curve& direction) {
    const check::Note note(Options::measure);
    std::vector<double> by_p(P.values().size(), 1e300), by_q(Q.values().size(), 1e300);
    const double value = value_and_gradients(options, P, Q, {by_p.data(), by_q.data()});
    CHECK_CLOSE(value, evaluate(options, P, Q), 1e-14);
    const double by_moving_q = evaluate(options, P, moved(Q, direction, step)) -
                               evaluate(options, P, moved(Q, direction, -step));
    CHECK_CLOSE(product(by_q, direction), by_moving_q / (2.0 * step), 1e-5);
    const double by_moving_p = evaluate(options, moved(P, direction, step), Q) -
                               evaluate(options, moved(P, direction, -step), Q);
    CHECK_CLOSE(product(by_p, direction), by_moving_p / (2.0 * step), 1e-5);

    std::vector<double> alone(Q.values().size(), 1e300);
    CHECK_EQUAL(value_and_gradient(options, P, Q, alone.data()), value);
    CHECK_EQUAL(alone, by_q);
}

curvewise::SoftDtwOptions soft(double gamma, std::optional<std::ptrdiff_t> window = std::nullopt) {
    curvewise::SoftDtwOptions options;
    options.gamma = gamma;
    options.window = window;
    return options;
}

void slopes() {
    Random random(17);
    const Curve P = random.curve(12, 2), Q = random.curve(9, 2), direction = random.curve(12, 2);
    for (const auto spacing :
         {curvewise::Spacing::distance, curvewise::Spacing::x, curvewise::Spacing::matched}) {
        for (const bool squared : {false, true}) {
            check_slope(curvewise::AreaOptions{spacing, curvewise::Crossing::split, squared}, P, Q,
                        direction);
        }
    }
    check_slope(curvewise::DtwOptions{}, P, Q, direction);
    curvewise::DtwOptions per_step;
    per_step.step_pattern = curvewise::StepPattern::symmetric2;
    per_step.normalize = true;
    check_slope(per_step, P, Q, direction);
    check_slope(curvewise::FrechetOptions{}, P, Q, direction);
    check_slope(curvewise::CurveLengthOptions{curvewise::LengthScale::range}, P, Q, direction);
    check_slope(curvewise::FrechetContinuousOptions{}, P, Q, direction);
    check_slope(soft(0.1), P, Q, direction);
    check_slope(soft(2.0, 3), P, Q, direction);
}

// What decides a distance, among many places that are as far apart along the matching.
void slopes_of_distances_between_curves() {
    Random random(23);
    for (int k = 0; k < 200; ++k) {
        const int dim = 1 + k % 4;
        const Curve P = random.curve(2 + k % 17, dim), Q = random.curve(2 + k % 23, dim);
        const Curve direction = random.curve(25, dim);
        check_slope(curvewise::FrechetContinuousOptions{}, P, Q, direction);
        check_slope(curvewise::FrechetOptions{}, P, Q, direction);
    }
}

// Two pairs of points that are as far apart: one of both decides.
void ties() {
    const Curve P{{0.0}, {2.0}}, Q{{1.0}, {3.0}};
    std::vector<double> gradient(2);
    CHECK_EQUAL(value_and_gradient(curvewise::FrechetOptions{}, P, Q, gradient.data()), 1.0);
    CHECK_EQUAL(gradient[0] + gradient[1], 1.0);
    CHECK_EQUAL(value_and_gradient(curvewise::FrechetContinuousOptions{}, P, Q, gradient.data()),
                1.0);
    CHECK_EQUAL(gradient[0] + gradient[1], 1.0);
}

// More rows than a strip has, and a band that leaves cells of most strips out.
void slopes_across_strips() {
    Random random(18);
    const Curve P = random.curve(200, 1), Q = random.curve(170, 1),
                direction = random.curve(200, 1);
    check_slope(soft(1.0), P, Q, direction);
    check_slope(soft(1.0, 20), P, Q, direction);
}

// As one by one, for any number of threads, and errors that name the pair.
void batches() {
    Random random(19);
    std::vector<Curve> P, Q;
    for (int k = 0; k < 7; ++k) {
        P.push_back(random.curve(5 + k, 2));
        Q.push_back(random.curve(9, 2));
    }
    const std::vector<curvewise::CurveView> p(P.begin(), P.end()), q(Q.begin(), Q.end());
    for (const std::ptrdiff_t workers : {1, 3, -1}) {
        std::vector<std::vector<double>> gradients;
        std::vector<curvewise::Gradients> out;
        for (const Curve& curve : Q) gradients.emplace_back(curve.values().size());
        for (std::vector<double>& gradient : gradients) out.push_back({nullptr, gradient.data()});
        out.back() = {};
        std::vector<double> values(P.size());
        values_and_gradients(curvewise::DtwOptions{}, p, q, values.data(), out, workers);
        for (std::size_t k = 0; k < P.size(); ++k) {
            std::vector<double> alone(Q[k].values().size());
            CHECK_EQUAL(values[k],
                        value_and_gradient(curvewise::DtwOptions{}, P[k], Q[k], alone.data()));
            if (k + 1 < P.size()) CHECK_EQUAL(gradients[k], alone);
        }
    }
    std::vector<double> values(P.size());
    const std::vector<curvewise::Gradients> none(P.size());
    std::vector<curvewise::CurveView> bad = q;
    bad[4] = {Q[4].values().data(), 0, 2};
    CHECK_THROWS(values_and_gradients(curvewise::DtwOptions{}, p, bad, values.data(), none, 2),
                 std::invalid_argument, "pair 4: Q has shape (0, 2); dtw needs at least 1 point");
    bad.pop_back();
    CHECK_THROWS(values_and_gradients(curvewise::DtwOptions{}, p, bad, values.data(), none),
                 std::invalid_argument,
                 "there are 7 P, 6 Q and 7 places for derivatives; give as many of each");
}

void squares() {
    const Curve P{{0.0, 1.0}, {2.0, 3.0}}, Q{{1.0, 1.0}, {0.0, 7.0}};
    std::vector<double> gradient(4);
    CHECK_EQUAL(curvewise::sum_of_squares_and_gradient(P, Q, gradient.data()), 21.0);
    CHECK_EQUAL(gradient, (std::vector<double>{2.0, 0.0, -4.0, 8.0}));
}

void messages() {
    const Curve P{{0.0, 1.0}, {2.0, 3.0}};
    std::vector<double> gradient(4);
    curvewise::AreaOptions options;
    options.spacing = curvewise::Spacing::arc_length;
    CHECK_THROWS(
        value_and_gradient(options, P, P, gradient.data()), std::invalid_argument,
        "area has no gradient with spacing='arc_length'; choose from distance, x, matched");
}

}  // namespace

int main() {
    return check::run({{"slopes", slopes},
                       {"slopes of distances between curves", slopes_of_distances_between_curves},
                       {"ties", ties},
                       {"slopes across strips", slopes_across_strips},
                       {"batches", batches},
                       {"squares", squares},
                       {"messages", messages}});
}
