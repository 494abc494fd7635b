// The refinement of Algorithm 1 against the same said plainly: look for the longest part, bisect
// it, start again. To the bit, on curves full of segments that are equally long.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../../stress/textbook_planar.hpp"
#include "check.hpp"
#include "curves.hpp"
#include "planar/refinement.hpp"
#include "unpolled.hpp"

namespace {

using curvewise::Spacing;
using curvewise::curves::Point;
using curvewise::curves::Polyline;
using curvewise::curves::RangeScale;
using curvewise::planar::face;
using curvewise::planar::FacingCurves;
using test::Curve;
using test::Random;
using test::unpolled;

const RangeScale as_they_are(1.0);

FacingCurves facing_curves(const Curve& P, const Curve& Q, Spacing spacing) {
    return face(P, Q, as_they_are, spacing, unpolled);
}

template <class Points>
std::vector<double> numbers(const Points& curve) {
    std::vector<double> result;
    for (const auto& point : curve) result.insert(result.end(), {point.x, point.y});
    return result;
}

void longest_first() {
    Random random(41);
    for (int repeat = 0; repeat < 200; ++repeat) {
        const std::ptrdiff_t n = 2 + random.index(12), m = n + random.index(90);
        const bool lattice = repeat % 2 == 0;
        const Curve P = lattice ? random.lattice_curve(n, 2) : random.walk(n);
        const Curve Q = random.walk(m);
        const auto more = static_cast<std::size_t>(m - n);
        const check::Note note("n = " + std::to_string(n) + ", m = " + std::to_string(m));
        for (const Spacing spacing : {Spacing::distance, Spacing::x}) {
            const FacingCurves facing = facing_curves(P, Q, spacing);
            const Polyline& refined = n == m ? facing.A : facing.B;
            const Polyline& untouched = n == m ? facing.B : facing.A;
            CHECK_EQUAL(numbers(untouched), Q.values());
            CHECK_EQUAL(numbers(refined),
                        numbers(textbook::bisected(textbook::points_of(P), more, spacing)));
            CHECK_EQUAL(numbers(facing_curves(Q, P, spacing).A), Q.values());
        }
    }
}

// Segments without length are bisected like any other, when nothing longer is left.
void no_length() {
    const Curve P{{1.0, 2.0}, {1.0, 2.0}, {1.0, 2.0}}, Q = Random(42).walk(9);
    for (const Spacing spacing : {Spacing::distance, Spacing::x}) {
        const FacingCurves facing = facing_curves(P, Q, spacing);
        CHECK_EQUAL(numbers(facing.B), numbers(Polyline(9, Point{1.0, 2.0})));
    }
}

void check_close(const Polyline& facing, const textbook::Points& expected) {
    CHECK_EQUAL(facing.size(), expected.size());
    for (std::size_t k = 0; k < std::min(facing.size(), expected.size()); ++k) {
        CHECK(std::abs(facing[k].x - expected[k].x) < 1e-12);
        CHECK(std::abs(facing[k].y - expected[k].y) < 1e-12);
    }
}

// Every vertex of either curve, in the order of relative arc length; once where both have one.
void at_every_vertex() {
    Random random(43);
    for (int repeat = 0; repeat < 100; ++repeat) {
        const Curve P = random.walk(2 + random.index(30));
        const Curve Q =
            repeat % 3 == 0 ? random.lattice_curve(40, 2) : random.walk(2 + random.index(30));
        const auto [p, q] = textbook::merged(textbook::points_of(P), textbook::points_of(Q));
        const FacingCurves facing = facing_curves(P, Q, Spacing::arc_length);
        check_close(facing.A, p);
        check_close(facing.B, q);
    }
}

// A curve without length faces every vertex of the other from where it is.
void arc_length_without_length() {
    const Curve P{{1.0, 2.0}, {1.0, 2.0}}, Q = Random(44).walk(5);
    const FacingCurves facing = facing_curves(P, Q, Spacing::arc_length);
    CHECK_EQUAL(numbers(facing.B), Q.values());
    CHECK_EQUAL(numbers(facing.A), numbers(Polyline(5, Point{1.0, 2.0})));
    CHECK_EQUAL(numbers(facing_curves(Q, P, Spacing::arc_length).A), Q.values());
}

}  // namespace

int main() {
    return check::run({{"longest first", longest_first},
                       {"no length", no_length},
                       {"at every vertex", at_every_vertex},
                       {"arc length without length", arc_length_without_length}});
}
