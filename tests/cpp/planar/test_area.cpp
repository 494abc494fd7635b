// The area: quadrilaterals against areas found in another way, refinement against cuts worked out
// by hand, and what the measure must not depend on.
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/area.hpp"

namespace {

using curvewise::area;
using curvewise::area_quads;
using curvewise::AreaOptions;
using curvewise::AreaQuads;
using curvewise::Crossing;
using curvewise::Spacing;
using test::Curve;
using test::Random;

using QuadPoints = std::array<std::array<double, 2>, 4>;

constexpr Spacing spacings[] = {Spacing::distance, Spacing::x, Spacing::arc_length};
constexpr AreaOptions split{Spacing::distance, Crossing::split};

// Gauss's formula.
double shoelace(const QuadPoints& quad) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& [x, y] = quad[k];
        const auto& [next_x, next_y] = quad[(k + 1) % 4];
        sum += x * next_y - next_x * y;
    }
    return 0.5 * std::abs(sum);
}

void values_by_hand() {
    const Curve flat{{0.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}}, above{{0.0, 2.0}, {1.0, 2.0}, {3.0, 2.0}};
    CHECK_EQUAL(area(flat, above), 6.0);
    CHECK_EQUAL(area(flat, above, {Spacing::distance, Crossing::rearrange, true}), 4.0 + 16.0);
    CHECK_EQUAL(area(flat, flat), 0.0);
    // A triangle: one side of the quadrilateral has zero length.
    CHECK_EQUAL(area(Curve{{0.0, 0.0}, {4.0, 0.0}}, Curve{{0.0, 0.0}, {4.0, 3.0}}), 6.0);
    // Not convex: a dart.
    CHECK_EQUAL(area(Curve{{0.0, 0.0}, {4.0, 0.0}}, Curve{{0.0, 4.0}, {1.0, 1.0}}), 4.0);
}

void crossing_segments() {
    const Curve falling{{0.0, 1.0}, {1.0, -1.0}}, rising{{0.0, -1.0}, {1.0, 1.0}};
    CHECK_EQUAL(area(falling, rising), 2.0);
    CHECK_EQUAL(area(falling, rising, split), 1.0);
    CHECK_EQUAL(area(falling, rising, {Spacing::distance, Crossing::split, true}), 1.0);
    const AreaQuads rearranged = area_quads(falling, rising);
    CHECK_EQUAL(rearranged.quads[0], (QuadPoints{{{0, 1}, {1, 1}, {1, -1}, {0, -1}}}));
    const AreaQuads original = area_quads(falling, rising, split);
    CHECK_EQUAL(original.quads[0], (QuadPoints{{{0, 1}, {1, -1}, {1, 1}, {0, -1}}}));
    // The curves run against each other: the connecting sides cross, and swapping the first two
    // vertices is what turns the second curve round.
    const Curve right{{0.0, 0.0}, {2.0, 0.0}}, left{{2.0, 1.0}, {0.0, 1.0}};
    CHECK_EQUAL(area(right, left), 2.0);
    CHECK_EQUAL(area(right, left, split), 1.0);
}

// Where AB and CD cross: the sum of the triangles at the crossing point. 0 where they do not.
double triangles_at_crossing(const QuadPoints& quad, std::size_t first) {
    const auto& [a, b] = std::pair(quad[first], quad[(first + 1) % 4]);
    const auto& [c, d] = std::pair(quad[(first + 2) % 4], quad[(first + 3) % 4]);
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = d[0] - c[0], vy = d[1] - c[1];
    const double wx = c[0] - a[0], wy = c[1] - a[1];
    const double determinant = ux * vy - uy * vx;
    const double s = (wx * vy - wy * vx) / determinant, t = (wx * uy - wy * ux) / determinant;
    if (!(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)) return 0.0;
    const double x = a[0] + s * ux, y = a[1] + s * uy;
    const auto triangle = [&](const auto& p, const auto& q) {
        return 0.5 * std::abs((p[0] - x) * (q[1] - y) - (q[0] - x) * (p[1] - y));
    };
    return triangle(a, d) + triangle(b, c);
}

double crossing_area(const QuadPoints& quad) {
    return triangles_at_crossing(quad, 0) + triangles_at_crossing(quad, 1);
}

void random_quadrilaterals() {
    Random random(31);
    int complex = 0;
    for (int repeat = 0; repeat < 2000; ++repeat) {
        const Curve P = random.curve(2, 2), Q = random.curve(2, 2);
        const QuadPoints quad = area_quads(P, Q, split).quads[0];
        CHECK_EQUAL(
            quad,
            (QuadPoints{
                {{P(0, 0), P(0, 1)}, {P(1, 0), P(1, 1)}, {Q(1, 0), Q(1, 1)}, {Q(0, 0), Q(0, 1)}}}));
        const double triangles = crossing_area(quad);
        if (triangles == 0.0) {
            CHECK_CLOSE(area(P, Q), shoelace(quad), 1e-9);
            CHECK_EQUAL(area(P, Q, split), area(P, Q));
            continue;
        }
        ++complex;
        CHECK_CLOSE(area(P, Q, split), triangles, 1e-9);
        const auto& [a, b, c, d] = quad;
        const QuadPoints first_swap{b, a, c, d}, second_swap{a, c, b, d};
        const bool first_is_simple = crossing_area(first_swap) == 0.0;
        const QuadPoints& rearranged = first_is_simple ? first_swap : second_swap;
        CHECK_CLOSE(area(P, Q), shoelace(rearranged), 1e-9);
        CHECK_EQUAL(area_quads(P, Q).quads[0], rearranged);
    }
    CHECK(complex > 300);
}

// A vertex of Q lies on the line through P, and rounding decides that a quadrilateral is complex:
// no pair of its sides crosses.
void splitting_does_not_jump() {
    constexpr AreaOptions options{Spacing::arc_length, Crossing::split};
    const Curve P{{0.0, 0.0}, {2.0, 3.0}}, Q{{2.0, 1.0}, {2.0, 3.0}, {2.0, 0.0}, {1.0, 0.0}};
    for (std::ptrdiff_t i = 0; i < Q.size(); ++i) {
        for (const double move : {-1e-13, 1e-13}) {
            Curve moved = Q;
            moved(i, 1) += move;
            CHECK_CLOSE(area(P, moved, options), area(P, Q, options), 1e-11);
        }
    }
}

// Vertices of the curve that was refined: those of the quadrilaterals' last side.
std::vector<double> refined_x(const Curve& P, const Curve& Q, Spacing spacing) {
    const AreaQuads result = area_quads(P, Q, {spacing, Crossing::split});
    std::vector<double> x{result.quads[0][3][0]};
    for (const QuadPoints& quad : result.quads) x.push_back(quad[2][0]);
    return x;
}

void refinement_by_hand() {
    const Curve five{{0.0, 5.0}, {1.0, 5.0}, {2.0, 5.0}, {3.0, 5.0}, {4.0, 5.0}};
    // Longest first; the first of equals.
    CHECK_EQUAL(refined_x(five, Curve{{0.0, 0.0}, {4.0, 0.0}}, Spacing::distance),
                (std::vector<double>{0, 1, 2, 3, 4}));
    CHECK_EQUAL(
        refined_x(five, Curve{{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.0}, {6.0, 0.0}}, Spacing::distance),
        (std::vector<double>{0, 1, 2, 4, 6}));
    CHECK_EQUAL(refined_x(five, Curve{{0.0, 0.0}, {1.0, 0.0}, {4.0, 0.0}}, Spacing::distance),
                (std::vector<double>{0, 1, 1.75, 2.5, 4}));
    // The steep segment is the longer one, the flat one is longer in x.
    const Curve steep{{0.0, 0.0}, {1.0, 90.0}, {3.0, 90.0}, {3.5, 90.0}};
    CHECK_EQUAL(refined_x(five, steep, Spacing::distance),
                (std::vector<double>{0, 0.5, 1, 3, 3.5}));
    CHECK_EQUAL(refined_x(five, steep, Spacing::x), (std::vector<double>{0, 1, 2, 3, 3.5}));
    // P's corner at a quarter of its length faces a quarter of Q's, and the other way round.
    const Curve P{{0.0, 0.0}, {1.0, 0.0}, {4.0, 0.0}}, Q{{0.0, 1.0}, {8.0, 1.0}, {16.0, 1.0}};
    CHECK_EQUAL(refined_x(P, Q, Spacing::arc_length), (std::vector<double>{0, 4, 8, 16}));
    CHECK_EQUAL(refined_x(Q, P, Spacing::arc_length), (std::vector<double>{0, 1, 2, 4}));
}

// The curve with more points comes first in a quadrilateral; P if equal.
void roles() {
    const Curve two{{0.0, 0.0}, {2.0, 0.0}}, three{{0.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}};
    const QuadPoints expected{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    CHECK_EQUAL(area_quads(two, three).quads[0], expected);
    CHECK_EQUAL(area_quads(three, two).quads[0], expected);
    CHECK_EQUAL(area_quads(three, three).quads.size(), std::size_t{2});
}

void sums_and_symmetry() {
    Random random(32);
    for (const Spacing spacing : spacings) {
        for (const Crossing crossing : {Crossing::rearrange, Crossing::split}) {
            const Curve P = random.walk(40), Q = random.walk(57);
            const AreaQuads result = area_quads(P, Q, {spacing, crossing});
            double sum = 0.0, sum_of_squares = 0.0;
            for (std::size_t k = 0; k < result.areas.size(); ++k) {
                sum += result.areas[k];
                sum_of_squares += result.areas[k] * result.areas[k];
                if (crossing == Crossing::split) continue;
                CHECK_CLOSE(result.areas[k] + 1.0, shoelace(result.quads[k]) + 1.0, 1e-12);
            }
            CHECK_EQUAL(result.quads.size(), result.areas.size());
            CHECK_CLOSE(area(P, Q, {spacing, crossing}), sum, 1e-14);
            CHECK_CLOSE(area(P, Q, {spacing, crossing, true}), sum_of_squares, 1e-14);
            CHECK_EQUAL(area(P, P, {spacing, crossing}), 0.0);
            if (spacing == Spacing::arc_length) continue;
            CHECK_CLOSE(area(P, Q, {spacing, crossing}), area(Q, P, {spacing, crossing}), 1e-12);
        }
    }
}

// Equal steps of 0.1 are equal but for rounding: which of them is bisected must not depend on it.
void translation() {
    Random random(33);
    const Curve P = random.walk(48);
    std::vector<double> points;
    for (int i = 0; i < 31; ++i) points.insert(points.end(), {0.1 * i, i % 2 == 0 ? 0.0 : 0.3});
    const Curve even(points, 2);
    for (const Spacing spacing : spacings) {
        for (const double shift : {0.1, 3.7, -11.3, 1000.0 / 3.0}) {
            const check::Note note("a shift by " + std::to_string(shift));
            Curve P_there = P, Q_there = even;
            for (std::ptrdiff_t i = 0; i < P.size(); ++i) P_there(i, 0) += shift;
            for (std::ptrdiff_t i = 0; i < even.size(); ++i) Q_there(i, 0) += shift;
            CHECK_CLOSE(area(P_there, Q_there, {spacing}), area(P, even, {spacing}), 1e-10);
        }
    }
}

// With two more points on every segment.
Curve sampled_finer(const Curve& P) {
    std::vector<double> points{P(0, 0), P(0, 1)};
    for (std::ptrdiff_t i = 0; i + 1 < P.size(); ++i) {
        for (const double h : {0.3, 0.8, 1.0}) {
            points.push_back(P(i, 0) + h * (P(i + 1, 0) - P(i, 0)));
            points.push_back(P(i, 1) + h * (P(i + 1, 1) - P(i, 1)));
        }
    }
    return {points, 2};
}

// More points on the same curves change nothing for `arc_length`.
void sampling() {
    Random random(34);
    constexpr AreaOptions options{Spacing::arc_length, Crossing::rearrange};
    Curve P = random.curve(20, 2), Q = random.curve(13, 2);
    for (std::ptrdiff_t i = 0; i < P.size(); ++i) P(i, 0) = static_cast<double>(i);
    for (std::ptrdiff_t i = 0; i < Q.size(); ++i) Q(i, 0) = 1.5 * static_cast<double>(i);
    for (std::ptrdiff_t i = 0; i < Q.size(); ++i) Q(i, 1) += 10.0;
    const Curve finer = sampled_finer(P);
    CHECK_CLOSE(area(finer, Q, options), area(P, Q, options), 1e-12);
    CHECK_CLOSE(area(Q, finer, options), area(Q, P, options), 1e-12);
    CHECK(area(P, finer, options) < 1e-12);
    CHECK(area(P, finer) > 0.1);
}

void magnitudes() {
    Random random(35);
    const Curve P = random.walk(20), Q = random.walk(30);
    for (const Spacing spacing : spacings) {
        for (const int k : {-511, -505, -400, 400, 505, 508}) {
            const check::Note note("both times 2^" + std::to_string(k));
            const Curve R = P.times_power_of_two(k), S = Q.times_power_of_two(k);
            CHECK_EQUAL(area(R, S, {spacing}), std::ldexp(area(P, Q, {spacing}), 2 * k));
            const AreaQuads scaled = area_quads(R, S, {spacing});
            const AreaQuads expected = area_quads(P, Q, {spacing});
            CHECK_EQUAL(scaled.areas.back(), std::ldexp(expected.areas.back(), 2 * k));
            CHECK_EQUAL(scaled.quads[5][2][1], std::ldexp(expected.quads[5][2][1], k));
        }
    }
    // If P's extent is zero, nothing is scaled: next to x, Q's y does not count in its length.
    const Curve flat = Curve{{0.0, 0.0}, {4.0, 0.0}}.times_power_of_two(-600);
    const Curve roof = Curve{{0.0, 0.0}, {1.0, 9.0}, {4.0, 0.0}}.times_power_of_two(-600);
    const AreaQuads quads = area_quads(flat, roof, {Spacing::arc_length, Crossing::split});
    CHECK_EQUAL(quads.quads[0][1][0], std::ldexp(1.0, -600));
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK_EQUAL(area(P.times_power_of_two(1000), Q.times_power_of_two(1000)), infinity);
    // Too long a curve, in units of P's box.
    const Curve tiny{{0.0, 0.0}, {1e-200, 1e-200}}, huge{{0.0, 0.0}, {1e200, 0.0}, {0.0, 1e200}};
    CHECK_EQUAL(area(tiny, huge, {Spacing::arc_length}), infinity);
}

void messages() {
    const Curve P{{0.0, 0.0}, {1.0, 1.0}}, point{{0.0, 0.0}},
        space{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
    const auto refuses = [](const Curve& A, const Curve& B, const std::string& message) {
        CHECK_THROWS(area(A, B), std::invalid_argument, message);
        CHECK_THROWS(area_quads(A, B), std::invalid_argument, message);
    };
    refuses(point, P, "P has shape (1, 2); area needs at least 2 points");
    refuses(P, Curve({}, 2), "Q has shape (0, 2); area needs at least 2 points");
    refuses(space, space,
            "P has shape (2, 3) and Q has shape (2, 3); area needs 2 coordinates, x and y");
    refuses(P, space,
            "P has shape (2, 2) and Q has shape (2, 3); both need the same number of coordinates");
    refuses(P, Curve{{0.0, 0.0}, {1.0, -std::numeric_limits<double>::infinity()}},
            "Q[1, 1] is -inf; curves must be finite");
    // A curve of zero length has an area.
    CHECK_EQUAL(area(P, Curve{{0.0, 1.0}, {0.0, 1.0}}), 0.5);
}

// The number of curvewise.reference, which shares no code with this: pieces on either side of P,
// and a coordinate that turns by less than a third of the box.
void matched_area_of_the_reference() {
    const Curve P{{0, 0}, {1, 2}, {3, 1}, {4, 4}, {6, 0}, {2, -1}, {0.5, 0}};
    const Curve Q{{0, 0.5}, {2, 2.5}, {4, 3}, {5, 1}, {3, -1.5}, {0, 0.25}};
    curvewise::AreaOptions options;
    options.spacing = curvewise::Spacing::matched;
    CHECK_CLOSE(curvewise::area(P, Q, options), 6.3181757077365654, 1e-12);
}

void functions_of_x() {
    const Curve line{{0.0, 0.0}, {4.0, 4.0}};
    const Curve constant{{0.0, 1.0}, {0.5, 1.0}, {0.7, 1.0}, {3.0, 1.0}, {4.0, 1.0}};
    const AreaOptions of_x{Spacing::function}, squares{Spacing::function, Crossing::split, true};
    CHECK_EQUAL(area(line, constant, of_x), 5.0);
    CHECK_CLOSE(area(line, constant, squares), 28.0 / 3.0, 1e-15);
    // One that falls, spans more, and jumps.
    const Curve step{{9.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}, {-3.0, 2.0}};
    CHECK_EQUAL(area(line, step, of_x), 1.5 + 7.5);
    CHECK_EQUAL(area(step, line, of_x), 9.0);
    const AreaQuads strips = area_quads(line, step, of_x);
    CHECK_EQUAL(strips.areas, (std::vector<double>{1.5, 7.5}));
    CHECK_EQUAL(strips.quads[0], (QuadPoints{{{0, 0}, {1, 1}, {1, 2}, {0, 2}}}));
    const auto refuses_of_x = [&](const Curve& Q, const std::string& message) {
        CHECK_THROWS(area(line, Q, of_x), std::invalid_argument, message);
    };
    refuses_of_x(Curve{{0.0, 0.0}, {2.0, 0.0}, {1.0, 0.0}},
                 "Q[2] reverses in x; area with spacing='function' needs x that only rises or "
                 "only falls: sort the points by x, or choose another spacing");
    refuses_of_x(Curve{{4.0, 0.0}, {5.5, 0.0}},
                 "P spans x from 0 to 4 and Q from 4 to 5.5; area with spacing='function' needs a "
                 "common span");
}

}  // namespace

int main() {
    return check::run({{"functions of x", functions_of_x},
                       {"matched area of the reference", matched_area_of_the_reference},
                       {"values by hand", values_by_hand},
                       {"crossing segments", crossing_segments},
                       {"random quadrilaterals", random_quadrilaterals},
                       {"splitting does not jump", splitting_does_not_jump},
                       {"refinement by hand", refinement_by_hand},
                       {"roles", roles},
                       {"sums and symmetry", sums_and_symmetry},
                       {"translation", translation},
                       {"sampling", sampling},
                       {"magnitudes", magnitudes},
                       {"messages", messages}});
}
