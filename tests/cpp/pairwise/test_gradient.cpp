// Gradients: against central differences of the measure, in every direction at once.
#include <cmath>
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
    std::vector<double> gradient(Q.values().size(), 1e300);
    const double value = value_and_gradient(options, P, Q, gradient.data());
    CHECK_CLOSE(value, evaluate(options, P, Q), 1e-14);
    const double difference = evaluate(options, P, moved(Q, direction, step)) -
                              evaluate(options, P, moved(Q, direction, -step));
    CHECK_CLOSE(product(gradient, direction), difference / (2.0 * step), 1e-5);
}

void slopes() {
    Random random(17);
    const Curve P = random.curve(12, 2), Q = random.curve(9, 2), direction = random.curve(9, 2);
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
    return check::run({{"slopes", slopes}, {"squares", squares}, {"messages", messages}});
}
