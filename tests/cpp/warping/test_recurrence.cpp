// Recurrences as data: values, paths and tables against the recurrence itself, cell by cell, on
// both sides of the edges of strips; and errors.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/block_distances.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/edit_distances.hpp"
#include "curvewise/recurrence.hpp"
#include "curvewise/step_pattern.hpp"

namespace {

using curvewise::CostFrom;
using curvewise::Recurrence;
using curvewise::Step;
using curvewise::StepTerm;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

double ground(const Curve& P, std::ptrdiff_t i, const Curve& Q, std::ptrdiff_t j) {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
        const double d = P(i, c) - Q(j, c);
        sum += d * d;
    }
    return std::sqrt(sum);
}

// Of steps without gaps or borders, as all step patterns are.
std::vector<double> written_down(const std::vector<Step>& steps, const Curve& P, const Curve& Q) {
    const std::ptrdiff_t n = P.size(), m = Q.size();
    std::vector<double> table(static_cast<std::size_t>(n * m), infinity);
    const auto cell = [&](std::ptrdiff_t i, std::ptrdiff_t j) -> double& {
        return table[static_cast<std::size_t>(i * m + j)];
    };
    cell(0, 0) = ground(P, 0, Q, 0);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t j = 0; j < m; ++j) {
            for (const Step& step : steps) {
                if (i < step.rows || j < step.columns) continue;
                double sum = cell(i - step.rows, j - step.columns) + step.constant;
                for (const StepTerm& term : step.terms) {
                    sum += term.weight * ground(P, i - term.rows, Q, j - term.columns);
                }
                cell(i, j) = std::min(cell(i, j), sum);
            }
        }
    }
    return table;
}

// Two steps of two rows or columns; one has a cost.
Recurrence own_recurrence() {
    Recurrence result{"own",
                      {{1, 1, 0.0, {{0, 0, 2.0}}},
                       {2, 1, 0.0, {{1, 0, 1.0}, {0, 0, 0.5}}},
                       {1, 2, 0.25, {{0, 1, 1.5}, {0, 0, 1.0}}}},
                      {}};
    return result;
}

void own_steps() {
    Random random(5);
    const Recurrence recurrence = own_recurrence();
    for (const std::ptrdiff_t n : {1, 2, 60, 255, 256, 257, 300}) {
        const Curve P = random.curve(n, 2), Q = random.curve(std::max<std::ptrdiff_t>(1, n - 7), 2);
        const std::vector<double> expected = written_down(recurrence.steps, P, Q);
        std::vector<double> table(expected.size());
        warp_table(recurrence, P, Q, table.data());
        CHECK_EQUAL(table, expected);
        CHECK_EQUAL(warp(recurrence, P, Q), expected.back());
        if (expected.back() == infinity) continue;
        const curvewise::Alignment alignment = warp_path(recurrence, P, Q);
        CHECK_EQUAL(alignment.distance, expected.back());
        CHECK_EQUAL(alignment.path.back()[0], static_cast<std::int64_t>(n - 1));
    }
}

void the_steps_of_dtw_give_its_bits() {
    Random random(6);
    const Curve P = random.curve(300, 3), Q = random.curve(280, 3);
    const Recurrence recurrence{
        "plain",
        {{1, 1, 0.0, {{0, 0, 1.0}}}, {1, 0, 0.0, {{0, 0, 1.0}}}, {0, 1, 0.0, {{0, 0, 1.0}}}},
        {}};
    CHECK_EQUAL(warp(recurrence, P, Q), curvewise::dtw(P, Q));
}

// They are compiled, and steps add their common terms once: the bits stay those of the rows.
void all_named_patterns() {
    Random random(6);
    const Curve P = random.curve(61, 2), Q = random.curve(59, 2);
    for (const curvewise::StepSet& pattern : curvewise::step_patterns) {
        const Recurrence recurrence{pattern.name, steps_of(step_rows(pattern)), {}};
        const std::vector<double> expected = written_down(recurrence.steps, P, Q);
        std::vector<double> table(expected.size());
        warp_table(recurrence, P, Q, table.data());
        CHECK_EQUAL(table, expected);
        CHECK_EQUAL(warp(recurrence, P, Q), expected.back());
    }
}

void named_patterns() {
    Random random(7);
    const Curve P = random.curve(40, 2), Q = random.curve(37, 2);
    curvewise::DtwOptions options;
    options.step_pattern = curvewise::StepPattern::symmetricP0;
    const double same = dtw(P, Q, options);
    options.step_pattern = curvewise::StepPattern::symmetric2;
    CHECK_CLOSE(same, dtw(P, Q, options), 1e-12);
    options.step_pattern = curvewise::StepPattern::rigid;
    CHECK_EQUAL(dtw(P, Q, options), infinity);
}

// For steps that admit no path; also for a path found in several parts, each with its own table.
void a_path_of_an_infinite_value() {
    curvewise::DtwOptions options;
    options.step_pattern = curvewise::StepPattern::rigid;
    for (const std::ptrdiff_t n : {2, 3000}) {
        const Curve P = Random(8).curve(n, 1), Q = Random(9).curve(n + 1, 1);
        const curvewise::Alignment none = dtw_path(P, Q, options);
        CHECK_EQUAL(none.distance, infinity);
        CHECK(none.path.empty());
    }
    // The distance of its first points alone makes every path infinite.
    const curvewise::BlockDistances blocked = [](const curvewise::TableBlock& block, double* out) {
        std::fill_n(out, block.rows * block.columns, 1.0);
        if (block.first_row == 0 && block.first_column == 0) *out = infinity;
    };
    curvewise::DtwOptions limited;
    limited.step_pattern = curvewise::StepPattern::symmetricP1;
    limited.ground.own = &blocked;
    for (const std::ptrdiff_t n : {4, 3000}) {
        const Curve P = Random(8).curve(n, 1), Q = Random(9).curve(n - n / 8, 1);
        const curvewise::Alignment found = dtw_path(P, Q, limited);
        CHECK_EQUAL(found.distance, infinity);
        CHECK(found.path.front() == (std::array<std::int64_t, 2>{0, 0}));
        CHECK(found.path.back() == (std::array<std::int64_t, 2>{P.size() - 1, Q.size() - 1}));
        for (std::size_t k = 1; k < found.path.size(); ++k) {
            const auto rows = found.path[k][0] - found.path[k - 1][0];
            const auto columns = found.path[k][1] - found.path[k - 1][1];
            CHECK(rows >= 0 && rows <= 1 && columns >= 0 && columns <= 1 && rows + columns > 0);
        }
    }
}

// A cutoff changes no path; above a negative value it gives up nothing.
void negative_weights() {
    Random random(10);
    Recurrence recurrence{
        "negative",
        {{1, 1, 0.0, {{0, 0, -1.0}}}, {1, 0, 0.0, {{0, 0, 2.0}}}, {0, 1, 0.0, {{0, 0, 2.0}}}},
        {}};
    for (const std::ptrdiff_t n : {5, 300, 520}) {
        const Curve P = random.curve(n, 2), Q = random.curve(n - n / 100, 2);
        const double value = written_down(recurrence.steps, P, Q).back();
        CHECK(value < 0.0);
        for (const double cutoff : {infinity, 0.0, value, value - 1.0}) {
            recurrence.cutoff = cutoff;
            CHECK_EQUAL(warp(recurrence, P, Q), value <= cutoff ? value : infinity);
            CHECK_EQUAL(warp_path(recurrence, P, Q).distance, value);
        }
    }
    // What one term adds another takes away again: an infinite distance is infinite all the same.
    const curvewise::BlockDistances blocked = [](const curvewise::TableBlock& block, double* out) {
        std::fill_n(out, block.rows * block.columns, infinity);
        if (block.first_row == 0) *out = 1.0;
    };
    const Curve P = random.curve(3, 1), Q = random.curve(3, 1);
    Recurrence differences{"differences", {{1, 1, 0.0, {{0, 0, 1.0}, {0, 0, -1.0}}}}, {}};
    differences.ground.own = &blocked;
    CHECK_EQUAL(warp(differences, P, Q), infinity);
    differences.steps.front().terms = {{0, 0, -1.0}};
    CHECK_EQUAL(warp(differences, P, Q), infinity);
    differences.steps.front().terms = {{0, 0, 0.0}};  // takes no part
    CHECK_EQUAL(warp(differences, P, Q), 1.0);
}

// By hand: 1, 2 against 1, 2, 4, where the 4 is left out.
void edit_distances() {
    const Curve P{{1.0}, {2.0}}, Q{{1.0}, {2.0}, {4.0}};
    CHECK_EQUAL(evaluate(curvewise::ErpOptions{}, P, Q), 4.0);
    curvewise::EdrOptions edr;
    edr.epsilon = 0.5;
    CHECK_CLOSE(evaluate(edr, P, Q), 1.0 / 3.0, 1e-15);
    curvewise::LcssOptions lcss;
    lcss.epsilon = 0.5;
    CHECK_EQUAL(evaluate(lcss, P, Q), 0.0);
    CHECK_EQUAL(evaluate(curvewise::MsmOptions{}, P, Q), 3.0);
}

void messages() {
    const Curve P{{1.0}, {2.0}};
    Recurrence far = own_recurrence();
    far.steps.push_back({9, 1, 0.0, {}});
    CHECK_THROWS(warp(far, P, P), std::invalid_argument,
                 "step 4 of the pattern is longer than 8 rows or columns; make it shorter");
}

}  // namespace

int main() {
    return check::run({{"own steps", own_steps},
                       {"the steps of dtw", the_steps_of_dtw_give_its_bits},
                       {"all named patterns", all_named_patterns},
                       {"named patterns", named_patterns},
                       {"a path of an infinite value", a_path_of_an_infinite_value},
                       {"negative weights", negative_weights},
                       {"edit distances", edit_distances},
                       {"messages", messages}});
}
