// The strip sweep against the textbook's table, filled row by row: last row, whole table and paths
// must be identical. Tested at every instruction-set level of this machine, in one thread and in
// several. The sweep runs in registers where possible, for curves of any length, and with diagonals
// in memory. Paths are found in one table and by divide and conquer. Columns are also narrowed to
// those that a path of the given cost may visit. The sizes are those around a SIMD vector of 2, 4
// or 8 doubles and around the strips' heights (32 rows with a table, 256 without). Half of the data
// is small integers, so that most cells have equal predecessors. `test_sweep 7` makes a seventh of
// the comparisons.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "../../stress/textbook_warping.hpp"
#include "check.hpp"
#include "curves.hpp"
#include "swept_pair.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/path.hpp"
#include "warping/sweep.hpp"

namespace {

using curvewise::GroundDistance;
using curvewise::Metric;
using curvewise::kernels::Rule;
using curvewise::warping::available_levels;
using curvewise::warping::Band;
using curvewise::warping::Level;
using curvewise::warping::LiveColumns;
using curvewise::warping::Row;
using curvewise::warping::SweepProblem;
using oracle::Path;
using test::Curve;
using test::Random;
using test::SweptPair;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Setup {
    GroundDistance ground;
    Rule rule = Rule::dtw_symmetric1;
    std::optional<std::ptrdiff_t> window;
    bool open_begin = false;
    std::ptrdiff_t workers = 1;

    bool is_exact() const { return oracle::is_exact(ground); }
    oracle::Rules rules() const {
        return {ground, rule == Rule::frechet, rule == Rule::dtw_symmetric2 ? 2.0 : 1.0, window,
                open_begin};
    }
};

class Comparison {
   public:
    Comparison(const Curve& P, const Curve& Q, const Setup& setup)
        : P_(P),
          Q_(Q),
          setup_(setup),
          expected_(textbook::filled(P, Q, setup.rules())),
          curves_(P, Q),
          band_(curves_.band(setup.window)) {}

    void run() {
        for (const Level& level : available_levels()) {
            const check::Note note(level.name);
            SweepProblem problem = curves_.problem(level, setup_.rule, setup_.ground);
            problem.columns = band_;
            problem.open_begin = setup_.open_begin;
            problem.workers = setup_.workers;
            problem.cells_per_worker = cells_per_worker;
            check_bottom(last_row(problem));
            problem.is_always_resident = true;
            check_bottom(last_row(problem));
            check_table(problem);
            if (setup_.is_exact()) check_narrowed(problem);
            for (const std::ptrdiff_t max_codes : {1 << 24, 40}) {
                check_path(problem, false, max_codes);
                if (!setup_.window) check_path(problem, true, max_codes);
            }
        }
    }

   private:
    // Far fewer than threads are worth, so that the tables that several are asked for have them.
    static constexpr std::ptrdiff_t cells_per_worker = 1 << 12;

    void check_value(double actual, std::ptrdiff_t i, std::ptrdiff_t j) const {
        const double value = expected_.cost(i, j);
        if (setup_.is_exact() ? actual == value : std::abs(actual - value) <= 1e-12 * value) return;
        const check::Note note("cell " + std::to_string(i) + ", " + std::to_string(j));
        CHECK_EQUAL(actual, value);
    }

    void check_bottom(const Row& bottom) const {
        const std::ptrdiff_t i = P_.size() - 1;
        for (std::ptrdiff_t j = 0; j < Q_.size(); ++j) {
            const bool in_band = oracle::is_allowed(P_.size(), Q_.size(), i, j, setup_.window);
            if (in_band) check_value(bottom[j], i, j);
        }
    }

    // Narrowed with the largest cost that leaves the path in, with one that leaves more, and with
    // one that leaves nothing; then the path within the remaining columns.
    void check_narrowed(SweepProblem problem) const {
        const LiveColumns band = problem.columns;
        const double value = expected_.cost(P_.size() - 1, Q_.size() - 1);
        const std::vector<double> after_row = suffix_sums(P_.size(), [&](auto i) {
            return smallest(Q_.size(), [&](auto j) { return ground_distance(i, j); });
        });
        const std::vector<double> after_column = suffix_sums(Q_.size(), [&](auto j) {
            return smallest(P_.size(), [&](auto i) { return ground_distance(i, j); });
        });
        for (const double most : {value, 1.25 * value, 0.75 * value}) {
            const curvewise::warping::CostToGo cost_to_go{most, 1.0 - 0x1p-40, after_row.data() + 1,
                                                          after_column.data() + 1,
                                                          setup_.rule == Rule::dtw_symmetric2};
            curvewise::warping::SweptColumns swept;
            problem.columns = LiveColumns(band_, cost_to_go, swept);
            const double narrowed = last_row(problem)[Q_.size() - 1];
            if (most < value) {
                CHECK(narrowed > most);
                continue;
            }
            CHECK_EQUAL(narrowed, value);
            // The count is of cells, each once, except that a band's slope is not followed.
            CHECK(swept.cells > 0);
            if (!setup_.window) CHECK(swept.cells <= P_.size() * Q_.size());
            problem.columns = LiveColumns(band_, swept);
            check_path(problem, false, 40);
        }
        problem.columns = band;
    }

    // From the sum of all to the empty one; 0 for Fréchet, where nothing adds up.
    template <class Term>
    std::vector<double> suffix_sums(std::ptrdiff_t count, Term term) const {
        std::vector<double> sums(static_cast<std::size_t>(count + 1), 0.0);
        if (setup_.rule == Rule::frechet) return sums;
        for (std::ptrdiff_t k = count - 1; k >= 0; --k) {
            sums[static_cast<std::size_t>(k)] = term(k) + sums[static_cast<std::size_t>(k + 1)];
        }
        return sums;
    }

    template <class Term>
    static double smallest(std::ptrdiff_t count, Term term) {
        double least = infinity;
        for (std::ptrdiff_t k = 0; k < count; ++k) least = std::min(least, term(k));
        return least;
    }

    double ground_distance(std::ptrdiff_t i, std::ptrdiff_t j) const {
        return oracle::ground_distance(setup_.ground, P_, i, Q_, j);
    }

    // A double behind the table's end must not change.
    void check_table(const SweepProblem& problem) const {
        std::vector<double> table(static_cast<std::size_t>(P_.size() * Q_.size() + 1), -1.0);
        sweep_table(problem, table.data());
        for (std::ptrdiff_t i = 0; i < P_.size(); ++i) {
            for (std::ptrdiff_t j = 0; j < Q_.size(); ++j) {
                check_value(table[static_cast<std::size_t>(i * Q_.size() + j)], i, j);
            }
        }
        CHECK_EQUAL(table.back(), -1.0);
    }

    // The first column with the smallest value, in the last row.
    std::ptrdiff_t first_best() const {
        std::ptrdiff_t best = 0;
        for (std::ptrdiff_t j = 1; j < Q_.size(); ++j) {
            if (expected_.cost(P_.size() - 1, j) < expected_.cost(P_.size() - 1, best)) best = j;
        }
        return best;
    }

    void check_path(const SweepProblem& problem, bool open_end, std::ptrdiff_t max_codes) const {
        const auto [value, pairs] = find_path(problem, open_end, max_codes);
        const oracle::Path path(pairs.begin(), pairs.end());
        oracle::Rules rules = setup_.rules();
        rules.open_end = open_end;
        CHECK(oracle::is_path(path, P_, Q_, rules));
        if (setup_.is_exact()) {
            const std::ptrdiff_t column = open_end ? first_best() : Q_.size() - 1;
            CHECK_EQUAL(value, expected_.cost(P_.size() - 1, column));
            CHECK_EQUAL(path, textbook::traced(expected_, rules, column));
            CHECK_EQUAL(oracle::path_cost(path, P_, Q_, rules), value);
        } else {
            CHECK_CLOSE(oracle::path_cost(path, P_, Q_, rules), value, 1e-12);
        }
    }

    const Curve& P_;
    const Curve& Q_;
    const Setup& setup_;
    textbook::Table expected_;
    SweptPair curves_;
    Band band_;
};

constexpr std::ptrdiff_t dimensions[] = {1, 2, 3, 4, 7};
constexpr Rule rules[] = {Rule::dtw_symmetric1, Rule::dtw_symmetric2, Rule::frechet};

std::string described(const Setup& setup) {
    return oracle::name(setup.ground.metric) + ", rule " +
           std::to_string(static_cast<int>(setup.rule)) + ", window " +
           (setup.window ? std::to_string(*setup.window) : "none") +
           (setup.open_begin ? ", open_begin" : "") + ", workers " + std::to_string(setup.workers);
}

std::ptrdiff_t every = 1;  // one comparison of `every` is made, among those in one thread

void compare(const Curve& P, const Curve& Q, const Setup& setup) {
    static std::ptrdiff_t count = 0;
    if (setup.workers == 1 && ++count % every != 0) return;
    const check::Note note(test::described(P, Q) + ", " + described(setup));
    Comparison(P, Q, setup).run();
}

// With every window that fits in `windows`, and with an open beginning.
void compare_windows(const Curve& P, const Curve& Q, Setup setup,
                     std::initializer_list<std::ptrdiff_t> windows) {
    compare(P, Q, setup);
    for (const std::ptrdiff_t window : windows) {
        if (window == 0 && P.size() != Q.size() && P.size() > 1 && Q.size() > 1) continue;
        setup.window = window;
        compare(P, Q, setup);
    }
    setup.window.reset();
    setup.open_begin = true;
    compare(P, Q, setup);
}

void sizes_around_a_vector() {
    Random random(1);
    for (const std::ptrdiff_t n : {1, 2, 3, 4, 5, 7, 8, 9}) {
        for (const std::ptrdiff_t m : {1, 2, 3, 4, 5, 7, 8, 9}) {
            for (const std::ptrdiff_t dim : dimensions) {
                const Curve P = random.lattice_curve(n, dim), Q = random.lattice_curve(m, dim);
                const Curve R = random.curve(n, dim), S = random.curve(m, dim);
                for (const Metric metric : oracle::metrics) {
                    for (const Rule rule : rules) {
                        compare_windows(P, Q, {{metric, 2.5}, rule, {}}, {0, 1, 2});
                        compare_windows(R, S, {{metric, 2.5}, rule, {}}, {1, 3});
                    }
                }
            }
        }
    }
}

// On and next to the rows where one strip ends and the next begins.
void sizes_around_a_strip() {
    Random random(2);
    for (const std::ptrdiff_t n : {31, 32, 33, 255, 256, 257, 511, 512, 513}) {
        for (const std::ptrdiff_t m : {1, 3, 40}) {
            for (const std::ptrdiff_t dim : dimensions) {
                const bool lattice = random.index(2) == 0;
                const Curve P = lattice ? random.lattice_curve(n, dim) : random.curve(n, dim);
                const Curve Q = lattice ? random.lattice_curve(m, dim) : random.curve(m, dim);
                for (const Metric metric : oracle::metrics) {
                    for (const Rule rule : rules) {
                        compare_windows(P, Q, {{metric, 2.5}, rule, {}}, {2});
                    }
                }
                compare(Q, P, {{Metric::euclidean}, Rule::dtw_symmetric2, {}});
                compare(Q, P, {{Metric::sqeuclidean}, Rule::frechet, {}});
            }
        }
    }
}

// A band that leaves a strip's first columns behind, enters the next one anywhere, and is steep or
// flat. The boundary row between strips then holds cells outside of the band on both sides.
void bands_across_strips() {
    Random random(3);
    for (const std::ptrdiff_t n : {33, 257, 513}) {
        for (const std::ptrdiff_t m : {n - 1, n, n + 1, n / 3, 2 * n}) {
            const Curve P = random.curve(n, 2), Q = random.curve(m, 2);
            const Curve R = random.lattice_curve(n, 2), S = random.lattice_curve(m, 2);
            for (const Rule rule : {Rule::dtw_symmetric1, Rule::dtw_symmetric2}) {
                compare_windows(P, Q, {{Metric::euclidean}, rule, {}}, {0, 1, 7, n / 4, 2 * n});
                compare_windows(R, S, {{Metric::cityblock}, rule, {}}, {0, 1, 7});
            }
        }
    }
}

void orders_of_minkowski() {
    Random random(4);
    for (const double p : {1.0, 1.5, 2.0, 3.0, infinity}) {
        for (const std::ptrdiff_t dim : dimensions) {
            for (const std::ptrdiff_t n : {1, 9, 33, 257}) {
                const Curve P = random.curve(n, dim), Q = random.curve(10, dim);
                for (const Rule rule : rules) {
                    compare(P, Q, {{Metric::minkowski, p}, rule, {}});
                }
            }
        }
    }
}

// Strips that are waited for, since their rows are longer than a thread sweeps before it looks what
// the others have done: whole, in a band, with open ends.
void several_threads() {
    Random random(5);
    for (const std::ptrdiff_t workers : {2, 3}) {
        for (const Rule rule : rules) {
            const Curve P = random.curve(300, 2), Q = random.curve(2600, 2);
            const Curve R = random.lattice_curve(1300, 3), S = random.lattice_curve(500, 3);
            Setup setup{{Metric::euclidean}, rule, {}};
            setup.workers = workers;
            compare_windows(P, Q, setup, {900});
            compare_windows(R, S, setup, {200});
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) every = std::atol(argv[1]);
    return check::run({{"sizes around a vector", sizes_around_a_vector},
                       {"sizes around a strip", sizes_around_a_strip},
                       {"bands across strips", bands_across_strips},
                       {"orders of minkowski", orders_of_minkowski},
                       {"several threads", several_threads}});
}
