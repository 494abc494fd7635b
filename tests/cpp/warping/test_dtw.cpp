// DTW against all warping paths, one by one; its paths, its table, its range and its messages.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "all_paths.hpp"
#include "check.hpp"
#include "curves.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "hard_curves.hpp"
#include "oracle.hpp"

namespace {

using curvewise::Alignment;
using curvewise::dtw;
using curvewise::dtw_path;
using curvewise::dtw_table;
using curvewise::DtwOptions;
using curvewise::Metric;
using curvewise::StepPattern;
using oracle::Path;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

DtwOptions with_metric(Metric metric, double p = 2.0) {
    DtwOptions options;
    options.ground = {metric, p};
    return options;
}

DtwOptions with_window(std::ptrdiff_t window) {
    DtwOptions options;
    options.window = window;
    return options;
}

DtwOptions with_fraction(double fraction) {
    DtwOptions options;
    options.window_fraction = fraction;
    return options;
}

DtwOptions with_open_ends(bool open_begin, bool open_end) {
    DtwOptions options;
    options.open_begin = open_begin;
    options.open_end = open_end;
    return options;
}

DtwOptions symmetric2() {
    DtwOptions options;
    options.step_pattern = StepPattern::symmetric2;
    return options;
}

oracle::Rules rules_of(const DtwOptions& options) {
    return {options.ground,
            false,
            options.step_pattern == StepPattern::symmetric2 ? 2.0 : 1.0,
            options.window,
            options.open_begin,
            options.open_end};
}

std::vector<double> table_of(const Curve& P, const Curve& Q, const DtwOptions& options) {
    std::vector<double> table(static_cast<std::size_t>(P.size() * Q.size()));
    dtw_table(P, Q, table.data(), options);
    return table;
}

void values_by_hand() {
    const Curve P{{0.0}, {1.0}, {2.0}}, Q{{0.0}, {2.0}};
    CHECK_EQUAL(dtw(P, Q), 1.0);
    CHECK_EQUAL(dtw_path(P, Q).path, (Path{{0, 0}, {1, 0}, {2, 1}}));
    CHECK_EQUAL(table_of(P, Q, {}), (std::vector<double>{0, 2, 1, 1, 3, 1}));
    CHECK_EQUAL(table_of(P, Q, symmetric2()), (std::vector<double>{0, 2, 1, 2, 3, 1}));

    const Curve R{{0.0, 0.0}}, S{{3.0, 4.0}, {0.0, 1.0}};
    CHECK_EQUAL(dtw(R, S), 6.0);
    CHECK_EQUAL(dtw(R, S, symmetric2()), 6.0);
    CHECK_EQUAL(dtw(R, S, with_metric(Metric::sqeuclidean)), 26.0);
    CHECK_EQUAL(dtw(R, S, with_metric(Metric::cityblock)), 8.0);
    CHECK_EQUAL(dtw(R, S, with_metric(Metric::chebyshev)), 5.0);
    CHECK_CLOSE(dtw(R, S, with_metric(Metric::minkowski, 3.0)), std::cbrt(91.0) + 1.0, 1e-14);
    CHECK_EQUAL(dtw(R, R), 0.0);
}

void check_against_all_paths(const Curve& P, const Curve& Q, const DtwOptions& options) {
    oracle::check_against_all_paths(P, Q, rules_of(options), dtw(P, Q, options),
                                    dtw_path(P, Q, options));
}

void check_all_options(const Curve& P, const Curve& Q) {
    const check::Note note(test::described(P, Q));
    for (const Metric metric : oracle::metrics) {
        for (const StepPattern step_pattern : {StepPattern::symmetric1, StepPattern::symmetric2}) {
            DtwOptions options = with_metric(metric, 2.5);
            options.step_pattern = step_pattern;
            check_against_all_paths(P, Q, options);
            options.window = P.size() == Q.size() ? 0 : 1;
            check_against_all_paths(P, Q, options);
            options.window = 2;
            check_against_all_paths(P, Q, options);
        }
        for (const auto& [open_begin, open_end] :
             {std::pair(true, false), {false, true}, {true, true}}) {
            DtwOptions options = with_open_ends(open_begin, open_end);
            options.ground = {metric, 2.5};
            check_against_all_paths(P, Q, options);
        }
    }
}

void smallest_of_all_paths() { oracle::for_short_pairs(11, check_all_options); }

// Among equal predecessors: diagonal, then (i-1, j), then (i, j-1).
void ties_in_a_path() {
    const Curve two{{1.0}, {1.0}}, four{{1.0}, {1.0}, {1.0}, {1.0}};
    CHECK_EQUAL(dtw_path(four, two).path, (Path{{0, 0}, {1, 0}, {2, 0}, {3, 1}}));
    CHECK_EQUAL(dtw_path(two, four).path, (Path{{0, 0}, {0, 1}, {0, 2}, {1, 3}}));
    // The diagonal, at twice 1, costs as much as either way round the corner.
    const Curve ones{{1.0}, {1.0}}, zeros{{0.0}, {0.0}};
    CHECK_EQUAL(dtw(ones, zeros, symmetric2()), 3.0);
    CHECK_EQUAL(dtw_path(ones, zeros, symmetric2()).path, (Path{{0, 0}, {1, 1}}));
    // The diagonal is dearer, both ways round cost the same.
    const Curve falling{{0.0}, {-1.0}}, rising{{0.0}, {1.0}};
    CHECK_EQUAL(dtw(falling, rising, symmetric2()), 3.0);
    CHECK_EQUAL(dtw_path(falling, rising, symmetric2()).path, (Path{{0, 0}, {0, 1}, {1, 1}}));
}

void open_ends() {
    const Curve P{{5.0}, {6.0}}, Q{{0.0}, {5.0}, {6.0}, {0.0}, {5.0}, {6.0}, {0.0}};
    const Alignment both = dtw_path(P, Q, with_open_ends(true, true));
    CHECK_EQUAL(both.distance, 0.0);
    CHECK_EQUAL(both.path, (Path{{0, 1}, {1, 2}}));  // the first of two equally good ends
    const Alignment end = dtw_path(P, Q, with_open_ends(false, true));
    CHECK_EQUAL(end.distance, 5.0);
    CHECK_EQUAL(end.path.front(), (std::array<std::int64_t, 2>{0, 0}));
    CHECK_EQUAL(end.path.back(), (std::array<std::int64_t, 2>{1, 2}));
    const Alignment begin = dtw_path(P, Q, with_open_ends(true, false));
    CHECK_EQUAL(begin.distance, 6.0);
    CHECK_EQUAL(begin.path, (Path{{0, 4}, {1, 5}, {1, 6}}));
    // The table's first row is the ground distance alone, and open_end changes nothing.
    const std::vector<double> table = table_of(P, Q, with_open_ends(true, false));
    CHECK_EQUAL(std::vector<double>(table.begin(), table.begin() + 7),
                (std::vector<double>{5, 0, 1, 5, 0, 1, 5}));
    CHECK_EQUAL(table_of(P, Q, with_open_ends(true, true)), table);
}

void windows() {
    Random random(12);
    const Curve P = random.curve(6, 2), Q = random.curve(6, 2), R = random.curve(1, 2);
    double along_diagonal = 0.0;
    for (std::ptrdiff_t i = 0; i < 6; ++i) {
        along_diagonal += oracle::ground_distance({}, P, i, Q, i);
    }
    CHECK_EQUAL(dtw(P, Q, with_window(0)), along_diagonal);
    CHECK_EQUAL(dtw(P, Q, with_window(5)), dtw(P, Q));
    CHECK_EQUAL(dtw(P, Q, with_window(std::numeric_limits<std::ptrdiff_t>::max())), dtw(P, Q));
    CHECK_EQUAL(dtw(P, R, with_window(0)), dtw(P, R));
    CHECK_EQUAL(dtw(R, P, with_window(0)), dtw(R, P));
    const std::vector<double> table = table_of(P, Q, with_window(1));
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            const bool inside = i <= j + 1 && j <= i + 1;
            CHECK_EQUAL(table[i * 6 + j] < infinity, inside);
        }
    }
}

void fractions_and_distances_per_step() {
    const Curve P{{0.0}, {4.0}, {1.0}, {5.0}, {2.0}, {0.0}, {3.0}},
        Q{{1.0}, {3.0}, {1.0}, {4.0}, {0.0}};
    CHECK_EQUAL(dtw(P, Q, with_fraction(0.3)), dtw(P, Q, with_window(2)));  // of 7 points
    CHECK_EQUAL(dtw(Q, P, with_fraction(0.3)), dtw(Q, P, with_window(2)));
    CHECK_EQUAL(dtw(P, P, with_fraction(0.01)), 0.0);
    DtwOptions per_step = symmetric2();
    per_step.normalize = true;
    CHECK_EQUAL(dtw(P, Q, per_step), dtw(P, Q, symmetric2()) / 12.0);
    // Paths and tables are those of the distance that is not divided.
    CHECK_EQUAL(dtw_path(P, Q, per_step).distance, dtw_path(P, Q, symmetric2()).distance);
    CHECK_EQUAL(table_of(P, Q, per_step), table_of(P, Q, symmetric2()));
    per_step.cutoff = dtw(P, Q, per_step);
    CHECK_EQUAL(dtw(P, Q, per_step), per_step.cutoff);
    per_step.cutoff = std::nextafter(per_step.cutoff, 0.0);
    CHECK_EQUAL(dtw(P, Q, per_step), infinity);
    // A quotient that is rounded to 0 is not above 0.
    const Curve zero{{0.0}, {2.0}}, tiny{{5e-324}, {2.0}};
    per_step.cutoff = 0.0;
    CHECK_EQUAL(dtw(zero, tiny, per_step), 0.0);
}

void symmetry() {
    Random random(13);
    const Curve P = random.curve(70, 3), Q = random.curve(300, 3);
    for (DtwOptions options : {DtwOptions{}, symmetric2(), with_window(10)}) {
        CHECK_EQUAL(dtw(P, Q, options), dtw(Q, P, options));
        CHECK_EQUAL(dtw(P, P, options), 0.0);
        CHECK_EQUAL(table_of(P, Q, options).back(), dtw(P, Q, options));
    }
}

// Both curves times 2^k: the distance, and the table, times 2^k (2^2k if squared), to the bit.
void magnitudes() {
    Random random(14);
    const Curve P = random.curve(20, 2), Q = random.curve(30, 2);
    for (const int k :
         {-1000, -600, -502, -501, -500, -499, -300, 300, 499, 500, 501, 502, 600, 1000}) {
        const check::Note note("both times 2^" + std::to_string(k));
        const Curve R = P.times_power_of_two(k), S = Q.times_power_of_two(k);
        CHECK_EQUAL(dtw(R, S), std::ldexp(dtw(P, Q), k));
        CHECK_EQUAL(dtw_path(R, S).distance, std::ldexp(dtw(P, Q), k));
        CHECK_EQUAL(dtw_path(R, S).path, dtw_path(P, Q).path);
        CHECK_EQUAL(table_of(R, S, {}),
                    Curve(table_of(P, Q, {}), 1).times_power_of_two(k).values());
        CHECK_EQUAL(table_of(R, S, with_window(2)),
                    Curve(table_of(P, Q, with_window(2)), 1).times_power_of_two(k).values());
        const DtwOptions cubes = with_metric(Metric::minkowski, 3.0);
        CHECK_CLOSE(dtw(R, S, cubes), std::ldexp(dtw(P, Q, cubes), k), 1e-12);
        const DtwOptions squared = with_metric(Metric::sqeuclidean);
        CHECK_EQUAL(dtw(R, S, squared), std::ldexp(dtw(P, Q, squared), 2 * k));
    }
    const double tiny = std::numeric_limits<double>::denorm_min();
    CHECK_EQUAL(dtw(Curve{{0.0, 0.0}}, Curve{{3 * tiny, 4 * tiny}}), 5 * tiny);
    CHECK_EQUAL(dtw(Curve{{1.7e308}}, Curve{{-1.7e308}}), infinity);
    CHECK_CLOSE(dtw(Curve{{3e307, -1e308}}, Curve{{0.0, -1.4e308}}), 5e307, 1e-15);
}

// If both curves are multiplied by 2^k, every ground distance is multiplied by a power of it.
// Tested for curves within the usual range and beyond it, where curves are scaled.
void degrees() {
    Random random(15);
    const Curve P = random.curve(20, 2), Q = random.curve(30, 2);
    for (const Metric metric : oracle::metrics) {
        const check::Note note(oracle::name(metric));
        const DtwOptions options = with_metric(metric, 3.0);
        const curvewise::FrechetOptions largest{options.ground};
        for (const int k : {-510, -501, -1, 1, 501, 510}) {
            const check::Note scaled("both times 2^" + std::to_string(k));
            const Curve R = P.times_power_of_two(k), S = Q.times_power_of_two(k);
            const int exponent = k * oracle::degree(metric);
            CHECK_CLOSE(dtw(R, S, options), std::ldexp(dtw(P, Q, options), exponent), 1e-12);
            CHECK_CLOSE(frechet(R, S, largest), std::ldexp(frechet(P, Q, largest), exponent),
                        1e-12);
        }
    }
}

// Tables that are large enough for pruning, of similar curves.
void pruning_changes_nothing() {
    Random random(16);
    const Curve P = test::loops(1300, 2, 2.0, 0.0, true), Q = test::alike(P, 1200, random);
    for (const Metric metric : oracle::metrics) {
        const check::Note note(oracle::name(metric));
        DtwOptions options = with_metric(metric, 3.0);
        curvewise::FrechetOptions largest{options.ground};
        const double sum = dtw(P, Q, options), most = frechet(P, Q, largest);
        const Path path = dtw_path(P, Q, options).path;
        options.prune = largest.prune = false;
        CHECK_EQUAL(sum, dtw(P, Q, options));
        CHECK_EQUAL(path, dtw_path(P, Q, options).path);
        CHECK_EQUAL(most, frechet(P, Q, largest));
    }
}

void messages_about_options() {
    const Curve P{{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}}, Q{{0.0, 0.0}, {1.0, 1.0}};
    const auto refuses = [&](const DtwOptions& options, const std::string& message) {
        std::vector<double> table(6);
        CHECK_THROWS(dtw(P, Q, options), std::invalid_argument, message);
        CHECK_THROWS(dtw_path(P, Q, options), std::invalid_argument, message);
        CHECK_THROWS(dtw_table(P, Q, table.data(), options), std::invalid_argument, message);
    };
    refuses(with_metric(Metric::minkowski, 0.5), "p is 0.5; minkowski needs 1 <= p <= inf");
    refuses(with_metric(Metric::minkowski, -infinity), "p is -inf; minkowski needs 1 <= p <= inf");
    refuses(with_metric(Metric::minkowski, std::nan("")),
            "p is nan; minkowski needs 1 <= p <= inf");
    CHECK_EQUAL(dtw(P, Q, with_metric(Metric::euclidean, 0.5)), dtw(P, Q));
    refuses(with_window(-1),
            "window is -1; give a whole number >= 0, a fraction between 0 and 1, or None");
    refuses(with_window(0), "window=0 admits no path between 3 and 2 points; use at least 1");
    DtwOptions options = with_open_ends(true, false);
    options.window = 3;
    refuses(options, "open_begin and open_end cannot be combined with window");
    options = with_open_ends(false, true);
    options.step_pattern = StepPattern::typeIa;
    refuses(options,
            "open_end needs step_pattern='symmetric1' without a penalty, or a step pattern whose "
            "paths all have one weight, such as 'symmetric2' or 'asymmetric'; those of typeIa "
            "differ");
    options = with_open_ends(true, true);
    options.step_pattern = StepPattern::symmetric2;
    refuses(options,
            "open_begin needs step_pattern='symmetric1' without a penalty, or a step pattern "
            "normalised by N, such as 'asymmetric'; symmetric2 is not");
    for (const double fraction : {0.0, 1.0, -0.5, std::nan("")}) {
        refuses(with_fraction(fraction),
                "window is " + std::to_string(fraction) +
                    "; give a whole number >= 0, a fraction between 0 and 1, or None");
    }
    refuses(with_fraction(0.3), "window=0 admits no path between 3 and 2 points; use at least 1");
    options = with_fraction(0.5);
    options.window = 1;
    refuses(options, "window and window_fraction are both given; give one of them");
    options = with_open_ends(true, false);
    options.window_fraction = 0.5;
    refuses(options, "open_begin and open_end cannot be combined with window");
    options = DtwOptions{};
    options.normalize = true;
    refuses(options,
            "normalize needs step_pattern='symmetric2', whose paths all have the weight n + m");
}

void messages_about_curves() {
    const Curve P{{0.0, 0.0}, {1.0, 1.0}}, none({}, 2);
    const curvewise::CurveView no_columns(nullptr, 5, 0);
    CHECK_THROWS(dtw(none, P), std::invalid_argument,
                 "P has shape (0, 2); dtw needs at least 1 point");
    CHECK_THROWS(dtw_path(P, none), std::invalid_argument,
                 "Q has shape (0, 2); dtw needs at least 1 point");
    CHECK_THROWS(dtw(P, no_columns), std::invalid_argument,
                 "Q has shape (5, 0); a curve needs at least 1 coordinate");
    CHECK_THROWS(
        dtw(P, Curve{{1.0, 2.0, 3.0}}), std::invalid_argument,
        "P has shape (2, 2) and Q has shape (1, 3); both need the same number of coordinates");
    CHECK_THROWS(dtw(P, Curve{{0.0, 1.0}, {2.0, std::nan("")}, {infinity, 0.0}}),
                 std::invalid_argument, "Q[1, 1] is nan; curves must be finite");
    // Options are checked before curves, and P before Q.
    const Curve bad{{-infinity, 0.0}};
    CHECK_THROWS(dtw(bad, Curve{{std::nan(""), 0.0}}), std::invalid_argument,
                 "P[0, 0] is -inf; curves must be finite");
    CHECK_THROWS(dtw(bad, P, with_window(-2)), std::invalid_argument,
                 "window is -2; give a whole number >= 0, a fraction between 0 and 1, or None");
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"smallest of all paths", smallest_of_all_paths},
                       {"ties in a path", ties_in_a_path},
                       {"open ends", open_ends},
                       {"windows", windows},
                       {"fractions and distances per step", fractions_and_distances_per_step},
                       {"symmetry", symmetry},
                       {"magnitudes", magnitudes},
                       {"degrees", degrees},
                       {"pruning changes nothing", pruning_changes_nothing},
                       {"messages about options", messages_about_options},
                       {"messages about curves", messages_about_curves}});
}
