// Curves matched by a warping path: every vertex has its place, pieces follow each other, and a
// stop is heard. The values are tested against the reference, from Python.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "planar/matched_curves.hpp"

namespace {

using curvewise::Control;
using curvewise::Stopped;
using curvewise::curves::Point;
using curvewise::curves::Polyline;
using curvewise::curves::RangeScale;
using curvewise::planar::match;
using curvewise::planar::MatchedCurves;
using curvewise::runtime::Poller;
using test::Curve;
using test::Random;

const RangeScale as_they_are(1.0);

MatchedCurves matched(const Curve& P, const Curve& Q, Control* control = nullptr) {
    Poller poller(control);
    return match(P, Q, as_they_are, poller);
}

// Along the curve, forward, to within rounding.
bool passes_all_vertices(const Polyline& passing, const Curve& curve) {
    auto point = passing.begin();
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        point = std::find_if(point, passing.end(), [&](const Point& p) {
            return std::abs(p.x - curve(i, 0)) + std::abs(p.y - curve(i, 1)) < 1e-9;
        });
        if (point == passing.end()) return false;
    }
    return true;
}

void check_matched(const Curve& P, const Curve& Q) {
    const MatchedCurves found = matched(P, Q);
    CHECK_EQUAL(found.A.size(), found.B.size());
    CHECK(passes_all_vertices(found.A, P));
    CHECK(passes_all_vertices(found.B, Q));
    CHECK(!found.ends.empty());
    CHECK_EQUAL(found.ends.back(), found.A.size() - 1);
    const auto no_step = [](std::size_t a, std::size_t b) { return a >= b; };
    CHECK(std::adjacent_find(found.ends.begin(), found.ends.end(), no_step) == found.ends.end());
}

void vertices_and_pieces() {
    Random random(71);
    for (const std::ptrdiff_t n : {2, 3, 10, 49, 300, 3000}) {
        for (const std::ptrdiff_t m : {2, 7, 50, 2000}) {
            check_matched(random.walk(n), random.walk(m));
        }
    }
    const Curve point{{1.0, 2.0}, {1.0, 2.0}, {1.0, 2.0}};
    check_matched(point, random.walk(100));
    check_matched(random.walk(100), point);
    check_matched(point, point);
    check_matched({{0.0, 1.0}, {4.0, 1.0}}, {{0.0, 2.0}, {1.0, 2.0}, {4.0, 2.0}});
}

// Ten for each width and each height of P's box that it travels. Reversals of less than a third do
// not count.
void number_of_pieces() {
    const Curve any{{0.0, 0.0}, {1.0, 1.0}};
    CHECK_EQUAL(matched({{3.0, 0.0}, {5.0, 0.0}}, any).ends.size(), std::size_t{10});
    CHECK_EQUAL(matched({{3.0, 1.0}, {5.0, 0.0}}, any).ends.size(), std::size_t{20});
    CHECK_EQUAL(matched({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}, {0.5, 0.0}}, any).ends.size(),
                std::size_t{25});
    CHECK_EQUAL(matched({{0.0, 0.0}, {0.6, 0.0}, {0.3, 0.0}, {1.0, 0.0}}, any).ends.size(),
                std::size_t{10});
    CHECK_EQUAL(matched({{0.5, 0.0}, {1.0, 0.0}, {0.0, 0.0}, {0.25, 0.0}}, any).ends.size(),
                std::size_t{18});
    CHECK_EQUAL(matched({{1.0, 1.0}, {1.0, 1.0}}, any).ends.size(), std::size_t{1});
}

// A reversal among values that are tested together: the first of them are below it and those behind
// them above it.
void a_reversal_among_a_few_values() {
    Curve P(std::vector<double>(42, 0.0), 2);
    for (int i = 0; i < 16; ++i) P(i, 0) = 0.025 * i;
    int i = 16;
    for (const double x : {0.6, 0.8, 0.4, 0.9, 1.0}) P(i++, 0) = x;
    CHECK_EQUAL(matched(P, P).ends.size(), std::size_t{18});
}

void a_curve_and_itself() {
    Random random(72);
    for (const std::ptrdiff_t n : {2, 30, 2500}) {
        const Curve P = random.walk(n);
        const MatchedCurves found = matched(P, P);
        for (std::size_t i = 0; i < found.A.size(); ++i) {
            CHECK_EQUAL(found.A[i].x, found.B[i].x);
            CHECK_EQUAL(found.A[i].y, found.B[i].y);
        }
    }
}

void stops() {
    Random random(73);
    Control control;
    control.stop();
    const Curve P = random.walk(500), Q = random.walk(400);
    CHECK_THROWS(matched(P, Q, &control), Stopped, "stopped before the work was done");
}

}  // namespace

int main() {
    return check::run({{"vertices and pieces", vertices_and_pieces},
                       {"number of pieces", number_of_pieces},
                       {"a reversal among a few values", a_reversal_among_a_few_values},
                       {"a curve and itself", a_curve_and_itself},
                       {"stops", stops}});
}
