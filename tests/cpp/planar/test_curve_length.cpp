// The curve-length measure against OF2 of Andrade-Campos et al. (2012) followed step by step;
// values by hand, scales, and messages.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "../../stress/textbook_planar.hpp"
#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curve_length.hpp"

namespace {

using curvewise::curve_length;
using curvewise::curve_length_residuals;
using curvewise::CurveLengthOptions;
using curvewise::LengthScale;
using test::Curve;
using test::Random;

constexpr LengthScale scales[] = {LengthScale::mean, LengthScale::mean_abs, LengthScale::range};

std::vector<double> residuals_of(const Curve& P, const Curve& Q,
                                 const CurveLengthOptions& options = {}) {
    std::vector<double> residuals(static_cast<std::size_t>(2 * P.size()));
    curve_length_residuals(P, Q, residuals.data(), options);
    return residuals;
}

double scale_of(const Curve& P, std::ptrdiff_t c, LengthScale scale) {
    const auto n = static_cast<double>(P.size());
    double sum = 0.0, sum_abs = 0.0, low = P(0, c), high = P(0, c);
    for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
        sum += P(i, c);
        sum_abs += std::abs(P(i, c));
        low = std::min(low, P(i, c));
        high = std::max(high, P(i, c));
    }
    if (scale == LengthScale::range) return high - low;
    return (scale == LengthScale::mean ? sum : sum_abs) / n;
}

std::vector<double> step_by_step(const Curve& P, const Curve& Q, LengthScale scale) {
    const textbook::Measured p = textbook::measured_by_largest(P);
    const textbook::Measured q = textbook::measured_by_largest(Q);
    std::vector<double> residuals;
    for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
        const textbook::Long share = p.lengths[static_cast<std::size_t>(i)] / p.lengths.back();
        const auto [segment, fraction] = q.place(share * q.lengths.back());
        const auto k = static_cast<std::ptrdiff_t>(segment);
        const auto h = static_cast<double>(fraction);
        for (const std::ptrdiff_t c : {0, 1}) {
            const double delta = Q(k, c) + h * (Q(k + 1, c) - Q(k, c)) - P(i, c);
            residuals.push_back(std::log(1.0 + std::abs(delta / scale_of(P, c, scale))));
        }
    }
    return residuals;
}

double norm(const std::vector<double>& residuals) {
    double sum = 0.0;
    for (const double r : residuals) sum += r * r;
    return std::sqrt(sum);
}

void values_by_hand() {
    // Point i of P faces point i of Q; the means of P are 2 and 1.
    const Curve P{{1.0, 0.0}, {2.0, 1.0}, {3.0, 2.0}}, Q{{1.0, 1.0}, {2.0, 2.0}, {3.0, 3.0}};
    const double ln2 = std::log(2.0), ln3_2 = std::log(1.5);
    CHECK_EQUAL(curve_length(P, P), 0.0);
    CHECK_CLOSE(curve_length(P, Q), std::sqrt(3.0) * ln2, 1e-15);
    CHECK_CLOSE(curve_length(P, Q, {LengthScale::range}), std::sqrt(3.0) * ln3_2, 1e-15);
    // The middle of P faces the middle of Q's only segment; x differs by 0, 1/2 and 1.
    const Curve R{{1.0, 0.0}, {4.0, 2.0}};
    const std::vector<double> residuals = residuals_of(P, R);
    const std::vector<double> expected{0.0, 0.0, std::log(1.25), 0.0, ln3_2, 0.0};
    for (std::size_t k = 0; k < expected.size(); ++k) {
        CHECK_CLOSE(1.0 + residuals[k], 1.0 + expected[k], 1e-15);
    }
    // The absolute value is outside the quotient: negative means are as good.
    const Curve minus_p{{-1.0, 0.0}, {-2.0, -1.0}, {-3.0, -2.0}};
    const Curve minus_q{{-1.0, -1.0}, {-2.0, -2.0}, {-3.0, -3.0}};
    CHECK_EQUAL(curve_length(minus_p, minus_q), curve_length(P, Q));
}

void random_curves() {
    Random random(71);
    for (int repeat = 0; repeat < 200; ++repeat) {
        const Curve P = random.walk(5 + random.index(30)), Q = random.walk(5 + random.index(30));
        const check::Note note(test::described(P, Q) + ", repeat " + std::to_string(repeat));
        for (const LengthScale scale : scales) {
            const std::vector<double> residuals = residuals_of(P, Q, {scale});
            const std::vector<double> expected = step_by_step(P, Q, scale);
            for (std::size_t k = 0; k < expected.size(); ++k) {
                CHECK(std::abs(residuals[k] - expected[k]) <= 1e-11 * (1.0 + expected[k]));
            }
            CHECK_CLOSE(curve_length(P, Q, {scale}), norm(expected), 1e-11);
            CHECK_CLOSE(curve_length(P, Q, {scale}), norm(residuals), 1e-15);
        }
    }
}

// Repeated points, also at either end, and a coordinate that is 0 throughout.
void without_length_in_places() {
    const Curve P{{1.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}, {3.0, 2.0}, {3.0, 2.0}};
    const Curve Q{{1.0, 0.0}, {2.0, 1.0}, {2.0, 1.0}, {2.0, 1.0}, {3.0, 2.0}, {3.0, 2.0}};
    CHECK(curve_length(P, Q) < 1e-15);
    CHECK(curve_length(Q, P) < 1e-15);
    const Curve flat{{1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}};
    CHECK_CLOSE(curve_length(P, flat), norm(step_by_step(P, flat, LengthScale::mean)), 1e-14);
}

// The ends face each other exactly, without a rounding error of their places.
void ends() {
    Random random(73);
    for (int repeat = 0; repeat < 50; ++repeat) {
        const Curve P = random.walk(5 + random.index(30));
        Curve Q = random.walk(5 + random.index(30));
        for (const std::ptrdiff_t c : {0, 1}) Q(Q.size() - 1, c) = P(P.size() - 1, c);
        const std::vector<double> residuals = residuals_of(P, Q);
        CHECK_EQUAL(residuals.front(), 0.0);
        CHECK_EQUAL(residuals[residuals.size() - 2], 0.0);
        CHECK_EQUAL(residuals.back(), 0.0);
    }
}

// The value does not depend on the unit.
void magnitudes() {
    Random random(72);
    const Curve P = random.walk(20), Q = random.walk(30);
    for (const std::vector<int>& k : test::powers_for_x_and_y()) {
        const check::Note note("x times 2^" + std::to_string(k[0]) + ", y times 2^" +
                               std::to_string(k[1]));
        for (const LengthScale scale : scales) {
            const Curve R = P.times_powers_of_two(k), S = Q.times_powers_of_two(k);
            CHECK_EQUAL(curve_length(R, S, {scale}), curve_length(P, Q, {scale}));
        }
    }
}

// A quotient beyond the range of a double is infinite, never nan.
void beyond_the_range() {
    const Curve tiny{{1e-200, 1e-200}, {2e-200, 2e-200}}, huge{{1e200, 1e200}, {2e200, 3e200}};
    for (const LengthScale scale : scales) {
        const double infinity = std::numeric_limits<double>::infinity();
        CHECK_EQUAL(curve_length(tiny, huge, {scale}), infinity);
        CHECK_EQUAL(residuals_of(tiny, huge, {scale}), std::vector<double>(4, infinity));
    }
}

// Loops centred on 0, whose means are 0 but for rounding.
void scales_near_zero() {
    const Curve Q{{1.0, 0.0}, {2.0, 1.0}};
    const Curve zero_mean_x{{-0.3, 1.0}, {0.1, 2.0}, {0.2, 4.0}};
    const Curve zero_mean_y{{1.0, -0.3}, {2.0, 0.1}, {4.0, 0.2}};
    CHECK_THROWS(curve_length(zero_mean_x, Q), std::invalid_argument,
                 "the mean of P's x is 0 to rounding; use scale='mean_abs' or scale='range'");
    CHECK_THROWS(residuals_of(zero_mean_y, Q), std::invalid_argument,
                 "the mean of P's y is 0 to rounding; use scale='mean_abs' or scale='range'");
    CHECK(std::isfinite(curve_length(zero_mean_x, Q, {LengthScale::mean_abs})));
    CHECK(std::isfinite(curve_length(zero_mean_x, Q, {LengthScale::range})));
    CHECK(std::isfinite(curve_length(Q, zero_mean_x)));
    const Curve small_mean{{-0.3, 1.0}, {0.1, 2.0}, {0.2 + 1e-9, 4.0}};
    CHECK(std::isfinite(curve_length(small_mean, Q)));
    const Curve level{{1.0, 3.0}, {2.0, 3.0}}, on_axis{{0.0, 1.0}, {0.0, 2.0}};
    CHECK_THROWS(curve_length(level, Q, {LengthScale::range}), std::invalid_argument,
                 "the range of P's y is 0; use scale='mean' or scale='mean_abs'");
    for (const LengthScale scale : {LengthScale::mean_abs, LengthScale::range}) {
        CHECK_THROWS(curve_length(on_axis, Q, {scale}), std::invalid_argument,
                     "P's x is 0 throughout, which leaves nothing to divide by; add the same "
                     "constant to x of both curves and use scale='mean_abs'");
    }
}

void messages() {
    const Curve P{{0.0, 0.0}, {1.0, 1.0}}, still{{2.0, 3.0}, {2.0, 3.0}};
    const auto refuses = [](const Curve& A, const Curve& B, const std::string& message) {
        CHECK_THROWS(curve_length(A, B), std::invalid_argument, message);
        CHECK_THROWS(residuals_of(A, B), std::invalid_argument, message);
    };
    refuses(Curve({}, 2), P, "P has shape (0, 2); curve_length needs at least 2 points");
    refuses(P, Curve{{0.0, 0.0}}, "Q has shape (1, 2); curve_length needs at least 2 points");
    refuses(
        still, P,
        "P has zero length (all its points are equal); curve_length needs two different points");
    refuses(
        P, still,
        "Q has zero length (all its points are equal); curve_length needs two different points");
    refuses(P, Curve{{0.0}},
            "P has shape (2, 2) and Q has shape (1, 1); both need the same number of coordinates");
    refuses(Curve{{0.0}}, Curve{{0.0}},
            "P has shape (1, 1) and Q has shape (1, 1); curve_length needs 2 coordinates, x and y");
    refuses(Curve{{0.0, 0.0}, {1.0, std::numeric_limits<double>::infinity()}}, P,
            "P[1, 1] is inf; curves must be finite");
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"random curves", random_curves},
                       {"without length in places", without_length_in_places},
                       {"ends", ends},
                       {"magnitudes", magnitudes},
                       {"beyond the range", beyond_the_range},
                       {"scales near zero", scales_near_zero},
                       {"messages", messages}});
}
