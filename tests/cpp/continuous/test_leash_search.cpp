// The search for the continuous Fréchet distance against plain bisection over decisions, which use
// the whole free-space diagram. The curves mislead the search: the way out begins hundreds of rows
// before the row in which a walk ends. So a window around that row does not show the value.
// frechet_within() decides without a search, and is trusted here. Also tests the stored walks of a
// search.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "continuous/both_ends.hpp"
#include "continuous/leash_search.hpp"
#include "curves.hpp"
#include "curvewise/frechet_continuous.hpp"

namespace {

using curvewise::frechet_continuous;
using curvewise::frechet_within;
using curvewise::continuous::bits_of;
using curvewise::continuous::BothEnds;
using curvewise::continuous::BoxedCurve;
using curvewise::continuous::Diagram;
using curvewise::continuous::double_of;
using curvewise::continuous::ExactSigns;
using curvewise::continuous::FreeSet;
using curvewise::continuous::Radius;
using curvewise::continuous::RangeScale;
using curvewise::continuous::Runs;
using curvewise::continuous::Trail;
using test::Curve;
using test::Random;

// The least double within which two curves are. Doubles have the order of their bits.
double least_within(const Curve& P, const Curve& Q) {
    if (frechet_within(P, Q, 0.0)) return 0.0;
    std::uint64_t low = 0, high = bits_of(std::numeric_limits<double>::max());
    while (high - low > 1) {
        const std::uint64_t middle = low + (high - low) / 2;
        (frechet_within(P, Q, double_of(middle)) ? high : low) = middle;
    }
    return double_of(high);
}

void check_value(const Curve& P, const Curve& Q) {
    const double value = frechet_continuous(P, Q);
    CHECK_EQUAL(value, least_within(P, Q));
    CHECK(frechet_within(P, Q, value));
    if (value > 0.0) CHECK(!frechet_within(P, Q, std::nextafter(value, 0.0)));
    CHECK_EQUAL(frechet_continuous(Q, P), value);
}

// Heights above a line, made a curve of the plane. The line is short, and not along an axis, so
// that values have many digits.
Curve along_a_line(const std::vector<double>& heights, Random& random) {
    std::vector<double> values;
    for (const double height : heights) {
        values.push_back(0.8 * height + random.uniform(-0.01, 0.01));
        values.push_back(0.6 * height + random.uniform(-0.01, 0.01));
    }
    return {values, 2};
}

void append_plain(std::vector<double>& heights, std::ptrdiff_t rows, Random& random) {
    for (std::ptrdiff_t k = 0; k < rows; ++k) heights.push_back(random.uniform(-0.02, 0.02));
}

// As many points on every edge, which changes nothing of the curve except for rounding.
std::vector<double> divided(const std::vector<double>& heights, int parts) {
    std::vector<double> result;
    for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
        for (int part = 0; part < parts; ++part) {
            const double t = static_cast<double>(part) / parts;
            result.push_back((1.0 - t) * heights[k] + t * heights[k + 1]);
        }
    }
    result.push_back(heights.back());
    return result;
}

// P climbs to 3, runs along a plain, falls into a pit of 1.6, climbs to 5, and to 3 again. Q climbs
// two peaks of 5. A walk that leaves Q's first peak for P's climb to 5 has waited for it at a
// height of at least 3 - r, and is too far above the pit. A walk that crosses it while P is at 3
// needs a radius of 2, and never a larger one later. So 2 is the distance, and the way to it begins
// `plain` rows before the pit. The search cannot find that out with a smaller radius: the ends need
// 1.2, and P's first climb 1.55 because of the low place behind it.
//
// Both curves come from afar, P in steps and Q at once, so that walks from vertex to vertex do not
// help.
void corridors_that_part() {
    Random random(21);
    const std::vector<double> approach{-50.0, -40.0, -30.0, -20.0, -10.0};
    const std::vector<double> peaks{0.0, 5.0, -1.0, 5.0, 1.2};
    for (const std::ptrdiff_t plain : {10, 60, 140, 200, 320, 420, 1200}) {
        for (const int parts : {1, 20}) {
            const check::Note note(std::to_string(plain) + " rows between, Q's edges in " +
                                   std::to_string(parts));
            std::vector<double> p = approach;
            append_plain(p, 30, random);
            p.insert(p.end(), {3.0, -0.1});
            append_plain(p, plain, random);
            p.push_back(-1.6);
            append_plain(p, 20, random);
            p.push_back(5.0);
            append_plain(p, 20, random);
            p.push_back(3.0);
            append_plain(p, 30, random);
            std::vector<double> q = divided(peaks, parts);
            q.insert(q.begin(), approach.front());
            const Curve P = along_a_line(p, random), Q = along_a_line(q, random);
            check_value(P, Q);
            CHECK(std::abs(frechet_continuous(P, Q) - 2.0) < 0.05);
        }
    }
}

// Peaks and pits of any height at any row: bottlenecks, blind alleys, ways that part and meet.
void peaks_and_pits() {
    Random random(22);
    for (int round = 0; round < 60; ++round) {
        const check::Note note("round " + std::to_string(round));
        std::vector<double> p, q{0.0};
        const std::ptrdiff_t events = 3 + random.index(8);
        for (std::ptrdiff_t k = 0; k < events; ++k) {
            append_plain(p, 1 + random.index(1500 / events), random);
            p.push_back(random.uniform(-3.0, 5.0));
            if (random.index(3) > 0) q.push_back(p.back() + random.uniform(-1.0, 1.0));
            if (random.index(2) > 0) q.push_back(random.uniform(-1.0, 1.0));
        }
        append_plain(p, 20, random);
        q.push_back(0.0);
        const Curve P = along_a_line(p, random);
        check_value(P, along_a_line(divided(q, 1 + 9 * (round % 2)), random));
    }
}

// P has one peak, Q a second one after it, which P's last points are far from: a walk with a small
// radius comes to the last row, and not to the corner.
void bottlenecks_of_the_last_row() {
    Random random(26);
    for (const std::ptrdiff_t plain : {1, 5, 40, 300}) {
        for (const int parts : {1, 20}) {
            const check::Note note(std::to_string(plain) + " rows, Q's edges in " +
                                   std::to_string(parts));
            std::vector<double> p{0.0};
            append_plain(p, plain, random);
            p.push_back(5.0);
            append_plain(p, plain, random);
            const std::vector<double> q = divided({0.0, 5.0, 0.0, 4.0, 0.0}, parts);
            check_value(along_a_line(p, random), along_a_line(q, random));
        }
    }
}

// Zigzags, so that the reachable part of a row has many pieces. Here and there, a summit needs a
// larger radius than all before.
void zigzags() {
    Random random(23);
    for (int round = 0; round < 12; ++round) {
        const check::Note note("round " + std::to_string(round));
        std::vector<double> p, q;
        for (int k = 0; k < 4; ++k) {
            for (int i = 0; i < 80; ++i) p.push_back(random.uniform(-1.0, 1.0));
            for (int j = 0; j < 40; ++j) q.push_back(random.uniform(-1.5, 1.5));
            p.push_back(4.0);
            q.push_back(3.0 - 0.2 * k - random.uniform(0.0, 0.2));
        }
        const Curve P = along_a_line(p, random);
        check_value(P, along_a_line(q, random));
    }
}

// What the search from both ends finds, of curves whose squares need no scaling.
double least_from_both_ends(const Curve& P, const Curve& Q) {
    curvewise::runtime::Poller poller(nullptr);
    const RangeScale range(1.0);
    const BoxedCurve p(P, range, poller), q(Q, range, poller);
    const Diagram<0> diagram({p, q, ExactSigns(P, Q)}, {q, p, ExactSigns(Q, P)});
    const auto holds_ends = [&](double distance) {
        const Radius radius(distance, range, P.dim(), FreeSet::closed);
        return diagram.corner_is_free(0, 0, radius) &&
               diagram.corner_is_free(p.size() - 1, q.size() - 1, radius);
    };
    const double low = holds_ends(0.0) ? 0.0
                                       : curvewise::continuous::least_double(
                                             0.0, std::numeric_limits<double>::infinity(),
                                             std::uint64_t{1} << 40, 1, holds_ends);
    return BothEnds<0>(P, Q, diagram, range, poller).least_within(low);
}

// Few points: on lattices, where many distances are equal, on a line, repeated, alone, back and
// forth; and noise.
void walks_from_both_ends() {
    Random random(24);
    for (int round = 0; round < 600; ++round) {
        const check::Note note("round " + std::to_string(round));
        const std::ptrdiff_t dim = 1 + random.index(3);
        const auto draw = [&] {
            const std::ptrdiff_t n = 1 + random.index(round % 20 == 0 ? 60 : 10);
            return round % 3 == 0 ? random.curve(n, dim) : random.lattice_curve(n, dim);
        };
        const Curve P = draw();
        Curve Q = draw();
        if (round % 4 == 0) Q = P.part(random.index(P.size()), P.size());
        CHECK_EQUAL(least_from_both_ends(P, Q), least_within(P, Q));
        CHECK_EQUAL(least_from_both_ends(Q, P), least_within(P, Q));
    }
}

// Noise that misleads a single walk: its reachable part grows to most of the diagram, and the row
// in which it ends does not help.
void noise() {
    Random random(25);
    for (int round = 0; round < 12; ++round) {
        const check::Note note("round " + std::to_string(round));
        const std::ptrdiff_t n = 150 + 20 * random.index(8);
        const Curve P = random.curve(n, 2), Q = random.curve(n - random.index(30), 2);
        check_value(P, Q);
        CHECK_EQUAL(least_from_both_ends(P, Q), frechet_continuous(P, Q));
    }
}

// Rows are dropped where there are too many, each with its runs; row 0 stays, and those that stay
// are spread evenly.
void a_trail_is_thinned_out() {
    for (const std::ptrdiff_t runs_of_a_row : {1, 3}) {
        const auto count = static_cast<std::size_t>(runs_of_a_row);
        Trail trail(60);
        for (std::ptrdiff_t row = 0; row < 2000; ++row) {
            trail.note(row, Runs(count, {row, row, {}}));
            std::ptrdiff_t furthest = 0;
            for (std::ptrdiff_t asked = 0; asked <= row; asked += 7) {
                const Trail::Mark& mark = trail.before(asked);
                CHECK(mark.row <= asked);
                CHECK_EQUAL(mark.runs.size(), count);
                CHECK_EQUAL(mark.runs[0].first, mark.row);
                furthest = std::max(furthest, asked - mark.row);
            }
            CHECK(furthest < 8 + 2 * (row + 8) * runs_of_a_row / 60);
        }
        trail.forget_from(1);
        CHECK_EQUAL(trail.before(1999).row, 0);
    }
}

}  // namespace

int main() {
    return check::run({{"corridors that part", corridors_that_part},
                       {"peaks and pits", peaks_and_pits},
                       {"bottlenecks of the last row", bottlenecks_of_the_last_row},
                       {"zigzags", zigzags},
                       {"walks from both ends", walks_from_both_ends},
                       {"noise", noise},
                       {"a trail is thinned out", a_trail_is_thinned_out}});
}
