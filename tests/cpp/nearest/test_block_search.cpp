// Several queries with several targets at once: no bound is above the value, values are those of
// single pairs, and a search by blocks finds what a stable sort of all distances has first.
#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"
#include "nearest/block_search.hpp"
#include "pairwise/batch.hpp"

namespace {

using namespace curvewise;
using curves::CheckedCurve;
using nearest::BlockQuery;
using nearest::BlockSearch;
using runtime::Poller;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Case {
    std::string name;
    Measure measure;
};

DtwOptions dtw_with(Metric metric, StepPattern pattern, std::ptrdiff_t window, bool normalize) {
    DtwOptions options;
    options.ground.metric = metric;
    options.step_pattern = pattern;
    if (window >= 0) options.window = window;
    options.normalize = normalize;
    return options;
}

std::vector<Case> cases() {
    const StepPattern one = StepPattern::symmetric1, two = StepPattern::symmetric2;
    FrechetOptions squared;
    squared.ground.metric = Metric::sqeuclidean;
    return {
        {"dtw", dtw_with(Metric::euclidean, one, -1, false)},
        {"squared", dtw_with(Metric::sqeuclidean, one, -1, false)},
        {"band", dtw_with(Metric::sqeuclidean, one, 2, false)},
        {"one cell", dtw_with(Metric::euclidean, one, 0, false)},
        {"symmetric2", dtw_with(Metric::euclidean, two, 3, true)},
        {"frechet", FrechetOptions{}},
        {"squared frechet", squared},
    };
}

// Of n points; some on a lattice, so that distances are equal.
std::vector<Curve> some_curves(Random& random, int count, std::ptrdiff_t n, std::ptrdiff_t dim) {
    std::vector<Curve> curves;
    for (int k = 0; k < count; ++k) {
        curves.push_back(k % 3 == 0 ? random.lattice_curve(n, dim) : random.curve(n, dim));
        if (k % 5 == 4) curves.back() = curves[curves.size() / 2];
    }
    return curves;
}

// Targets and queries, of which one is beyond the usual range.
struct Pairs {
    Pairs(const Measure& options, Random& random, int count, std::ptrdiff_t n, std::ptrdiff_t dim)
        : measure(std::visit([](const auto& o) { return pairwise::batch_measure(o); }, options)),
          targets(measure->make_targets()),
          known(some_curves(random, count, n, dim)),
          asked(some_curves(random, 9, n, dim)) {
        asked.back() = asked.back().times_power_of_two(510);
        std::vector<CurveView> views(known.begin(), known.end());
        targets->reserve(views, pairwise::PointSource::others);
        for (const Curve& Q : known) targets->add(CheckedCurve(Q, "Q", poller, false), poller);
        for (const Curve& P : asked) {
            queries.emplace_back(P, "P", poller, false);
            for (const Curve& Q : known) table.push_back(evaluate(options, P, Q));
        }
    }
    static double evaluate(const Measure& options, const Curve& P, const Curve& Q) {
        double value = 0.0;
        cdist({P}, {Q}, options, &value);
        return value;
    }
    double value(std::ptrdiff_t row, std::ptrdiff_t column) const {
        return table[static_cast<std::size_t>(row) * known.size() +
                     static_cast<std::size_t>(column)];
    }

    Poller poller{nullptr};
    std::unique_ptr<const pairwise::BatchMeasure> measure;
    std::unique_ptr<pairwise::Targets> targets;
    std::vector<Curve> known, asked;
    std::vector<CheckedCurve> queries;
    std::vector<double> table;  // of single pairs
};

void check_row(Pairs& pairs, pairwise::TargetBlock& block, std::ptrdiff_t row, std::ptrdiff_t first,
               std::ptrdiff_t taken) {
    std::vector<double> found(static_cast<std::size_t>(taken));
    for (const double cutoff : {infinity, pairs.value(row, first), 0.0}) {
        if (!block.bounds(row, cutoff, found.data(), pairs.poller)) continue;
        for (std::ptrdiff_t k = 0; k < taken; ++k) {
            const double bound = found[static_cast<std::size_t>(k)];
            CHECK(bound >= 0.0 && bound <= pairs.value(row, first + k));
        }
    }
    if (!block.values(row, found.data(), pairs.poller)) return;
    for (std::ptrdiff_t k = 0; k < taken; ++k) {
        CHECK_EQUAL(found[static_cast<std::size_t>(k)], pairs.value(row, first + k));
    }
}

void bounds_and_values_hold() {
    Random random(31);
    for (const Case& tested : cases()) {
        for (const std::ptrdiff_t n : {1, 2, 9, 40}) {
            const std::ptrdiff_t dim = 1 + random.index(5);
            const check::Note note(tested.name + ", " + std::to_string(n) + " points");
            Pairs pairs(tested.measure, random, 37, n, dim);
            const auto block = pairs.targets->make_block();
            const std::ptrdiff_t lanes = pairs.targets->most_beside(n, n);
            std::vector<std::ptrdiff_t> all(pairs.known.size());
            std::iota(all.begin(), all.end(), std::ptrdiff_t{0});
            std::vector<const CheckedCurve*> rows;
            for (const CheckedCurve& P : pairs.queries) rows.push_back(&P);
            block->set_rows(rows.data(), 9, pairs.poller);
            block->set_columns(all.data(), 37);
            for (std::ptrdiff_t first = 0; first < 37 && lanes > 1;) {
                const std::ptrdiff_t taken =
                    block->gather(all.data() + first, std::min<std::ptrdiff_t>(lanes, 37 - first));
                for (std::ptrdiff_t i = 0; i < 9; ++i) check_row(pairs, *block, i, first, taken);
                first += std::max<std::ptrdiff_t>(taken, 1);
            }
            for (std::ptrdiff_t i = 0; i < 9; ++i) {
                CHECK_EQUAL(block->value(i, 36 - i, infinity, pairs.poller),
                            pairs.value(i, 36 - i));
            }
        }
    }
}

// What comes first among some of the targets, by all distances.
std::vector<Neighbor> expected_for(const Pairs& pairs, const std::vector<std::ptrdiff_t>& some,
                                   std::ptrdiff_t row, nearest::LeftOut left_out,
                                   const nearest::Question& question) {
    std::vector<Neighbor> expected;
    for (const std::ptrdiff_t j : some) {
        const double distance = pairs.value(row, j);
        const bool is_wanted = question.count > 0 || distance <= question.radius;
        if (is_wanted && !left_out.has(j)) expected.push_back({j, distance});
    }
    if (question.count > 0) {
        std::stable_sort(expected.begin(), expected.end(), nearest::is_nearer);
        const auto most = static_cast<std::size_t>(question.count);
        if (expected.size() > most) expected.resize(most);
    }
    return expected;
}

void check_search(Pairs& pairs, const std::vector<std::ptrdiff_t>& some,
                  const nearest::BlockSize& size) {
    BlockSearch search(*pairs.targets, some, size, pairs.poller);
    std::vector<BlockQuery> queries;
    for (const CheckedCurve& P : pairs.queries) {
        const auto i = static_cast<std::ptrdiff_t>(queries.size());
        queries.push_back({&P, {i, i + 1}});
    }
    for (const std::ptrdiff_t wanted : {1, 3, 200, 0}) {
        nearest::Question question;
        question.count = wanted;
        if (wanted == 0) question.radius = pairs.value(0, some.back());
        search.answer(queries.data(), static_cast<std::ptrdiff_t>(queries.size()), question);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const auto row = static_cast<std::ptrdiff_t>(i);
            const std::vector<Neighbor> expected =
                expected_for(pairs, some, row, queries[i].left_out, question);
            const auto& found = search.found(row);
            CHECK_EQUAL(found.size(), expected.size());
            for (std::size_t k = 0; k < expected.size(); ++k) {
                CHECK_EQUAL(found[k].index, expected[k].index);
                CHECK_EQUAL(found[k].distance, expected[k].distance);
            }
        }
    }
}

void a_search_finds_what_comes_first() {
    Random random(32);
    for (const Case& tested : cases()) {
        for (const int count : {1, 8, 33, 70}) {
            const check::Note note(tested.name + ", " + std::to_string(count) + " targets");
            const std::ptrdiff_t n = 24;
            Pairs pairs(tested.measure, random, count, n, 1 + random.index(5));
            std::vector<std::ptrdiff_t> some;
            for (int j = 0; j < count; ++j) {
                if (j % 7 != 3) some.push_back(j);
            }
            const nearest::BlockSize size{pairs.targets->most_beside(n, n),
                                          pairs.targets->effort_beside(n, n)};
            if (size.lanes > 1) check_search(pairs, some, size);
        }
    }
}

}  // namespace

int main() {
    return check::run({
        {"bounds and values hold", bounds_and_values_hold},
        {"a search finds what comes first", a_search_finds_what_comes_first},
    });
}
