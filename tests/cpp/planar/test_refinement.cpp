// The refinement of Algorithm 1 against the same said plainly: look for the longest part, bisect
// it, start again. To the bit, on curves full of segments that are equally long.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curves/arc_length.hpp"
#include "planar/refinement.hpp"
#include "unpolled.hpp"

namespace {

using curvewise::Spacing;
using curvewise::curves::arc_lengths;
using curvewise::curves::box_scaled;
using curvewise::curves::interpolate;
using curvewise::curves::Point;
using curvewise::curves::Polyline;
using curvewise::curves::RangeScale;
using curvewise::planar::face;
using curvewise::planar::FacingCurves;
using test::Curve;
using test::Random;
using test::unpolled;

const RangeScale as_they_are(1.0);

Polyline points_of(const Curve& curve) { return polyline(curve, as_they_are, unpolled); }

FacingCurves facing_curves(const Curve& P, const Curve& Q, Spacing spacing) {
    return face(P, Q, as_they_are, spacing, unpolled);
}

std::vector<double> numbers(const Polyline& curve) {
    std::vector<double> result;
    for (const Point& point : curve) result.insert(result.end(), {point.x, point.y});
    return result;
}

double rounded_to_34_bits(double length) {
    if (length == 0.0) return 0.0;
    const double unit = std::ldexp(1.0, std::ilogb(length) - 33);
    return std::nearbyint(length / unit) * unit;
}

struct Part {
    double length;
    std::size_t segment;
    double start;
    double width;
};

// Linear search for the longest part, the first of equals: O(size^2).
Polyline bisected(const Polyline& curve, std::size_t size, Spacing spacing) {
    std::vector<Part> parts;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const double dx = curve[i + 1].x - curve[i].x, dy = curve[i + 1].y - curve[i].y;
        const double length = spacing == Spacing::x ? std::abs(dx) : std::sqrt(dx * dx + dy * dy);
        parts.push_back({rounded_to_34_bits(length), i, 0.0, 1.0});
    }
    while (parts.size() + 1 < size) {
        const auto longest =
            std::max_element(parts.begin(), parts.end(),
                             [](const Part& a, const Part& b) { return a.length < b.length; });
        longest->length /= 2.0;
        longest->width /= 2.0;
        Part second = *longest;
        second.start += second.width;
        parts.insert(longest + 1, second);
    }
    Polyline result;
    for (const Part& part : parts) {
        const Point &a = curve[part.segment], &b = curve[part.segment + 1];
        result.push_back({a.x + part.start * (b.x - a.x), a.y + part.start * (b.y - a.y)});
    }
    result.push_back(curve.back());
    return result;
}

void longest_first() {
    Random random(41);
    for (int repeat = 0; repeat < 200; ++repeat) {
        const std::ptrdiff_t n = 2 + random.index(12), m = n + random.index(90);
        const bool lattice = repeat % 2 == 0;
        const Curve P = lattice ? random.lattice_curve(n, 2) : random.walk(n);
        const Curve Q = random.walk(m);
        const auto size = static_cast<std::size_t>(m);
        const check::Note note("n = " + std::to_string(n) + ", m = " + std::to_string(m));
        for (const Spacing spacing : {Spacing::distance, Spacing::x}) {
            const FacingCurves facing = facing_curves(P, Q, spacing);
            const Polyline& refined = n == m ? facing.A : facing.B;
            const Polyline& untouched = n == m ? facing.B : facing.A;
            CHECK_EQUAL(numbers(untouched), Q.values());
            CHECK_EQUAL(numbers(refined), numbers(bisected(points_of(P), size, spacing)));
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

// After scaling by P's box.
std::vector<double> relative_lengths(const Curve& curve, const Curve& P) {
    std::vector<double> lengths =
        box_scaled_arc_lengths(curve, curvewise::curves::Box(P), unpolled);
    const double length = lengths.back();
    for (double& u : lengths) u /= length;
    return lengths;
}

Point place(const Polyline& curve, const std::vector<double>& lengths, double u) {
    const auto after = std::upper_bound(lengths.begin(), lengths.end(), u);
    if (after == lengths.end()) return curve.back();
    const auto k = static_cast<std::size_t>(after - lengths.begin());
    return interpolate(curve[k - 1], curve[k],
                       (u - lengths[k - 1]) / (lengths[k] - lengths[k - 1]));
}

void check_places(const Polyline& facing, const Polyline& curve, const std::vector<double>& lengths,
                  const std::vector<double>& all) {
    CHECK_EQUAL(facing.size(), all.size());
    for (std::size_t k = 0; k < std::min(facing.size(), all.size()); ++k) {
        const Point expected = place(curve, lengths, all[k]);
        CHECK(std::abs(facing[k].x - expected.x) < 1e-12);
        CHECK(std::abs(facing[k].y - expected.y) < 1e-12);
    }
}

// Every vertex of either curve, in the order of relative arc length; once where both have one.
void at_every_vertex() {
    Random random(43);
    for (int repeat = 0; repeat < 100; ++repeat) {
        const Curve P = random.walk(2 + random.index(30));
        const Curve Q =
            repeat % 3 == 0 ? random.lattice_curve(40, 2) : random.walk(2 + random.index(30));
        const std::vector<double> along_p = relative_lengths(P, P);
        const std::vector<double> along_q = relative_lengths(Q, P);
        if (std::isnan(along_p.back()) || std::isnan(along_q.back())) continue;
        std::vector<double> all;
        std::set_union(along_p.begin(), along_p.end(), along_q.begin(), along_q.end(),
                       std::back_inserter(all));
        const FacingCurves facing = facing_curves(P, Q, Spacing::arc_length);
        check_places(facing.A, points_of(P), along_p, all);
        check_places(facing.B, points_of(Q), along_q, all);
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
