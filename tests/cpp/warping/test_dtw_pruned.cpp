// Pruned DTW against the full sweep: value and path must be identical. Tested at every
// instruction-set level of this machine, with 1 to 3 threads: random pairs of hard curves, every
// ground distance with bounds, both step patterns, windows, open ends, cutoffs around the value.
// Also coarse curves of one level and of several, and paths along the edge of a band.
// `test_dtw_pruned 100000` is the long run.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include "check.hpp"
#include "curves/range_scale.hpp"
#include "hard_curves.hpp"
#include "oracle.hpp"
#include "swept_pair.hpp"
#include "unpolled.hpp"
#include "warping/dispatch.hpp"
#include "warping/dtw_pruned.hpp"
#include "warping/ground_distance.hpp"
#include "warping/least_distances.hpp"
#include "warping/path.hpp"
#include "warping/sweep.hpp"

namespace {

using curvewise::GroundDistance;
using curvewise::Metric;
using curvewise::curves::RangeScale;
using curvewise::kernels::Rule;
using curvewise::runtime::Poller;
using curvewise::warping::available_levels;
using curvewise::warping::DtwPruningOptions;
using curvewise::warping::DtwPruningRecord;
using curvewise::warping::Level;
using curvewise::warping::PackedCurve;
using curvewise::warping::Path;
using curvewise::warping::PointOrder;
using curvewise::warping::Row;
using curvewise::warping::SweepProblem;
using test::Curve;
using test::Random;
using test::SweptPair;
using test::unpolled;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::ptrdiff_t pairs = 2000;  // in each test

Metric any_bounded_metric(Random& random) {
    Metric metric;
    do {
        metric = oracle::metrics[static_cast<std::size_t>(random.index(oracle::metrics.size()))];
    } while (!curvewise::warping::has_box_bounds(metric));
    return metric;
}

struct Setup {
    Metric metric = Metric::euclidean;
    Rule rule = Rule::dtw_symmetric1;
    std::optional<std::ptrdiff_t> window;
    DtwPruningOptions options;
    std::ptrdiff_t workers = 1;
};

Setup any_setup(const test::Pair& pair, Random& random) {
    Setup setup;
    setup.metric = any_bounded_metric(random);
    if (random.index(2) == 0) setup.rule = Rule::dtw_symmetric2;
    if (random.index(4) == 0) {
        setup.window = 1 + random.index(std::max(pair.P.size(), pair.Q.size()));
    } else if (setup.rule == Rule::dtw_symmetric1) {
        setup.options.open_end = random.index(4) == 0;
    }
    setup.options.gives_up = false;
    setup.options.decimation = 2 + random.index(8);
    setup.options.most_coarse_cells = random.index(2) == 0 ? 1 << 18 : 50;
    setup.workers = 1 + random.index(3);
    return setup;
}

std::string described(const test::Pair& pair, const Setup& setup) {
    return test::described(pair.P, pair.Q) + ", " + oracle::name(setup.metric) + ", rule " +
           std::to_string(static_cast<int>(setup.rule)) + ", window " +
           (setup.window ? std::to_string(*setup.window) : "none") +
           (setup.options.open_end ? ", open end" : "") + ", decimation " +
           std::to_string(setup.options.decimation) + ", coarse cells " +
           std::to_string(setup.options.most_coarse_cells) + ", workers " +
           std::to_string(setup.workers);
}

class Comparison {
   public:
    Comparison(const test::Pair& pair, const Setup& setup)
        : setup_(setup), curves_(pair.P, pair.Q) {}

    void run() {
        for (const Level& level : available_levels()) {
            const check::Note note(level.name);
            SweepProblem problem =
                curves_.problem(level, setup_.rule, GroundDistance{setup_.metric});
            problem.columns = curves_.band(setup_.window);
            problem.workers = setup_.workers;
            problem.cells_per_worker = 1;
            compare(problem);
        }
    }

   private:
    void compare(const SweepProblem& problem) const {
        const Path full = find_path(problem, setup_.options.open_end);
        const Row& bottom = last_row(problem);
        const std::ptrdiff_t last = problem.curves.columns() - 1;
        CHECK_EQUAL(bottom[setup_.options.open_end ? bottom.argmin() : last], full.value);
        DtwPruningRecord record;
        const std::optional<double> value = dtw_pruned(problem, setup_.options, record);
        if (!value) return check::fail({__FILE__, __LINE__, "dtw_pruned"}, "returns nothing");
        CHECK_EQUAL(*value, full.value);
        CHECK(record.upper >= full.value);
        CHECK(record.lower <= full.value * (1.0 + 1e-9));
        const std::optional<Path> path = dtw_path_pruned(problem, setup_.options, record);
        if (!path) return check::fail({__FILE__, __LINE__, "dtw_path_pruned"}, "returns nothing");
        CHECK_EQUAL(path->value, full.value);
        CHECK_EQUAL(path->pairs, full.pairs);
        check_cutoffs(problem, full.value);
    }

    void check_cutoffs(const SweepProblem& problem, double value) const {
        DtwPruningOptions options = setup_.options;
        for (const double cutoff : {value, 1.5 * value, std::nextafter(value, 0.0), 0.5 * value}) {
            options.cutoff = cutoff;
            DtwPruningRecord record;
            const std::optional<double> found = dtw_pruned(problem, options, record);
            CHECK_EQUAL(found.value_or(-1.0), value > cutoff ? infinity : value);
        }
    }

    const Setup& setup_;
    SweptPair curves_;
};

void compare(const test::Pair& pair, const Setup& setup) {
    const check::Note note(described(pair, setup));
    Comparison(pair, setup).run();
}

void random_pairs() {
    Random random(1);
    for (std::ptrdiff_t k = 0; k < pairs; ++k) {
        test::Pair pair = test::any_pair(random);
        // Against itself, or with points repeated, which cost nothing: no path may cost less.
        if (k % 8 == 0) pair.Q = k % 16 == 0 ? pair.P : test::with_plateaus(pair.P, 40, random);
        compare(pair, any_setup(pair, random));
    }
}

// One curve is behind the other by as many points as the window allows, or nearly. The path runs
// along an edge of the band, diagonally from the end of a row to the end of the next. Few cells
// next to it are active.
void along_the_edge_of_the_band() {
    Random random(6);
    for (std::ptrdiff_t k = 0; k < pairs / 8; ++k) {
        const std::ptrdiff_t n = 80 + random.index(300), shift = 1 + random.index(30);
        const std::ptrdiff_t dim = 1 + random.index(3);
        const Curve all = random.index(2) == 0 ? random.curve(n + shift, dim)
                                               : test::walk(n + shift, dim, 1.0, random);
        test::Pair pair{all.part(0, n), all.part(shift, n + shift)};
        if (random.index(2) == 0) std::swap(pair.P, pair.Q);
        Setup setup = any_setup(pair, random);
        setup.options.open_end = false;
        setup.window = std::max<std::ptrdiff_t>(1, shift - random.index(2));
        compare(pair, setup);
    }
}

// The path of cost 0 runs along equal points of Q in the last row of a strip, to the edge of the
// band there. It enters the next strip by the diagonal behind it; no other cell there is active. At
// each place where a sweep tests whether a strip is finished, some run ends.
void runs_that_end_with_a_strip_and_the_band() {
    constexpr std::ptrdiff_t n = 400, last_of_strip = n / 2 - 1;
    for (std::ptrdiff_t window = 1; window <= 34; ++window) {
        std::vector<double> p, q;
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            p.push_back(static_cast<double>(std::min(i, n - 1 - window)));
            const std::ptrdiff_t behind = std::clamp<std::ptrdiff_t>(i - last_of_strip, 0, window);
            q.push_back(static_cast<double>(i - behind));
        }
        Setup setup;
        setup.window = window;
        setup.options.gives_up = false;
        setup.options.decimation = 4;
        compare({Curve(p, 1), Curve(q, 1)}, setup);
    }
}

// Several strips, and coarse tables that give up or not.
void large_pairs() {
    Random random(2);
    for (std::ptrdiff_t k = 0; k < std::max<std::ptrdiff_t>(pairs / 500, 4); ++k) {
        const Curve P = test::any_curve(600 + random.index(1500), 2, random);
        const test::Pair pair{P, test::alike(P, 600 + random.index(1500), random)};
        Setup setup = any_setup(pair, random);
        setup.options.decimation = 8 + random.index(9);
        setup.options.most_coarse_cells = random.index(2) == 0 ? 1 << 18 : 4000;
        compare(pair, setup);
    }
}

// Each bound against the smallest of all distances.
void least_distances_are_bounds() {
    Random random(3);
    for (std::ptrdiff_t k = 0; k < pairs; ++k) {
        const test::Pair pair = test::any_pair(random);
        const Curve &P = pair.P, &Q = pair.Q;
        const Metric metric = any_bounded_metric(random);
        const check::Note note(test::described(P, Q));
        const PackedCurve p(P, RangeScale(1.0), PointOrder::forward, unpolled);
        const PackedCurve q(Q, RangeScale(1.0), PointOrder::reversed, unpolled);
        const curvewise::warping::BoxTree from(p, PointOrder::forward), to(q, PointOrder::reversed);
        std::vector<double> bounds(static_cast<std::size_t>(P.size()), -1.0);
        least_distances(from, to, metric, unpolled, bounds.data());
        curvewise::warping::with_norm(metric, [&](auto norm) {
            using Norm = decltype(norm);
            for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
                double least = infinity;
                for (std::ptrdiff_t j = 0; j < Q.size(); ++j) {
                    least = std::min(least, curvewise::warping::point_distance<Norm>(
                                                from.points(), i, to.points(), j, P.dim()));
                }
                const double bound = bounds[static_cast<std::size_t>(i)];
                CHECK(bound >= 0.0);
                CHECK(bound <= least);
            }
        });
    }
}

// Walks and noise leave nothing to prune, and short curves do not pay. Similar curves do, and so do
// their coarse curves of several levels.
void gives_up_where_it_should() {
    Random random(4);
    const auto gives_up = [](const Curve& P, const Curve& Q) {
        SweptPair curves(P, Q);
        const SweepProblem problem =
            curves.problem(available_levels().front(), Rule::dtw_symmetric1);
        DtwPruningRecord record;
        return !dtw_pruned(problem, {}, record).has_value();
    };
    CHECK(gives_up(random.curve(1300, 2), random.curve(1200, 2)));
    CHECK(gives_up(random.walk(1300), random.walk(1200)));
    const Curve loop = test::loops(20000, 2, 2.0, 0.0, false);
    CHECK(gives_up(loop.part(0, 100), loop.part(0, 90)));
    for (const std::ptrdiff_t m : {1200, 1300, 12000, 18000}) {
        CHECK(!gives_up(loop, test::alike(loop, m, random)));
    }
}

// The table, once: neither the coarse curves' nor the corridor.
void progress_counts_the_table() {
    Random random(5);
    const Curve P = test::loops(14000, 2, 2.0, 0.0, false), Q = test::alike(P, 13000, random);
    curvewise::Control control;
    Poller poller(&control);
    poller.begin(P.size() * Q.size());
    SweptPair curves(P, Q);
    const SweepProblem problem =
        curves.problem(available_levels().back(), Rule::dtw_symmetric1, GroundDistance{}, poller);
    DtwPruningRecord record;
    CHECK(dtw_pruned(problem, {}, record).has_value());
    poller.poll();
    CHECK_EQUAL(control.done(), P.size() * Q.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) pairs = std::atol(argv[1]);
    return check::run(
        {{"random pairs", random_pairs},
         {"along the edge of the band", along_the_edge_of_the_band},
         {"runs that end with a strip and the band", runs_that_end_with_a_strip_and_the_band},
         {"large pairs", large_pairs},
         {"least distances are bounds", least_distances_are_bounds},
         {"gives up where it should", gives_up_where_it_should},
         {"progress counts the table", progress_counts_the_table}});
}
