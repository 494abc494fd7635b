// The discrete Fréchet distance against all couplings, one by one; its paths, its table, its
// range and its messages.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "all_paths.hpp"
#include "check.hpp"
#include "curves.hpp"
#include "curvewise/frechet.hpp"
#include "oracle.hpp"

namespace {

using curvewise::Alignment;
using curvewise::frechet;
using curvewise::frechet_path;
using curvewise::frechet_table;
using curvewise::FrechetOptions;
using curvewise::Metric;
using oracle::Path;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> table_of(const Curve& P, const Curve& Q, const FrechetOptions& options = {}) {
    std::vector<double> table(static_cast<std::size_t>(P.size() * Q.size()));
    frechet_table(P, Q, table.data(), options);
    return table;
}

void values_by_hand() {
    const Curve P{{0.0}, {1.0}, {2.0}}, Q{{0.0}, {2.0}};
    CHECK_EQUAL(frechet(P, Q), 1.0);
    CHECK_EQUAL(frechet_path(P, Q).path, (Path{{0, 0}, {1, 0}, {2, 1}}));
    CHECK_EQUAL(table_of(P, Q), (std::vector<double>{0, 2, 1, 1, 2, 1}));

    const Curve R{{0.0, 0.0}}, S{{3.0, 4.0}, {0.0, 1.0}};
    CHECK_EQUAL(frechet(R, S), 5.0);
    CHECK_EQUAL(frechet(R, S, {{Metric::sqeuclidean}}), 25.0);
    CHECK_EQUAL(frechet(R, S, {{Metric::cityblock}}), 7.0);
    CHECK_EQUAL(frechet(R, S, {{Metric::chebyshev}}), 4.0);
    CHECK_CLOSE(frechet(R, S, {{Metric::minkowski, 3.0}}), std::cbrt(91.0), 1e-14);
}

// A pair on which stopping at the first row without a reachable cell goes wrong (5.099).
void path_behind_a_dead_cell() {
    const Curve P{{2.0, 5.0}, {3.0, 3.0}, {4.0, 3.0}, {5.0, 4.0}, {0.0, 0.0}, {3.0, 4.0}};
    const Curve Q{{0.0, 4.0}, {4.0, 4.0}, {5.0, 1.0}};
    CHECK_EQUAL(frechet(P, Q), 5.0);
    CHECK_EQUAL(frechet(Q, P), 5.0);
}

void check_against_all_couplings(const Curve& P, const Curve& Q) {
    const check::Note note(test::described(P, Q));
    for (const Metric metric : oracle::metrics) {
        const FrechetOptions options{{metric, 2.5}};
        oracle::Rules rules;
        rules.ground = options.ground;
        rules.largest = true;
        oracle::check_against_all_paths(P, Q, rules, frechet(P, Q, options),
                                        frechet_path(P, Q, options));
    }
}

void smallest_of_all_couplings() { oracle::for_short_pairs(21, check_against_all_couplings); }

// Among equal predecessors: diagonal, then (i-1, j), then (i, j-1).
void ties_in_a_path() {
    const Curve two{{1.0}, {1.0}}, four{{1.0}, {1.0}, {1.0}, {1.0}};
    CHECK_EQUAL(frechet_path(four, two).path, (Path{{0, 0}, {1, 0}, {2, 0}, {3, 1}}));
    CHECK_EQUAL(frechet_path(two, four).path, (Path{{0, 0}, {0, 1}, {0, 2}, {1, 3}}));
    // Past either side of the far pair (1, 1).
    const Curve P{{0.0}, {-1.0}, {0.0}}, Q{{0.0}, {1.0}, {0.0}};
    CHECK_EQUAL(table_of(P, Q), (std::vector<double>{0, 1, 1, 1, 2, 1, 1, 1, 1}));
    CHECK_EQUAL(frechet_path(P, Q).path, (Path{{0, 0}, {0, 1}, {1, 2}, {2, 2}}));
}

// The root is taken once, at the end; that must not show.
void root_of_the_squares() {
    Random random(22);
    const Curve P = random.curve(300, 3), Q = random.curve(77, 3);
    oracle::Rules rules;
    rules.largest = true;
    const Alignment alignment = frechet_path(P, Q);
    CHECK_EQUAL(frechet(P, Q), std::sqrt(frechet(P, Q, {{Metric::sqeuclidean}})));
    CHECK_EQUAL(oracle::path_cost(alignment.path, P, Q, rules), frechet(P, Q));
    std::vector<double> roots = table_of(P, Q, {{Metric::sqeuclidean}});
    for (double& value : roots) value = std::sqrt(value);
    CHECK(table_of(P, Q) == roots);
    CHECK_EQUAL(roots.back(), frechet(P, Q));
}

void symmetry() {
    Random random(23);
    const Curve P = random.curve(70, 4), Q = random.curve(300, 4);
    for (const Metric metric : oracle::metrics) {
        CHECK_EQUAL(frechet(P, Q, {{metric}}), frechet(Q, P, {{metric}}));
        CHECK_EQUAL(frechet(P, P, {{metric}}), 0.0);
    }
}

// Both curves times 2^k: the distance, and the table, times 2^k (2^2k if squared), to the bit.
void magnitudes() {
    Random random(24);
    const Curve P = random.curve(20, 2), Q = random.curve(30, 2);
    for (const int k :
         {-1000, -600, -502, -501, -500, -499, -300, 300, 499, 500, 501, 502, 600, 1000}) {
        const check::Note note("both times 2^" + std::to_string(k));
        const Curve R = P.times_power_of_two(k), S = Q.times_power_of_two(k);
        CHECK_EQUAL(frechet(R, S), std::ldexp(frechet(P, Q), k));
        CHECK_EQUAL(frechet_path(R, S).distance, std::ldexp(frechet(P, Q), k));
        CHECK_EQUAL(frechet_path(R, S).path, frechet_path(P, Q).path);
        CHECK(table_of(R, S) == Curve(table_of(P, Q), 1).times_power_of_two(k).values());
        const FrechetOptions squared{{Metric::sqeuclidean}};
        CHECK_EQUAL(frechet(R, S, squared), std::ldexp(frechet(P, Q, squared), 2 * k));
    }
    const double tiny = std::numeric_limits<double>::denorm_min();
    CHECK_EQUAL(frechet(Curve{{0.0, 0.0}}, Curve{{3 * tiny, 4 * tiny}}), 5 * tiny);
    CHECK_EQUAL(frechet(Curve{{1.7e308}}, Curve{{-1.7e308}}), infinity);
    CHECK_CLOSE(frechet(Curve{{3e307, -1e308}}, Curve{{0.0, -1.4e308}}), 5e307, 1e-15);
}

// The first points decide. So an early row of the table has no smaller values, and its last value,
// far from the end of P, is not the answer. The table of the Euclidean distance holds squares. The
// square of the cutoff may be rounded to below the square of the distance.
void a_cutoff_that_is_the_distance() {
    Random random(25);
    for (int round = 0; round < 40; ++round) {
        Curve P(std::vector<double>(600), 2), Q(std::vector<double>(40), 2);
        for (std::ptrdiff_t i = 0; i < P.size(); ++i) P(i, 0) = 0.1 * static_cast<double>(i);
        for (std::ptrdiff_t j = 0; j < Q.size(); ++j) Q(j, 0) = 1.5 * static_cast<double>(j);
        P(0, 0) = -random.uniform(5.0, 8.0);
        P(0, 1) = random.uniform(2.0, 5.0);
        FrechetOptions options;
        options.ground.metric = round % 4 == 0 ? Metric::cityblock : Metric::euclidean;
        options.cutoff = frechet(P, Q, options);
        CHECK_EQUAL(options.cutoff, frechet(P.part(0, 1), Q.part(0, 1), {options.ground}));
        CHECK_EQUAL(frechet(P, Q, options), options.cutoff);
        options.cutoff = std::nextafter(options.cutoff, 0.0);
        CHECK_EQUAL(frechet(P, Q, options), infinity);
    }
}

void messages() {
    const Curve P{{0.0, 0.0}, {1.0, 1.0}}, none({}, 2);
    const auto refuses = [](const Curve& A, const Curve& B, const FrechetOptions& options,
                            const std::string& message) {
        std::vector<double> table(16);
        CHECK_THROWS(frechet(A, B, options), std::invalid_argument, message);
        CHECK_THROWS(frechet_path(A, B, options), std::invalid_argument, message);
        CHECK_THROWS(frechet_table(A, B, table.data(), options), std::invalid_argument, message);
    };
    refuses(none, P, {}, "P has shape (0, 2); frechet needs at least 1 point");
    refuses(P, none, {}, "Q has shape (0, 2); frechet needs at least 1 point");
    refuses(P, {{0.0}}, {},
            "P has shape (2, 2) and Q has shape (1, 1); both need the same number of coordinates");
    refuses(P, {{0.0, 0.0}, {0.0, infinity}}, {}, "Q[1, 1] is inf; curves must be finite");
    refuses(none, P, {{Metric::minkowski, 0.25}}, "p is 0.25; minkowski needs 1 <= p <= inf");
    CHECK_EQUAL(frechet(P, P, {{Metric::minkowski, infinity}}), 0.0);
    CHECK_THROWS(frechet(P, curvewise::CurveView(nullptr, 5, 0)), std::invalid_argument,
                 "Q has shape (5, 0); a curve needs at least 1 coordinate");
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"path behind a dead cell", path_behind_a_dead_cell},
                       {"smallest of all couplings", smallest_of_all_couplings},
                       {"ties in a path", ties_in_a_path},
                       {"root of the squares", root_of_the_squares},
                       {"symmetry", symmetry},
                       {"magnitudes", magnitudes},
                       {"a cutoff that is the distance", a_cutoff_that_is_the_distance},
                       {"messages", messages}});
}
