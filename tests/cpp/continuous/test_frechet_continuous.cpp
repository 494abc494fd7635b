// The continuous Fréchet distance against known results: values by hand, and the discrete distance
// of finely divided curves. Changes that keep the real number must give bitwise identical results.
// Also decisions; matchings; the range of doubles; messages.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "check.hpp"
#include "continuous/exact_signs.hpp"
#include "curves.hpp"
#include "curvewise/control.hpp"
#include "curvewise/frechet.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "curvewise/pairwise.hpp"

namespace {

using curvewise::frechet;
using curvewise::frechet_continuous;
using curvewise::frechet_continuous_bounds;
using curvewise::frechet_continuous_part;
using curvewise::frechet_continuous_path;
using curvewise::frechet_within;
using curvewise::Interval;
using curvewise::Matching;
using curvewise::continuous::ExactSigns;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

double below(double x) { return std::nextafter(x, 0.0); }

void values_by_hand() {
    // Those who forget that walks never turn back say 0.
    const Curve straight{{0.0, 0.0}, {10.0, 0.0}};
    const Curve back_and_forth{{0.0, 0.0}, {7.0, 0.0}, {3.0, 0.0}, {10.0, 0.0}};
    CHECK_EQUAL(frechet_continuous(straight, back_and_forth), 2.0);
    CHECK_EQUAL(frechet_continuous_bounds(straight, back_and_forth).low, 2.0);
    CHECK_EQUAL(frechet_continuous(straight, Curve{{0.0, 3.0}, {10.0, 4.0}}), 4.0);
    CHECK_EQUAL(frechet_continuous(straight, Curve{{0.0, 0.0}, {5.0, 2.0}, {10.0, 0.0}}), 2.0);
    // One point against many, and against one.
    CHECK_EQUAL(frechet_continuous(Curve{{0.0, 0.0}}, Curve{{3.0, 4.0}, {0.0, 1.0}}), 5.0);
    CHECK_EQUAL(frechet_continuous(Curve{{1.0}}, Curve{{-2.0}}), 3.0);
    // sqrt(2) lies between two doubles.
    const Interval root = frechet_continuous_bounds(Curve{{0.0, 0.0}}, Curve{{1.0, 1.0}});
    CHECK_EQUAL(root.low, 1.4142135623730949);
    CHECK_EQUAL(root.high, 1.4142135623730951);
    // The pair on which another library's discrete distance is wrong.
    const Curve P{{2.0, 5.0}, {3.0, 3.0}, {4.0, 3.0}, {5.0, 4.0}, {0.0, 0.0}, {3.0, 4.0}};
    const Curve Q{{0.0, 4.0}, {4.0, 4.0}, {5.0, 1.0}};
    CHECK(frechet_continuous(P, Q) <= 5.0);
}

Curve reversed(const Curve& curve) {
    Curve result = curve;
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            result(curve.size() - 1 - i, c) = curve(i, c);
        }
    }
    return result;
}

Curve rotated_axes(const Curve& curve) {
    Curve result = curve;
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            result(i, c) = curve(i, (c + 1) % curve.dim());
        }
    }
    return result;
}

// Points added on every edge: exact where coordinates have few bits.
Curve divided(const Curve& curve, std::ptrdiff_t parts) {
    std::vector<double> values;
    for (std::ptrdiff_t i = 0; i + 1 < curve.size(); ++i) {
        for (std::ptrdiff_t k = 0; k < parts; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(parts);
            for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
                values.push_back((1.0 - t) * curve(i, c) + t * curve(i + 1, c));
            }
        }
    }
    for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) values.push_back(curve(curve.size() - 1, c));
    return {values, curve.dim()};
}

Curve moved(const Curve& curve, double by) {
    Curve result = curve;
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) result(i, c) += by;
    }
    return result;
}

double longest_edge(const Curve& curve) {
    double longest = 0.0;
    for (std::ptrdiff_t i = 0; i + 1 < curve.size(); ++i) {
        longest = std::max(longest, frechet(curve.part(i, i + 1), curve.part(i + 1, i + 2)));
    }
    return longest;
}

void check_what_changes_nothing(const Curve& P, const Curve& Q) {
    const double value = frechet_continuous(P, Q);
    CHECK_EQUAL(frechet_continuous(Q, P), value);
    CHECK_EQUAL(frechet_continuous(reversed(P), reversed(Q)), value);
    CHECK_EQUAL(frechet_continuous(rotated_axes(P), rotated_axes(Q)), value);
    for (const int exponent : {-900, -40, 3, 900}) {
        CHECK_EQUAL(
            frechet_continuous(P.times_power_of_two(exponent), Q.times_power_of_two(exponent)),
            std::ldexp(value, exponent));
    }
}

void check_decisions(const Curve& P, const Curve& Q) {
    const Interval bounds = frechet_continuous_bounds(P, Q);
    CHECK_EQUAL(bounds.high, frechet_continuous(P, Q));
    CHECK(bounds.low == bounds.high || bounds.low == below(bounds.high));
    CHECK(frechet_within(P, Q, bounds.high));
    if (bounds.high > 0.0) CHECK(!frechet_within(P, Q, below(bounds.high)));
    CHECK_EQUAL(frechet_within(P, Q, bounds.low), bounds.low == bounds.high);
    // The discrete distance is rounded to the nearest double.
    const double discrete = frechet(P, Q);
    CHECK(frechet_within(P, Q, std::nextafter(discrete, infinity), false));
    if (discrete > 0.0) CHECK(!frechet_within(P, Q, below(discrete), false));
}

void check_bounds_by_the_discrete_distance(const Curve& P, const Curve& Q) {
    constexpr double rounding = 1.0 + 1e-14;
    const double value = frechet_continuous(P, Q);
    for (const std::ptrdiff_t parts : {1, 64}) {
        const Curve p = divided(P, parts), q = divided(Q, parts);
        const double discrete = frechet(p, q);
        CHECK(value <= discrete * rounding);
        const double least = discrete - std::max(longest_edge(p), longest_edge(q));
        CHECK(value >= least - 1e-14 * discrete);
    }
}

// Whether `leash` is not shorter than the distance of a row, as real numbers.
bool is_held(const Curve& P, const Curve& Q, const std::array<double, 2>& row, double leash) {
    const bool is_at_first = row[0] == std::floor(row[0]);
    const Curve& edges = is_at_first ? Q : P;
    const double at = row[is_at_first ? 1 : 0];
    // A single point is an edge of no length.
    const auto last = std::max(edges.size() - 2, std::ptrdiff_t{0});
    const auto edge = std::min(static_cast<std::ptrdiff_t>(at), last);
    const auto vertex = static_cast<std::ptrdiff_t>(row[is_at_first ? 0 : 1]);
    return ExactSigns(edges, is_at_first ? P : Q)
               .distance_at(edge, at - static_cast<double>(edge), {vertex, leash}) <= 0;
}

void check_matching(const Curve& P, const Curve& Q) {
    const double value = frechet_continuous(P, Q);
    const Matching found = frechet_continuous_path(P, Q);
    CHECK(found.distance >= value);
    CHECK(found.distance <= value * (1.0 + 1e-13) + 1e-14);
    const std::array<double, 2> first{0.0, 0.0};
    const std::array<double, 2> last{static_cast<double>(P.size() - 1),
                                     static_cast<double>(Q.size() - 1)};
    CHECK(found.parameters.front() == first);
    CHECK(found.parameters.back() == last);
    for (std::size_t k = 0; k < found.parameters.size(); ++k) {
        CHECK(is_held(P, Q, found.parameters[k], found.distance));
        if (k == 0) continue;
        for (std::size_t side = 0; side < 2; ++side) {
            const double from = found.parameters[k - 1][side], to = found.parameters[k][side];
            CHECK(from <= to);
            CHECK(to <= std::floor(from) + 1.0);  // on one edge
        }
    }
}

void random_curves() {
    Random random(15);
    for (int round = 0; round < 300; ++round) {
        const std::ptrdiff_t dim = 1 + random.index(5);
        const std::ptrdiff_t n = 1 + random.index(12), m = 1 + random.index(12);
        const bool lattice = round % 2 == 0;
        const Curve P = lattice ? random.lattice_curve(n, dim) : random.curve(n, dim);
        const Curve Q = lattice ? random.lattice_curve(m, dim) : random.curve(m, dim);
        const check::Note note(test::described(P, Q));
        check_what_changes_nothing(P, Q);
        check_decisions(P, Q);
        check_bounds_by_the_discrete_distance(P, Q);
        check_matching(P, Q);
        if (!lattice) continue;
        const double value = frechet_continuous(P, Q);
        CHECK_EQUAL(frechet_continuous(divided(P, 8), divided(Q, 4)), value);
        CHECK_EQUAL(frechet_continuous(moved(P, 0x1p50), moved(Q, 0x1p50)), value);
        CHECK_EQUAL(frechet_continuous(divided(P, 4), P), 0.0);
    }
}

void longer_curves() {
    Random random(16);
    for (const std::ptrdiff_t n : {60, 200, 701}) {
        const Curve P = random.walk(n);
        Curve Q = P;
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            for (std::ptrdiff_t c = 0; c < 2; ++c) Q(i, c) += random.uniform(-0.3, 0.3);
        }
        const Curve unrelated = random.walk(n - 10);
        const check::Note note(test::described(P, Q));
        for (const Curve& other : {Q, unrelated}) {
            check_what_changes_nothing(P, other);
            check_decisions(P, other);
            check_matching(P, other);
        }
    }
}

// Curves that differ in their last bits. The distance is smaller than the resolution of a
// parameter, and rows must not be moved off a vertex onto another edge of the walk.
void curves_that_nearly_coincide() {
    const Curve P{{-0.0453304722905159, 0.030887983553111564},
                  {-0.065635706065222621, 0.10309095648117364},
                  {-0.12647633603774011, 0.123799983644858},
                  {-0.15875420854426919, 0.088189668115228409},
                  {-0.25818692198954524, 0.044781448645517224}};
    const Curve Q{{-0.0453304722905159, 0.030887983553111568},
                  {-0.065635706065222607, 0.10309095648117364},
                  {-0.12647633603774014, 0.12379998364485802},
                  {-0.15875420854426919, 0.088189668115228409},
                  {-0.25818692198954524, 0.044781448645517224}};
    check_matching(P, Q);
    check_matching(Q, P);
}

// An edge, and the same edge with a computed point on it. No double gives the exact place of that
// point on the edge. If coordinates cancel, the exact distance differs from the distance of rounded
// coordinates.
void points_computed_on_an_edge() {
    Random random(17);
    for (int round = 0; round < 400; ++round) {
        const Curve P = random.curve(2, 1 + random.index(3));
        const double t = random.uniform(0.0, 1.0);
        std::vector<double> points;
        for (const double h : {0.0, t, 1.0}) {
            for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
                points.push_back(P(0, c) + h * (P(1, c) - P(0, c)));
            }
        }
        const Curve Q(points, P.dim());
        const check::Note note(test::described(P, Q));
        check_matching(P, Q);
        check_matching(Q, P);
    }
}

// A search that begins with a window too small ends at the same value.
void a_blind_alley() {
    // Q runs along P, turns aside at one place and leads into a long alley that P has, too.
    std::vector<double> p, q;
    for (int i = 0; i < 400; ++i) {
        p.insert(p.end(), {0.01 * i, 0.0});
        q.insert(q.end(), {0.01 * i, i == 200 ? 0.4 : 0.1});
    }
    for (int i = 400; i-- > 0;) {
        p.insert(p.end(), {0.01 * i, 0.05});
        q.insert(q.end(), {0.01 * i, 0.12});
    }
    const Curve P(p, 2), Q(q, 2);
    check_what_changes_nothing(P, Q);
    check_decisions(P, Q);
    check_matching(P, Q);
}

// Curves whose free space has rooms, one for each pair of runs of equal points. The squared
// distances between the runs are d^2 / 2 and a constant, for a table of d. A third of the rooms are
// walls. Some rooms open at nearly the same radius, so that the first opening is often a dead end,
// or a way that begins elsewhere.
void rooms(std::uint64_t seed) {
    Random random(seed);
    const std::ptrdiff_t height = 4 + random.index(6), width = 3 + random.index(5);
    std::vector<double> table;
    for (std::ptrdiff_t k = 0; k < height * width; ++k) {
        const std::ptrdiff_t kind = random.index(10);
        table.push_back(kind < 5 ? 0.0 : kind < 7 ? 1.0 + 1e-5 * double(random.index(10)) : 3.0);
    }
    table.front() = table.back() = 0.0;
    const auto square = [&](std::ptrdiff_t a, std::ptrdiff_t b) {
        const double d = table[static_cast<std::size_t>(a * width + b)];
        return d * d;
    };
    const std::ptrdiff_t dim = height * width + 2;
    // A run of points whose coordinates of their row, or column, are half of the table's, and whose
    // last ones make all of the same length.
    const auto add_run = [&](std::vector<double>& curve, bool is_row, std::ptrdiff_t line,
                             std::ptrdiff_t count) {
        std::vector<double> point(static_cast<std::size_t>(dim), 0.0);
        double sum = 0.0;
        for (std::ptrdiff_t k = 0; k < (is_row ? width : height); ++k) {
            const std::ptrdiff_t a = is_row ? line : k, b = is_row ? k : line;
            sum += square(a, b);
            point[static_cast<std::size_t>(a * width + b)] =
                (is_row ? 0.5 : -0.5) * std::sqrt(square(a, b));
        }
        const double most = 9.0 * double(std::max(height, width));
        point[static_cast<std::size_t>(dim - (is_row ? 2 : 1))] = 0.5 * std::sqrt(most - sum);
        for (; count > 0; --count) curve.insert(curve.end(), point.begin(), point.end());
    };
    std::vector<double> p, q;
    for (std::ptrdiff_t a = 0; a < height; ++a) add_run(p, true, a, 4 + random.index(20));
    for (std::ptrdiff_t b = 0; b < width; ++b) add_run(q, false, b, 1 + random.index(20));
    const Curve P(p, dim), Q(q, dim);
    check_decisions(P, Q);
    check_decisions(Q, P);
}

// With the first of these seeds the search begins in a blind alley whose way out lies before the
// stretch of rows that it looks at.
void rooms_and_blind_alleys() {
    for (const std::uint64_t seed : {4684U, 1U, 2U, 3U}) {
        const check::Note note("seed " + std::to_string(seed));
        rooms(seed);
    }
}

void ends_of_the_range() {
    const Curve P{{0.0, 0.0}, {1.0, 0.0}}, Q{{0.0, 0.5}, {1.0, 0.25}};
    for (const int exponent : {-1070, -1000, 1000, 1022}) {
        CHECK_EQUAL(
            frechet_continuous(P.times_power_of_two(exponent), Q.times_power_of_two(exponent)),
            std::ldexp(0.5, exponent));
    }
    const double tiny = 5e-324, huge = 1e300;
    CHECK_EQUAL(frechet_continuous(Curve{{0.0}, {tiny}}, Curve{{tiny}, {tiny}}), tiny);
    CHECK_EQUAL(frechet_continuous(Curve{{0.0}, {tiny}}, Curve{{0.0}, {0.0}, {tiny}}), 0.0);
    // Tiny coordinates count next to huge ones.
    const Curve R{{huge, 0.0}, {-huge, 0.0}}, S{{huge, 1e-300}, {-huge, 1e-300}};
    CHECK_EQUAL(frechet_continuous(R, S), 1e-300);
    CHECK_EQUAL(frechet_continuous(Curve{{-1.7e308}}, Curve{{1.7e308}}), infinity);
    CHECK(!frechet_within(Curve{{-1.7e308}}, Curve{{1.7e308}}, 1.7e308));
    CHECK(frechet_within(Curve{{-1.7e308}}, Curve{{1.7e308}}, infinity));
    const std::vector<double> equal(2000, 0.75);
    CHECK_EQUAL(frechet_continuous(Curve(equal, 2), Curve({0.75, 0.0}, 2)), 0.75);
    CHECK_EQUAL(frechet_continuous(Curve(equal, 2), Curve(equal, 2)), 0.0);
}

void batches() {
    Random random(17);
    std::vector<Curve> curves;
    for (int k = 0; k < 7; ++k) curves.push_back(random.curve(5 + 3 * k, 2));
    const std::vector<curvewise::CurveView> views(curves.begin(), curves.end());
    for (const double cutoff : {infinity, 1.2}) {
        std::vector<double> out(49);
        curvewise::cdist(views, curvewise::FrechetContinuousOptions{}, out.data(), {2, cutoff});
        for (std::size_t i = 0; i < 7; ++i) {
            for (std::size_t j = 0; j < 7; ++j) {
                const double value = i == j ? 0.0 : frechet_continuous(views[i], views[j]);
                CHECK_EQUAL(out[7 * i + j], value <= cutoff ? value : infinity);
            }
        }
    }
    const curvewise::Prepared prepared(views[0], curvewise::FrechetContinuousOptions{});
    CHECK_EQUAL(prepared(views[3]), frechet_continuous(views[0], views[3]));
}

void stopping() {
    Random random(18);
    const Curve P = random.curve(3000, 2), Q = random.curve(3000, 2);
    curvewise::Control control([](std::int64_t, std::int64_t) { return false; },
                               std::chrono::milliseconds(1));
    CHECK_THROWS(frechet_continuous(P, Q, {}, &control), curvewise::Stopped,
                 "stopped before the work was done");
}

void messages() {
    const Curve P{{0.0, 0.0}, {1.0, 0.0}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS(frechet_continuous(P, Curve{{0.0, nan}}), std::invalid_argument,
                 "Q[0, 1] is nan; curves must be finite");
    CHECK_THROWS(frechet_continuous(P, Curve{{0.0}}), std::invalid_argument,
                 "P has shape (2, 2) and Q has shape (1, 1); both need the same number of "
                 "coordinates");
    CHECK_THROWS(frechet_continuous(P, P, {0}), std::invalid_argument,
                 "workers is 0; give a whole number >= 1, or -1 for all cores");
    CHECK_THROWS(frechet_within(P, P, -1.0), std::invalid_argument,
                 "distance is -1; give a number >= 0");
    CHECK_THROWS(frechet_within(P, P, nan), std::invalid_argument,
                 "distance is nan; give a number >= 0");
}

// The section of a curve that is nearest to another one.
void sections() {
    const Curve road{{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}};
    const Curve track{{4.0, 1.0}, {9.0, 1.0}, {9.0, 3.0}};
    const Matching found = frechet_continuous_part(track, road);
    CHECK_EQUAL(found.distance, std::sqrt(2.0));
    CHECK_EQUAL(found.parameters.front()[1], 0.4);
    CHECK_EQUAL(found.parameters.back()[1], 1.3);
    CHECK_EQUAL(frechet_continuous_part(Curve{{7.5, 1.0}}, road).distance, 1.0);
    CHECK_EQUAL(frechet_continuous_part(road, Curve{{10.0, 0.0}}).distance, 10.0);
    CHECK_EQUAL(frechet_continuous_part(Curve{{4.0}, {2.0}}, Curve{{0.0}, {8.0}}).distance, 1.0);
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"sections", sections},
                       {"random curves", random_curves},
                       {"longer curves", longer_curves},
                       {"curves that nearly coincide", curves_that_nearly_coincide},
                       {"points computed on an edge", points_computed_on_an_edge},
                       {"a blind alley", a_blind_alley},
                       {"rooms and blind alleys", rooms_and_blind_alleys},
                       {"ends of the range", ends_of_the_range},
                       {"batches", batches},
                       {"stopping", stopping},
                       {"messages", messages}});
}
