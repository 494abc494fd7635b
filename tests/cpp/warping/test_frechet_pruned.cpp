// The pruned Fréchet distance against the full sweep: values must be identical. Tested at every
// instruction-set level of this machine, with random pairs of curves of all kinds that make pruning
// hard: ties, plateaus, repeated points, loops that cross, spirals, one far point, curves of one
// point. Also every ground distance with bounds, and cutoffs around the value. `test_frechet_pruned
// 100000` is the long run.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "hard_curves.hpp"
#include "oracle.hpp"
#include "swept_pair.hpp"
#include "warping/dispatch.hpp"
#include "warping/frechet_corridor.hpp"
#include "warping/frechet_pruned.hpp"
#include "warping/ground_distance.hpp"
#include "warping/path.hpp"
#include "warping/sweep.hpp"

namespace {

using curvewise::Metric;
using curvewise::kernels::Cost;
using curvewise::kernels::Rule;
using curvewise::runtime::Poller;
using curvewise::warping::available_levels;
using curvewise::warping::Band;
using curvewise::warping::frechet_corridor;
using curvewise::warping::frechet_pruned;
using curvewise::warping::Level;
using curvewise::warping::LiveColumns;
using curvewise::warping::Path;
using curvewise::warping::PruningRecord;
using curvewise::warping::SweepProblem;
using curvewise::warping::SweptColumns;
using test::alike;
using test::any_pair;
using test::Curve;
using test::empty_curve;
using test::loops;
using test::Pair;
using test::Random;
using test::SweptPair;
using test::with_plateaus;

constexpr double infinity = std::numeric_limits<double>::infinity();
std::ptrdiff_t pairs = 300;  // in each test

class Comparison {
   public:
    Comparison(const Curve& P, const Curve& Q) : curves_(P, Q), dim_(P.dim()) {}

    void run() {
        for (const Level& level : available_levels()) {
            const check::Note note(level.name);
            for (const Metric metric : oracle::metrics) {
                const check::Note metric_note(oracle::name(metric));
                if (level.kernels->reach(metric, dim_) == nullptr) continue;
                const SweepProblem problem = problem_of(level, metric);
                compare_paths(problem, compare_values(problem));
            }
        }
    }

    void run_values(Metric metric) {
        for (const Level& level : available_levels()) {
            const check::Note note(level.name);
            compare_values(problem_of(level, metric));
        }
    }

   private:
    SweepProblem problem_of(const Level& level, Metric metric) {
        return curves_.problem(level, Rule::frechet, Cost{metric, false});
    }

    static double compare_values(const SweepProblem& problem) {
        const double expected = last_row(problem)[problem.curves.columns() - 1];
        CHECK_EQUAL(pruned(problem, infinity), expected);
        CHECK_EQUAL(pruned(problem, expected), expected);
        CHECK_EQUAL(pruned(problem, expected * 1.3), expected);
        if (expected > 0.0) {
            CHECK_EQUAL(pruned(problem, std::nextafter(expected, 0.0)), infinity);
            CHECK_EQUAL(pruned(problem, expected * 0.7), infinity);
        }
        return expected;
    }

    static double pruned(const SweepProblem& problem, double cutoff) {
        PruningRecord record;
        const std::optional<double> value = frechet_pruned(problem, {cutoff, false, 0}, record);
        CHECK(value.has_value());
        if (!value) return -1.0;
        CHECK(record.lower <= record.upper);
        return *value;
    }

    // Read off from one table of predecessors, and by divide and conquer.
    static void compare_paths(const SweepProblem& problem, double value) {
        const SweptColumns corridor = frechet_corridor(problem, value);
        SweepProblem narrow = problem;
        narrow.columns = LiveColumns(
            Band(problem.curves.rows(), problem.curves.columns(), std::nullopt), corridor);
        for (const std::ptrdiff_t max_codes : {1 << 24, 400}) {
            const Path expected = find_path(problem, false, max_codes);
            const Path path = find_path(narrow, false, max_codes);
            CHECK_EQUAL(path.value, value);
            CHECK_EQUAL(path.pairs, expected.pairs);
        }
    }

    SweptPair curves_;
    std::ptrdiff_t dim_;
};

void compare(const Curve& P, const Curve& Q) {
    const check::Note note(test::described(P, Q));
    Comparison(P, Q).run();
}

void random_pairs() {
    Random random(1);
    for (std::ptrdiff_t k = 0; k < pairs; ++k) {
        const check::Note note("pair " + std::to_string(k));
        const auto [P, Q] = any_pair(random);
        compare(P, Q);
    }
}

// Runs of equal points, most of them longer than a block, whose coordinates are `base` and a few
// units in the last place of 1.
Curve steps_of_an_ulp(std::ptrdiff_t n, std::ptrdiff_t dim, double base, Random& random) {
    Curve curve = empty_curve(n, dim);
    for (std::ptrdiff_t i = 0; i < n;) {
        const std::ptrdiff_t end = std::min(n, i + 1 + random.index(250));
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            const double value = base + 0x1p-52 * static_cast<double>(random.index(4));
            for (std::ptrdiff_t k = i; k < end; ++k) curve(k, c) = value;
        }
        i = end;
    }
    return curve;
}

// Ground distances that are equal or differ in their last bits, in whole blocks. A single bit
// decides whether a block is free, blocked or undecided. The steps are long, so that the distance
// is often above the lower bound and values pass through free blocks.
void bounds_that_are_met() {
    Random random(3);
    for (std::ptrdiff_t k = 0; k < pairs / 5; ++k) {
        const check::Note note("pair " + std::to_string(k));
        const std::ptrdiff_t dim = 1 + random.index(2);
        const std::ptrdiff_t n = 100 + random.index(700), m = 100 + random.index(700);
        compare(steps_of_an_ulp(n, dim, 0.0, random), steps_of_an_ulp(m, dim, 1.0, random));
        compare(with_plateaus(random.lattice_curve(n, dim), 250, random),
                with_plateaus(random.lattice_curve(m, dim), 250, random));
    }
}

// Curves whose table consists of rooms with one ground distance each (chebyshev): runs of equal
// points, of the given lengths, with a coordinate for each pair of runs.
using Rooms = std::vector<std::vector<double>>;
using Lengths = std::vector<std::ptrdiff_t>;

Pair curves_of(const Rooms& rooms, const Lengths& heights, const Lengths& widths) {
    const std::size_t dim = heights.size() * widths.size();
    std::vector<double> p, q;
    for (std::size_t a = 0; a < heights.size(); ++a) {
        std::vector<double> point(dim, 0.0);
        for (std::size_t b = 0; b < widths.size(); ++b) {
            point[a * widths.size() + b] = 0.5 * rooms[a][b];
        }
        for (std::ptrdiff_t k = 0; k < heights[a]; ++k)
            p.insert(p.end(), point.begin(), point.end());
    }
    for (std::size_t b = 0; b < widths.size(); ++b) {
        std::vector<double> point(dim, 0.0);
        for (std::size_t a = 0; a < heights.size(); ++a) {
            point[a * widths.size() + b] = -0.5 * rooms[a][b];
        }
        for (std::ptrdiff_t k = 0; k < widths[b]; ++k)
            q.insert(q.end(), point.begin(), point.end());
    }
    const auto d = static_cast<std::ptrdiff_t>(dim);
    return {Curve(p, d), Curve(q, d)};
}

// Most rooms are free or blocked as a whole; some decide the value. Walls on the borders of blocks,
// or anywhere.
Pair maze(Random& random) {
    const double distances[] = {1.0, 1.0, 1.0, 1.01, 1.02, 1.03, 2.0, 2.0};
    const std::ptrdiff_t side = random.index(2) == 0 ? 32 : 20 + random.index(30);
    Lengths heights, widths;
    for (std::ptrdiff_t k = 3 + random.index(4); k > 0; --k) {
        heights.push_back((1 + random.index(4)) * side);
    }
    for (std::ptrdiff_t k = 3 + random.index(4); k > 0; --k) {
        widths.push_back((1 + random.index(4)) * side);
    }
    Rooms rooms(heights.size(), std::vector<double>(widths.size()));
    for (std::vector<double>& row : rooms) {
        for (double& room : row) room = distances[random.index(std::size(distances))];
    }
    return curves_of(rooms, heights, widths);
}

// The only way leads into a free block from the left, in the middle, and out of it below, in the
// middle; no corner helps. The distance, 1.02, is above the lower bound, 1.
void turn_in_a_free_block() {
    constexpr double wall = 2.0;
    const Rooms rooms = {{1, 1, wall, wall, wall},    {1, wall, wall, wall, wall},
                         {1, 1.02, 1, 1, wall},       {wall, wall, 1, 1, wall},
                         {wall, wall, wall, 1, wall}, {wall, wall, wall, 1, 1}};
    const auto [P, Q] = curves_of(rooms, {32, 32, 32, 32, 32, 32}, {32, 32, 32, 32, 64});
    Comparison(P, Q).run_values(Metric::chebyshev);
    Comparison(Q, P).run_values(Metric::chebyshev);
}

// The only way leads into a free block from above, and out of it below, further to the right.
void through_a_free_block() {
    constexpr double wall = 2.0;
    const Rooms rooms = {{1, wall, wall}, {1, 1, 1}, {wall, wall, 1}};
    const auto [P, Q] = curves_of(rooms, {64, 64, 64}, {21, 19, 24});
    Comparison(P, Q).run_values(Metric::chebyshev);
    Comparison(Q, P).run_values(Metric::chebyshev);
}

void mazes() {
    Random random(4);
    for (std::ptrdiff_t k = 0; k < pairs; ++k) {
        const check::Note note("pair " + std::to_string(k));
        const auto [P, Q] = maze(random);
        Comparison(P, Q).run_values(Metric::chebyshev);
    }
}

// A kernel of blocks or boxes exists exactly where a distance has bounds, so that no wrong one can
// be called. For the Fréchet table, one kernel holds blocks of distances without their root.
void kernels_where_there_are_bounds() {
    for (const Level& level : available_levels()) {
        for (const Metric metric : oracle::metrics) {
            const check::Note note(oracle::name(metric));
            const bool has_bounds = curvewise::warping::has_box_bounds(metric);
            Cost cost{metric, false};
            const bool has_blocks = has_bounds && !curvewise::warping::put_off_root(cost, {metric});
            for (const std::ptrdiff_t dim : {1, 2, 3, 4}) {
                CHECK_EQUAL(level.kernels->least(metric, dim) != nullptr, has_bounds);
                CHECK_EQUAL(level.kernels->reach(metric, dim) != nullptr, has_blocks);
                CHECK_EQUAL(level.kernels->values(metric, dim) != nullptr, has_blocks);
            }
        }
    }
}

// On and next to the points where one block ends and the next begins.
void sizes_around_a_block() {
    Random random(2);
    for (const std::ptrdiff_t n : {1, 2, 63, 64, 65, 127, 128, 129, 256, 257}) {
        for (const std::ptrdiff_t m : {1, 7, 64, 65, 128, 193}) {
            const Curve P = loops(n, 2, 3.0, 0.01, true);
            compare(P, alike(P, m, random));
            compare(random.lattice_curve(n, 2), random.lattice_curve(m, 2));
        }
    }
}

// A search counts all of the table if it finds the value. It counts nothing if it gives up, even
// after a pass over blocks: the full sweep then counts it.
void steps_are_counted_once() {
    Random random(5);
    int late = 0;
    for (int k = 0; k < 40; ++k) {
        const Curve P = loops(1000, 2, random.uniform(0.5, 6.0), 0.0, false);
        Curve Q = test::walk(950, 2, 0.02 * static_cast<double>(1 + k % 4), random);
        for (std::ptrdiff_t j = 0; j < Q.size(); ++j) {
            for (std::ptrdiff_t c = 0; c < 2; ++c) Q(j, c) += P(j * 999 / 949, c);
        }
        const std::int64_t cells = P.size() * Q.size();
        curvewise::Control control;
        Poller poller(&control);
        poller.begin(cells);
        SweptPair curves(P, Q);
        const SweepProblem problem = curves.problem(available_levels().back(), Rule::frechet,
                                                    Cost{Metric::sqeuclidean, false}, poller);
        PruningRecord record;
        const bool is_found = frechet_pruned(problem, {infinity, true, cells}, record).has_value();
        poller.poll();
        CHECK_EQUAL(control.done(), is_found ? cells : 0);
        late += !is_found && record.reach_passes > 0;
    }
    CHECK(late > 0);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) pairs = std::atol(argv[1]);
    return check::run({{"random pairs", random_pairs},
                       {"bounds that are met", bounds_that_are_met},
                       {"mazes", mazes},
                       {"turn in a free block", turn_in_a_free_block},
                       {"through a free block", through_a_free_block},
                       {"kernels where there are bounds", kernels_where_there_are_bounds},
                       {"sizes around a block", sizes_around_a_block},
                       {"steps are counted once", steps_are_counted_once}});
}
