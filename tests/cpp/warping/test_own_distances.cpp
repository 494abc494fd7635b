// Custom distances of the caller. With the distances of a metric, they give its values, paths and
// tables, on both sides of the edges of strips. Also the requested blocks, exceptions, and the
// functions that reject them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using curvewise::BlockDistances;
using curvewise::CurveView;
using curvewise::DtwOptions;
using curvewise::FrechetOptions;
using curvewise::Metric;
using curvewise::StepPattern;
using curvewise::TableBlock;
using test::Curve;
using test::Random;

// Sums of |differences|, as "cityblock" adds them.
BlockDistances cityblock(const Curve& P, const Curve& Q) {
    return [&](const TableBlock& block, double* out) {
        for (std::ptrdiff_t i = 0; i < block.rows; ++i) {
            for (std::ptrdiff_t j = 0; j < block.columns; ++j) {
                double sum = 0.0;
                for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
                    sum += std::abs(P(block.first_row + i, c) - Q(block.first_column + j, c));
                }
                *out++ = sum;
            }
        }
    };
}

template <class Options>
Options with(Options options, const BlockDistances& own) {
    options.ground = {};  // by whose root nothing is taken
    options.ground.own = &own;
    return options;
}

std::vector<DtwOptions> variants(std::ptrdiff_t n, std::ptrdiff_t m) {
    std::vector<DtwOptions> result(5);
    for (DtwOptions& options : result) options.ground = {Metric::cityblock};
    result[1].step_pattern = StepPattern::symmetric2;
    result[2].window = std::max(n, m) / 3 + 1;
    result[3].open_begin = result[3].open_end = true;
    result[4].penalty = 0.5;
    return result;
}

void values_of_pair(const Curve& P, const Curve& Q) {
    const std::ptrdiff_t n = P.size(), m = Q.size();
    const BlockDistances own = cityblock(P, Q);
    const auto cells = static_cast<std::size_t>(n * m);
    std::vector<double> table(cells), expected(cells);
    for (const DtwOptions& options : variants(n, m)) {
        const DtwOptions mine = with(options, own);
        CHECK_EQUAL(dtw(P, Q, mine), dtw(P, Q, options));
        CHECK_EQUAL(dtw_info(P, Q, mine).value, dtw(P, Q, options));
        CHECK(dtw_path(P, Q, mine).path == dtw_path(P, Q, options).path);
        dtw_table(P, Q, table.data(), mine);
        dtw_table(P, Q, expected.data(), options);
        CHECK(table == expected);
    }
    FrechetOptions options;
    options.ground = {Metric::cityblock};
    const FrechetOptions mine = with(options, own);
    CHECK_EQUAL(frechet(P, Q, mine), frechet(P, Q, options));
    CHECK(frechet_path(P, Q, mine).path == frechet_path(P, Q, options).path);
    frechet_table(P, Q, table.data(), mine);
    frechet_table(P, Q, expected.data(), options);
    CHECK(table == expected);
}

void values_of_the_metric() {
    Random random(31);
    for (const std::ptrdiff_t n : {1, 7, 32, 33, 255, 257}) {
        for (const std::ptrdiff_t m : {1, 5, 40, 300}) {
            const std::ptrdiff_t dim = 1 + (n + m) % 4;
            values_of_pair(random.lattice_curve(n, dim), random.lattice_curve(m, dim));
        }
    }
}

void some_rows_are_asked_for() {
    Random random(32);
    const Curve P = random.curve(20, 1), Q = random.curve(1 << 18, 1);
    const BlockDistances one = cityblock(P, Q);
    std::ptrdiff_t rows = 0, most = 0;
    const BlockDistances own = [&](const TableBlock& block, double* out) {
        CHECK_EQUAL(block.first_row, rows);
        rows += block.rows;
        most = std::max(most, block.rows);
        one(block, out);
    };
    DtwOptions options;
    options.workers = 2;
    const double value = dtw(P, Q, options);
    CHECK_EQUAL(dtw(P, Q, with(options, own)), value);
    CHECK_EQUAL(rows, P.size());
    CHECK(most <= 8);  // 2^21 pairs
}

struct OwnError : std::exception {
    const char* what() const noexcept override { return "of my own"; }
};

void exceptions_pass_through() {
    Random random(33);
    const Curve P = random.curve(5, 2), Q = random.curve(300, 2);
    const BlockDistances own = [](const TableBlock&, double*) { throw OwnError(); };
    for (const DtwOptions& options : variants(P.size(), Q.size())) {
        CHECK_THROWS(dtw(P, Q, with(options, own)), OwnError, "of my own");
        CHECK_THROWS(dtw_path(P, Q, with(options, own)), OwnError, "of my own");
    }
    CHECK_THROWS(frechet(P, Q, with(FrechetOptions(), own)), OwnError, "of my own");
}

void others_refuse() {
    Random random(34);
    const Curve P = random.curve(5, 2), Q = random.curve(6, 2);
    const BlockDistances own = cityblock(P, Q);
    const std::vector<CurveView> all{P, Q};
    std::vector<double> out(100);
    const char* const refusal =
        "a ground distance of one's own is for dtw and frechet of one pair of curves, their paths, "
        "tables and infos; nothing else computes with it, or has bounds of it: choose a metric";
    const auto refused = [&](auto call) { CHECK_THROWS(call(), std::invalid_argument, refusal); };
    DtwOptions penalised = with(DtwOptions(), own);
    penalised.penalty = 1.0;
    const curvewise::Measure measures[] = {with(DtwOptions(), own), with(FrechetOptions(), own),
                                           penalised};
    for (const curvewise::Measure& measure : measures) {
        refused([&] { curvewise::cdist(all, measure, out.data()); });
        refused([&] { curvewise::pdist(all, measure, out.data()); });
        refused([&] { curvewise::Prepared(P, measure); });
        refused([&] { curvewise::Index(all, measure); });
    }
    refused([&] { return subsequences(P, Q, 1, with(DtwOptions(), own)); });
    refused([&] { return subsequences(P, Q, 1, with(FrechetOptions(), own)); });
    refused([&] { value_and_gradient(with(DtwOptions(), own), P, Q, out.data()); });
    refused([&] { value_and_gradient(with(FrechetOptions(), own), P, Q, out.data()); });
    refused([&] { return hausdorff(P, Q, with(curvewise::HausdorffOptions(), own)); });
    refused([&] { return evaluate(with(curvewise::ErpOptions(), own), P, Q); });
    refused([&] { return evaluate(with(curvewise::LcssOptions(), own), P, Q); });
    refused([&] { return evaluate(with(curvewise::WdtwOptions(), own), P, Q); });
}

}  // namespace

int main() {
    return check::run({{"values of the metric", values_of_the_metric},
                       {"some rows are asked for", some_rows_are_asked_for},
                       {"exceptions pass through", exceptions_pass_through},
                       {"others refuse", others_refuse}});
}
