// Lower bounds by hand, and below dtw to the last bit; Python's tests have random pairs against the
// definitions.
#include <cmath>
#include <stdexcept>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/lower_bounds.hpp"

namespace {

using curvewise::lb_improved;
using curvewise::lb_keogh;
using curvewise::lb_kim;
using curvewise::LowerBoundOptions;
using curvewise::Metric;
using test::Curve;

const Curve P{{0}, {8}, {0}}, Q{{1}, {2}, {5}};

void bounds_by_hand() {
    CHECK_EQUAL(lb_keogh(P, Q), 5.0);
    CHECK_EQUAL(lb_keogh(Q, P), 0.0);
    CHECK_CLOSE(lb_improved(P, Q), 5.0, 1e-13);
    CHECK_EQUAL(lb_kim(P, Q), 5.0);
    LowerBoundOptions options;
    options.metric = Metric::sqeuclidean;
    CHECK_CLOSE(lb_improved(Q, P, options), 11.0, 1e-13);
    options.window = 0;
    CHECK_EQUAL(lb_keogh(P, Q, options), 1.0 + 36.0 + 25.0);
    CHECK_EQUAL(lb_keogh(Curve{{0, 0}, {9, 1}}, Curve{{3, 4}, {3, 5}}), 5.0 + std::sqrt(45.0));
}

void below_dtw() {
    for (const Metric metric : {Metric::euclidean, Metric::sqeuclidean, Metric::cityblock}) {
        curvewise::DtwOptions of_dtw;
        of_dtw.ground.metric = metric;
        of_dtw.window = 3;
        LowerBoundOptions options;
        options.metric = metric;
        options.window = 3;
        test::Random random(7);
        for (int k = 0; k < 40; ++k) {
            const Curve a = random.curve(20, 1), b = random.curve(17, 1);
            const double value = curvewise::dtw(a, b, of_dtw);
            CHECK(lb_keogh(a, b, options) <= value);
            CHECK(lb_improved(a, b, options) <= value);
            CHECK(lb_kim(a, b, options) <= value);
        }
    }
}

void messages() {
    LowerBoundOptions options;
    options.metric = Metric::minkowski;
    CHECK_THROWS(lb_keogh(P, Q, options), std::invalid_argument,
                 "metric is 'minkowski'; lower bounds need euclidean, sqeuclidean, cityblock or "
                 "chebyshev");
    options.metric = Metric::euclidean;
    CHECK_THROWS(lb_improved(Curve{{0, 1}}, Curve{{1, 2}}, options), std::invalid_argument,
                 "metric is 'euclidean'; lb_improved of 2 coordinates needs metric='sqeuclidean' "
                 "or 'cityblock'; lb_keogh has the others");
    CHECK_THROWS(lb_kim(P, Curve({}, 1)), std::invalid_argument,
                 "Q has shape (0, 1); lb_kim needs at least 1 point");
}

}  // namespace

int main() {
    return check::run(
        {{"bounds by hand", bounds_by_hand}, {"below dtw", below_dtw}, {"messages", messages}});
}
