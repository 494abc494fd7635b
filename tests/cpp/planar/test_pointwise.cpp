// The point-by-point measures and normalize: values by hand, range, and messages.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/pointwise.hpp"

namespace {

using curvewise::mae;
using curvewise::mse;
using curvewise::normalize;
using curvewise::sum_of_squares;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> normalized(const Curve& P, const Curve& C) {
    std::vector<double> out(C.values().size());
    normalize(P, C, out.data());
    return out;
}

void values_by_hand() {
    const Curve P{{0.0, 1.0, 2.0}, {3.0, 4.0, 5.0}}, Q{{1.0, 1.0, 0.0}, {3.0, 1.0, 9.0}};
    CHECK_EQUAL(sum_of_squares(P, Q), 30.0);
    CHECK_EQUAL(mse(P, Q), 5.0);
    CHECK_EQUAL(mae(P, Q), 10.0 / 6.0);
    CHECK_EQUAL(mse(Q, P), mse(P, Q));
    CHECK_EQUAL(sum_of_squares(P, P), 0.0);
    CHECK_EQUAL(mae(P, P), 0.0);
}

// Both curves times 2^k; a mean that fits a double must not be lost with the sum.
void magnitudes() {
    Random random(81);
    const Curve P = random.curve(50, 3), Q = random.curve(50, 3);
    for (const int k : {-1000, -505, -490, 490, 505, 1000}) {
        const check::Note note("both times 2^" + std::to_string(k));
        const Curve R = P.times_power_of_two(k), S = Q.times_power_of_two(k);
        CHECK_EQUAL(sum_of_squares(R, S), std::ldexp(sum_of_squares(P, Q), 2 * k));
        CHECK_EQUAL(mse(R, S), std::ldexp(mse(P, Q), 2 * k));
        CHECK_EQUAL(mae(R, S), std::ldexp(mae(P, Q), k));
    }
    const Curve ones{{1.0}, {1.0}, {1.0}, {1.0}}, zeros{{0.0}, {0.0}, {0.0}, {0.0}};
    CHECK_EQUAL(sum_of_squares(ones.times_power_of_two(511), zeros), infinity);
    CHECK_EQUAL(mse(ones.times_power_of_two(511), zeros), std::ldexp(1.0, 1022));
    CHECK_EQUAL(mae(ones.times_power_of_two(1022), zeros), std::ldexp(1.0, 1022));
    CHECK_EQUAL(mae(Curve{{1.7e308}}, Curve{{-1.7e308}}), infinity);
}

void normalizing() {
    const Curve P{{1.0, 5.0}, {3.0, 5.0}, {2.0, 5.0}}, C{{5.0, 7.0}};
    CHECK_EQUAL(normalized(P, P), (std::vector<double>{0, 0, 1, 0, 0.5, 0}));
    CHECK_EQUAL(normalized(P, C), (std::vector<double>{2, 2}));
    // An extent beyond the largest double, and one below the smallest normal one.
    const Curve wide{{-1.5e308}, {0.0}, {1.5e308}};
    CHECK_EQUAL(normalized(wide, wide), (std::vector<double>{0, 0.5, 1}));
    const double tiny = std::numeric_limits<double>::denorm_min();
    CHECK_EQUAL(normalized(Curve{{0.0}, {4 * tiny}}, Curve{{2 * tiny}, {tiny}}),
                (std::vector<double>{0.5, 0.25}));
    // If P's extent is zero, nothing is divided, in any magnitude.
    const Curve level{{1e200, 1.0}, {2e200, 1.0}};
    CHECK_CLOSE(normalized(level, Curve{{1e200, 1e190}})[1], 1e190, 1e-15);
    CHECK_CLOSE(normalized(Curve{{1e200}, {1e200}}, Curve{{3e200}})[0], 2e200, 1e-15);
}

void messages() {
    const Curve P{{0.0, 0.0}, {1.0, 1.0}}, Q{{0.0, 0.0}}, none({}, 2);
    const auto refuse = [](const Curve& A, const Curve& B, const std::string& before,
                           const std::string& after) {
        CHECK_THROWS(sum_of_squares(A, B), std::invalid_argument,
                     before + "sum_of_squares" + after);
        CHECK_THROWS(mse(A, B), std::invalid_argument, before + "mse" + after);
        CHECK_THROWS(mae(A, B), std::invalid_argument, before + "mae" + after);
    };
    refuse(P, Q, "P has shape (2, 2) and Q has shape (1, 2); ", " needs equal shapes");
    refuse(Q, {{0.0}}, "P has shape (1, 2) and Q has shape (1, 1); ", " needs equal shapes");
    refuse(none, none, "P has shape (0, 2); ", " needs at least 1 point");
    CHECK_THROWS(mse(P, Curve{{0.0, 1.0}, {2.0, std::nan("")}}), std::invalid_argument,
                 "Q[1, 1] is nan; curves must be finite");
    const curvewise::CurveView no_columns(nullptr, 5, 0);
    CHECK_THROWS(mse(no_columns, no_columns), std::invalid_argument,
                 "P has shape (5, 0); a curve needs at least 1 coordinate");
    std::vector<double> out(4);
    CHECK_THROWS(
        normalize(P, Curve{{1.0}}, out.data()), std::invalid_argument,
        "P has shape (2, 2) and Q has shape (1, 1); both need the same number of coordinates");
    CHECK_THROWS(normalize(none, P, out.data()), std::invalid_argument,
                 "P has shape (0, 2); normalize needs at least 1 point");
    CHECK_THROWS(normalize(P, Curve{{0.0, -infinity}}, out.data(), "others[2]"),
                 std::invalid_argument, "others[2][0, 1] is -inf; curves must be finite");
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"magnitudes", magnitudes},
                       {"normalizing", normalizing},
                       {"messages", messages}});
}
