// Areas of closed curves against areas found by hand; Python's tests have fractions.
#include <cmath>
#include <stdexcept>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/area.hpp"

namespace {

using curvewise::area;
using curvewise::area_quads;
using curvewise::AreaOptions;
using curvewise::Crossing;
using curvewise::Spacing;
using test::Curve;

constexpr AreaOptions closed_with(Crossing crossing) {
    return {Spacing::distance, crossing, false, true};
}
constexpr AreaOptions polygon = closed_with(Crossing::polygon);

void polygons_by_hand() {
    const Curve square{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, bow{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
    const Curve moved{{3, 3}, {1, 3}, {1, 1}, {3, 1}, {3, 3}};
    const Curve twice{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 2}, {0, 2}};
    CHECK_EQUAL(area(square, square, polygon), 0.0);
    CHECK_EQUAL(area(square, moved, polygon), 6.0);
    CHECK_EQUAL(area(moved, square, polygon), 6.0);
    CHECK_EQUAL(area(square, bow, polygon), 2.0);
    CHECK_EQUAL(area(square, Curve{{1, 1}, {3, 3}}, polygon), 4.0);
    CHECK_EQUAL(area(square, twice, polygon), 0.0);  // the nonzero rule
    const curvewise::AreaQuads trapezoids = area_quads(square, moved, polygon);
    CHECK_EQUAL(trapezoids.quads.size(), std::size_t{4});
    double sum = 0.0;
    for (const double one : trapezoids.areas) sum += one;
    CHECK_EQUAL(sum, 6.0);
}

void beginnings() {
    const Curve square{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, later{{2, 2}, {0, 2}, {0, 0}, {2, 0}};
    const Curve shut{{2, 3}, {0, 3}, {0, 1}, {2, 1}, {2, 3}};
    CHECK(area(square, later) > 0.0);
    for (const Crossing crossing : {Crossing::rearrange, Crossing::split, Crossing::polygon}) {
        CHECK_EQUAL(area(square, later, closed_with(crossing)), 0.0);
        CHECK_EQUAL(area(square, shut, closed_with(crossing)), 4.0);
    }
}

void messages() {
    const Curve square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    CHECK_THROWS(area(square, Curve{{0, 0}}, polygon), std::invalid_argument,
                 "Q has shape (1, 2); area needs at least 2 points");
    AreaOptions open = polygon, squared = polygon, function = polygon;
    open.closed = false;
    squared.squared = true;
    function.spacing = Spacing::function;
    CHECK_THROWS(area(square, square, open), std::invalid_argument,
                 "crossing='polygon' is for closed curves; add closed=True");
    CHECK_THROWS(area(square, square, squared), std::invalid_argument,
                 "crossing='polygon' has no squared; leave out squared=True");
    CHECK_THROWS(area(square, square, function), std::invalid_argument,
                 "closed=True has no spacing='function'; choose from distance, x, arc_length, "
                 "matched");
}

}  // namespace

int main() {
    return check::run({{"polygons by hand", polygons_by_hand},
                       {"beginnings", beginnings},
                       {"messages", messages}});
}
