// The search over all offsets against a search in every interval in which the area is convex; and
// where the smallest area is known.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "planar/offset_search.hpp"
#include "unpolled.hpp"

namespace {

using curvewise::curves::ArcCurve;
using curvewise::curves::ArcPosition;
using curvewise::curves::interpolate;
using curvewise::curves::norm;
using curvewise::curves::Point;
using curvewise::curves::RangeScale;
using curvewise::planar::best_of_all;
using curvewise::planar::best_of_grid;
using curvewise::planar::Offset;
using curvewise::planar::SearchEffort;
using test::Curve;
using test::Random;
using test::unpolled;

ArcCurve arc_curve(const Curve& curve) {
    const curvewise::curves::Polyline points = polyline(curve, RangeScale(1.0), unpolled);
    return ArcCurve(points, arc_lengths(points, unpolled));
}

// The point at arc length u, searched for from the start.
Point place(const ArcCurve& curve, double u) {
    const auto& t = curve.arc_lengths();
    const auto after = std::upper_bound(t.begin(), t.end(), u);
    if (after == t.end()) return curve.points().back();
    const auto k = static_cast<std::size_t>(after - t.begin());
    return interpolate(curve.points()[k - 1], curve.points()[k],
                       (u - t[k - 1]) / (t[k] - t[k - 1]));
}

// The sum of (d_i + d_{i+1}) / 2 (s_{i+1} - s_i).
double area_at(const ArcCurve& shorter, const ArcCurve& longer, double offset) {
    const auto& s = shorter.arc_lengths();
    std::vector<double> d;
    for (std::size_t i = 0; i < s.size(); ++i) {
        d.push_back(norm(place(longer, s[i] + offset) - shorter.points()[i]));
    }
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < s.size(); ++i)
        sum += 0.5 * (d[i] + d[i + 1]) * (s[i + 1] - s[i]);
    return sum;
}

// The smallest area between low and high, where it is convex.
double smallest_between(const ArcCurve& shorter, const ArcCurve& longer, double low, double high) {
    for (int step = 0; step < 80; ++step) {
        const double third = (high - low) / 3.0;
        const bool left =
            area_at(shorter, longer, low + third) < area_at(shorter, longer, high - third);
        (left ? high : low) = left ? high - third : low + third;
    }
    return area_at(shorter, longer, 0.5 * (low + high));
}

// The area is convex while no vertex of the shorter curve passes a corner of the longer one. So
// this tests all offsets at which a vertex passes a corner, and searches every interval between.
double exact_minimum(const ArcCurve& shorter, const ArcCurve& longer) {
    const double S = shorter.length(), slack = longer.length() - S;
    std::vector<double> offsets{0.0, slack};
    for (const double s : shorter.arc_lengths()) {
        for (const double t : longer.arc_lengths()) {
            if (t - s > 0.0 && t - s < slack) offsets.push_back(t - s);
        }
    }
    std::sort(offsets.begin(), offsets.end());
    std::vector<double> areas(offsets.size());
    std::transform(offsets.begin(), offsets.end(), areas.begin(),
                   [&](double offset) { return area_at(shorter, longer, offset); });
    double smallest = *std::min_element(areas.begin(), areas.end());
    for (std::size_t k = 0; k + 1 < offsets.size(); ++k) {
        // The area changes by at most S times the change of the offset.
        const double at_most = 0.5 * S * (offsets[k + 1] - offsets[k]);
        if (0.5 * (areas[k] + areas[k + 1]) - at_most > smallest) continue;
        smallest =
            std::min(smallest, smallest_between(shorter, longer, offsets[k], offsets[k + 1]));
    }
    return smallest;
}

void check_best(const ArcCurve& shorter, const ArcCurve& longer) {
    const Offset best = best_of_all(shorter, longer, unpolled);
    const double S = shorter.length(), slack = longer.length() - S;
    CHECK(best.at >= 0.0 && best.at <= slack);
    CHECK_CLOSE(best.area + S, area_at(shorter, longer, best.at) + S, 1e-12);
    CHECK(best.area <= best_of_grid(shorter, longer, 200, unpolled).area);
    const double exact = exact_minimum(shorter, longer);
    const check::Note note("area " + std::to_string(best.area) + ", " +
                           std::to_string((best.area - exact) / S) + " S above the exact one");
    CHECK(best.area <= exact + 2e-12 * S);
}

// Zero to a few corners of the longer curve lie between two offsets of the grid of 200.
void random_curves() {
    Random random(51);
    for (int repeat = 0; repeat < 200; ++repeat) {
        const ArcCurve p = arc_curve(random.walk(2 + random.index(5)));
        const ArcCurve q = arc_curve(random.walk(20 + random.index(repeat % 4 == 0 ? 900 : 60)));
        const check::Note note("repeat " + std::to_string(repeat));
        if (p.length() > 0.0 && p.length() < q.length()) check_best(p, q);
    }
}

// Lattice curves: parallel runs, on which the area does not change, and equal minima.
void runs_on_a_lattice() {
    Random random(52);
    for (int repeat = 0; repeat < 150; ++repeat) {
        const ArcCurve p = arc_curve(random.lattice_curve(2 + random.index(6), 2));
        const ArcCurve q = arc_curve(random.lattice_curve(15 + random.index(10), 2));
        const check::Note note("repeat " + std::to_string(repeat));
        if (p.length() > 0.0 && p.length() < q.length()) check_best(p, q);
    }
}

void a_piece_of_the_other() {
    Random random(53);
    for (int repeat = 0; repeat < 60; ++repeat) {
        const Curve whole = random.walk(80);
        const std::ptrdiff_t first = random.index(60), last = first + 3 + random.index(18);
        const ArcCurve piece = arc_curve(whole.part(first, last)), longer = arc_curve(whole);
        const check::Note note("points " + std::to_string(first) + " to " + std::to_string(last));
        const Offset best = best_of_all(piece, longer, unpolled);
        CHECK(best.area < 1e-9);
        CHECK(best.area <= 2e-12 * piece.length());
        CHECK(std::abs(best.at - longer.arc_lengths()[static_cast<std::size_t>(first)]) < 1e-9);
        const double S = piece.length(), T = longer.length();
        CHECK(best_of_grid(piece, longer, 200, unpolled).area <= S * (T - S) / 398.0);
    }
}

// Zigzags on a line, shifted against each other: every offset of a whole range is best.
void a_plateau() {
    const ArcCurve p = arc_curve({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}});
    const ArcCurve q =
        arc_curve({{3.0, 0.0}, {4.0, 0.0}, {3.0, 0.0}, {4.0, 0.0}, {3.0, 0.0}, {4.0, 0.0}});
    CHECK_CLOSE(best_of_all(p, q, unpolled).area, 9.0, 1e-14);
    check_best(p, q);
}

// Where it can be worked out: one segment below a roof, and the distance at both ends is smallest
// with the apex in the middle.
void one_segment() {
    const ArcCurve p = arc_curve({{0.0, 3.0}, {2.0, 3.0}});
    const ArcCurve q = arc_curve({{-3.0, 0.0}, {1.0, 3.0}, {5.0, 0.0}});
    const Offset best = best_of_all(p, q, unpolled);
    CHECK_CLOSE(best.at, 4.0, 1e-6);
    CHECK_CLOSE(best.area, 2.0 * std::hypot(0.2, 0.6), 1e-12);
}

// Evaluations of the search over all offsets. For short curves, each polls once.
int evaluations(const ArcCurve& shorter, const ArcCurve& longer, const SearchEffort& effort) {
    int polls = 0;
    curvewise::Control control([&](std::int64_t, std::int64_t) { return ++polls < 1'000'000; },
                               std::chrono::milliseconds(0));
    curvewise::runtime::Poller poller(&control);
    best_of_all(shorter, longer, poller, effort);
    return polls;
}

// If the value is large compared with S, offsets differ only in the last bits of their values, and
// products of lengths overflow.
void curves_far_apart() {
    const ArcCurve p = arc_curve({{0.0, 0.0}, {1.0, 1.0}});
    for (const int exponent : {20, 40, 100, 400, 600, 1000}) {
        const check::Note note("2^" + std::to_string(exponent));
        const Curve far{{-3.0, 0.1}, {0.1, 0.1}, {0.1, 0.0}};
        const ArcCurve q = arc_curve(far.times_power_of_two(exponent));
        CHECK(evaluations(p, q, {}) < 3000);
        const double least = best_of_all(p, q, unpolled).area;
        CHECK(least <= best_of_grid(p, q, 20'000, unpolled).area * (1.0 + 1e-13));
    }
}

// The search ends for all curves; its result is never worse than the grid's.
void an_effort_that_ends() {
    std::vector<double> values;
    for (int i = 0; i < 400; ++i) values.insert(values.end(), {static_cast<double>(i % 2), 0.0});
    const Curve zigzag(values, 2);
    const ArcCurve p = arc_curve(zigzag.part(0, 150)), q = arc_curve(zigzag);
    const int full = evaluations(p, q, {});
    const int cut_short = evaluations(p, q, {500, 10});
    CHECK(full > 3000);
    CHECK(cut_short < 500 + 10 * 60 + 1000);  // the grid, and the bounds, poll, too
    const Offset all = best_of_all(p, q, unpolled), ended = best_of_all(p, q, unpolled, {500, 10});
    CHECK(ended.area <= best_of_grid(p, q, 200, unpolled).area);
    CHECK_EQUAL(all.tolerance, 1e-12 * p.length());
    CHECK(ended.tolerance > 100.0 * all.tolerance);
    CHECK(ended.area <= all.area + ended.tolerance);
}

void the_grid() {
    Random random(54);
    const ArcCurve p = arc_curve(random.walk(9)), q = arc_curve(random.walk(40));
    const double slack = q.length() - p.length();
    for (const std::ptrdiff_t count : {1, 2, 3, 10, 200}) {
        double smallest = area_at(p, q, 0.0);
        for (std::ptrdiff_t k = 1; k < count; ++k) {
            const double offset = slack * static_cast<double>(k) / static_cast<double>(count - 1);
            smallest = std::min(smallest, area_at(p, q, offset));
        }
        const Offset best = best_of_grid(p, q, count, unpolled);
        CHECK_CLOSE(best.area, smallest, 1e-12);
        CHECK(best.area <= best_of_all(p, q, unpolled).area + best.tolerance);
    }
    CHECK_EQUAL(best_of_grid(p, q, 1, unpolled).at, 0.0);
    // The first of equals: along a parallel, every offset is as good.
    const ArcCurve low = arc_curve({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}});
    const ArcCurve loop = arc_curve({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}});
    CHECK_EQUAL(best_of_grid(low, loop, 3, unpolled).at, 0.0);
    CHECK_EQUAL(best_of_all(low, loop, unpolled).at, 0.0);
    // No room to move.
    CHECK_EQUAL(best_of_grid(p, p, 200, unpolled).area, 0.0);
    CHECK_EQUAL(best_of_all(p, p, unpolled).area, 0.0);
}

void walking_forward() {
    const ArcCurve curve = arc_curve({{0.0, 0.0}, {2.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {2.0, 1.0}});
    ArcPosition position(curve.arc_lengths());
    const auto at = [&](double u) {
        position.move_to(u);
        const Point point = position.point_on(curve.points());
        return std::vector<double>{point.x, point.y};
    };
    CHECK_EQUAL(at(0.0), (std::vector<double>{0, 0}));
    CHECK_EQUAL(at(0.5), (std::vector<double>{0.5, 0}));
    CHECK_EQUAL(at(2.0), (std::vector<double>{2, 0}));
    CHECK_EQUAL(at(2.25), (std::vector<double>{2, 0.25}));
    CHECK_EQUAL(at(3.0), (std::vector<double>{2, 1}));
    CHECK_EQUAL(at(99.0), (std::vector<double>{2, 1}));
}

}  // namespace

int main() {
    return check::run({{"random curves", random_curves},
                       {"runs on a lattice", runs_on_a_lattice},
                       {"a piece of the other", a_piece_of_the_other},
                       {"a plateau", a_plateau},
                       {"one segment", one_segment},
                       {"curves far apart", curves_far_apart},
                       {"an effort that ends", an_effort_that_ends},
                       {"the grid", the_grid},
                       {"walking forward", walking_forward}});
}
