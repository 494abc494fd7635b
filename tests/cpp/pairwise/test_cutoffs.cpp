// Batches and prepared curves with a cutoff: no value but those above it changes, whatever bounds
// leave out, with pairs computed at once and one by one.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Steps of a walk around one of three others, so that some curves are near, and values of whole
// numbers, so that bounds are equal to values.
std::vector<Curve> near_and_far(const std::vector<std::ptrdiff_t>& sizes, std::ptrdiff_t dim) {
    Random random(5);
    std::vector<Curve> curves;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        Random walk(static_cast<unsigned>(k % 3));
        Curve curve = walk.lattice_curve(sizes[k], dim);
        for (std::ptrdiff_t i = 0; i < sizes[k]; ++i) {
            for (std::ptrdiff_t c = 0; c < dim; ++c) {
                if (i > 0) curve(i, c) += curve(i - 1, c);
            }
            if (random.index(4) == 0) curve(i, 0) += 1.0;
        }
        curves.push_back(curve);
    }
    return curves;
}

std::vector<Measure> measures() {
    DtwOptions plain, squared, narrow, symmetric2;
    squared.ground.metric = narrow.ground.metric = Metric::sqeuclidean;
    narrow.window = 3;
    symmetric2.step_pattern = StepPattern::symmetric2;
    symmetric2.normalize = true;
    symmetric2.window = 4;
    FrechetOptions cityblock;
    cityblock.ground.metric = Metric::cityblock;
    return {plain,
            squared,
            narrow,
            symmetric2,
            FrechetOptions{},
            cityblock,
            FrechetContinuousOptions{}};
}

std::vector<double> limited(std::vector<double> values, double cutoff) {
    for (double& value : values) value = value > cutoff ? infinity : value;
    return values;
}

void batches_are_cut() {
    using Sizes = std::vector<std::ptrdiff_t>;
    for (const std::ptrdiff_t dim : {1, 2, 3}) {
        for (const Sizes& sizes : {Sizes(40, 12), Sizes(19, 33), Sizes(6, 90)}) {
            const std::vector<Curve> curves = near_and_far(sizes, dim);
            const std::vector<CurveView> X(curves.begin(), curves.end());
            const std::string name = std::to_string(dim) + " x " + std::to_string(sizes[0]);
            const check::Note note(name);
            for (const Measure& measure : measures()) {
                const std::vector<double> values = pdist(X, measure), all = cdist(X, X, measure);
                for (std::size_t k = 0; k < values.size(); k += 1 + values.size() / 5) {
                    for (const double cutoff : {values[k], std::nextafter(values[k], 0.0)}) {
                        CHECK_EQUAL(pdist(X, measure, {1, cutoff}), limited(values, cutoff));
                        CHECK_EQUAL(cdist(X, X, measure, {2, cutoff}), limited(all, cutoff));
                    }
                }
            }
        }
    }
}

void prepared_curves_are_cut() {
    const std::vector<Curve> curves = near_and_far({70, 60, 61, 62, 63}, 2);
    const std::vector<CurveView> Q(curves.begin() + 1, curves.end());
    for (const Measure& measure : {measures()[0], measures()[4], measures()[6]}) {
        const Prepared P(curves[0], measure);
        for (const CurveView& q : Q) {
            const double value = P(q);
            for (const double cutoff : {value, std::nextafter(value, 0.0), value / 20, infinity}) {
                BatchOptions options;
                options.cutoff = cutoff;
                CHECK_EQUAL(P(q, options), value > cutoff ? infinity : value);
                double out = 0.0;
                P({q}, &out, options);
                CHECK_EQUAL(out, value > cutoff ? infinity : value);
            }
        }
    }
    BatchOptions negative, none;
    negative.cutoff = -1.0;
    none.workers = 0;
    const Prepared P(curves[0], DtwOptions{});
    CHECK_THROWS(static_cast<void>(P(curves[1], negative)), std::invalid_argument,
                 "cutoff is -1.000000; give a number >= 0");
    CHECK_THROWS(static_cast<void>(P(curves[1], none)), std::invalid_argument,
                 "workers is 0; give a whole number >= 1, or -1 for all cores");
}

}  // namespace

int main() {
    return check::run({{"batches are cut", batches_are_cut},
                       {"prepared curves are cut", prepared_curves_are_cut}});
}
