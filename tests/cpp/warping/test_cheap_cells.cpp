// The path among cheap cells against the path of the full sweep: value and cells must be identical.
// Tested at every instruction-set level of this machine, with random pairs, similar or not, every
// norm, both step patterns and open ends. `test_cheap_cells 100000` is the long run.
#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "check.hpp"
#include "hard_curves.hpp"
#include "oracle.hpp"
#include "swept_pair.hpp"
#include "warping/cheap_cells.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/path.hpp"

namespace {

using curvewise::GroundDistance;
using curvewise::Metric;
using curvewise::kernels::Rule;
using curvewise::warping::available_levels;
using curvewise::warping::find_path;
using curvewise::warping::find_path_of_cheap_cells;
using curvewise::warping::Level;
using curvewise::warping::Path;
using curvewise::warping::SweepProblem;
using test::Curve;
using test::Random;
using test::SweptPair;

std::ptrdiff_t pairs = 1000;

Metric any_norm(Random& random) {
    Metric metric;
    do {
        metric = oracle::metrics[static_cast<std::size_t>(random.index(oracle::metrics.size()))];
    } while (!curvewise::warping::with_norm(metric, [](auto) { return true; }));
    return metric;
}

void compare(const Curve& P, const Curve& Q, Metric metric, Rule rule, bool open_end) {
    const check::Note note(test::described(P, Q) + ", " + oracle::name(metric) + ", rule " +
                           std::to_string(static_cast<int>(rule)) + (open_end ? ", open end" : ""));
    SweptPair curves(P, Q);
    for (const Level& level : available_levels()) {
        const check::Note at_level(level.name);
        const SweepProblem problem = curves.problem(level, rule, GroundDistance{metric});
        const Path full = find_path(problem, open_end);
        const std::optional<Path> path = find_path_of_cheap_cells(problem, open_end);
        if (!path) return check::fail({__FILE__, __LINE__, "cheap cells"}, "returns nothing");
        CHECK_EQUAL(path->value, full.value);
        CHECK_EQUAL(path->pairs, full.pairs);
    }
}

void random_pairs() {
    Random random(1);
    for (std::ptrdiff_t k = 0; k < pairs; ++k) {
        const std::ptrdiff_t n = 91 + random.index(300), m = 91 + random.index(300);
        const Curve P = test::any_curve(n, 1 + random.index(3), random);
        const bool symmetric2 = random.index(2) == 0;
        const Curve Q = k % 8 == 0   ? test::with_plateaus(P, 40, random)
                        : k % 3 == 0 ? test::any_curve(m, P.dim(), random)
                                     : test::alike(P, m, random);
        compare(P, Q, any_norm(random), symmetric2 ? Rule::dtw_symmetric2 : Rule::dtw_symmetric1,
                !symmetric2 && random.index(4) == 0);
    }
}

// The sweep in registers, some rows at a time (narrow_path.hpp): |dx| + |dy| in the plane.
void random_pairs_in_narrow_tables() {
    Random random(2);
    for (std::ptrdiff_t k = 0; k < pairs / 4; ++k) {
        const std::ptrdiff_t n = 91 + random.index(200), m = 91 + random.index(200);
        const Curve P = test::any_curve(n, 2, random);
        const Curve Q = k % 8 == 0   ? test::with_plateaus(P, 40, random)
                        : k % 3 == 0 ? test::any_curve(m, 2, random)
                                     : test::alike(P, m, random);
        compare(P, Q, Metric::cityblock, Rule::dtw_symmetric1, false);
    }
}

void returns_nothing_where_the_full_sweep_is_as_fast() {
    const Level level = available_levels().front();
    const auto finds = [&](std::ptrdiff_t n, std::ptrdiff_t m, auto change) {
        const Curve P = test::loops(n, 2, 2.0, 0.0, false), Q = test::loops(m, 2, 2.0, 0.0, false);
        SweptPair curves(P, Q);
        SweepProblem problem = curves.problem(level, Rule::dtw_symmetric1);
        change(problem, curves);
        return find_path_of_cheap_cells(problem, false).has_value();
    };
    const auto as_it_is = [](SweepProblem&, SweptPair&) {};
    CHECK(finds(100, 100, as_it_is));
    CHECK(!finds(90, 90, as_it_is));
    CHECK(!finds(1200, 1001, as_it_is));
    CHECK(!finds(100, 100, [](SweepProblem& problem, SweptPair&) { problem.open_begin = true; }));
    CHECK(!finds(100, 100, [](SweepProblem& problem, SweptPair& curves) {
        problem.columns = curves.band(20);
    }));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) pairs = std::atol(argv[1]);
    return check::run({{"random pairs", random_pairs},
                       {"random pairs in narrow tables", random_pairs_in_narrow_tables},
                       {"returns nothing where the full sweep is as fast",
                        returns_nothing_where_the_full_sweep_is_as_fast}});
}
