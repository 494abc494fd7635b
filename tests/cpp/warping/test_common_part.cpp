// The common part of two curves by hand; Python's tests have all pairs of sections.
#include <cmath>
#include <stdexcept>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/common_part.hpp"

namespace {

using curvewise::common_part;
using curvewise::CommonPart;
using test::Curve;

void sections_by_hand() {
    const Curve home{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {9, 9}};
    const Curve detour{{0, 5}, {2, 0}, {3, 0}, {3.25, 0}, {4, 7}};
    const CommonPart found = common_part(home, detour, 1.0);
    CHECK_EQUAL(found.length, 3.0);
    CHECK_EQUAL(found.p.begin, 1);
    CHECK_EQUAL(found.p.end, 5);
    CHECK_EQUAL(found.q.begin, 1);
    CHECK_EQUAL(found.q.end, 3);
    const CommonPart none = common_part(home, Curve{{0, 5}, {1, 5}}, 4.5);
    CHECK_EQUAL(none.length, 0.0);
    CHECK_EQUAL(none.p.end, 0);
    CHECK_EQUAL(none.q.end, 0);
    // At the ends of the range, where squares would overflow or vanish.
    for (const int k : {-900, 900}) {
        const CommonPart scaled = common_part(home.times_power_of_two(k),
                                              detour.times_power_of_two(k), std::ldexp(1.0, k));
        CHECK_EQUAL(scaled.length, std::ldexp(3.0, k));
        CHECK_EQUAL(scaled.q.end, 3);
    }
}

void messages() {
    const Curve square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    CHECK_THROWS(common_part(square, Curve({}, 2), 1.0), std::invalid_argument,
                 "Q has shape (0, 2); common_part needs at least 1 point");
    CHECK_THROWS(common_part(square, square, std::nan("")), std::invalid_argument,
                 "distance is nan; give a number >= 0");
    CHECK_THROWS(common_part(square, square, -1.0), std::invalid_argument,
                 "distance is -1.000000; give a number >= 0");
}

}  // namespace

int main() { return check::run({{"sections by hand", sections_by_hand}, {"messages", messages}}); }
