// The area of the symmetric difference against areas found by hand; Python's
// tests have fractions.
#include <stdexcept>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/symmetric_difference.hpp"

namespace {

using curvewise::symmetric_difference;
using test::Curve;

void areas_by_hand() {
    const Curve square{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, bow{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
    const Curve moved{{3, 3}, {1, 3}, {1, 1}, {3, 1}, {3, 3}};
    CHECK_EQUAL(symmetric_difference(square, square), 0.0);
    CHECK_EQUAL(symmetric_difference(square, moved), 6.0);
    CHECK_EQUAL(symmetric_difference(moved, square), 6.0);
    CHECK_EQUAL(symmetric_difference(square, bow), 2.0);
    CHECK_EQUAL(symmetric_difference(square, Curve{{1, 1}}), 4.0);
}

void messages() {
    const Curve square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    CHECK_THROWS(symmetric_difference(square, Curve({}, 2)), std::invalid_argument,
                 "Q has shape (0, 2); symmetric_difference needs at least 1 point");
}

}  // namespace

int main() { return check::run({{"areas by hand", areas_by_hand}, {"messages", messages}}); }
