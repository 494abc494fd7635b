// Batches against the measures' own functions, to the bit, with any number of threads; what a
// Control hears of a call, and how it ends one.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Curve> random_curves(const std::vector<std::ptrdiff_t>& sizes, std::ptrdiff_t dim) {
    Random random(7);
    std::vector<Curve> curves;
    for (const std::ptrdiff_t n : sizes) curves.push_back(random.curve(n, dim));
    return curves;
}

const std::vector<Measure>& measures() {
    static const std::vector<Measure> all = [] {
        DtwOptions window, open;
        window.window = 30;
        open.open_begin = open.open_end = true;
        return std::vector<Measure>{DtwOptions{},
                                    window,
                                    open,
                                    FrechetOptions{{Metric::cityblock}},
                                    AreaOptions{},
                                    AreaOptions{Spacing::arc_length},
                                    PcmOptions{},
                                    CurveLengthOptions{LengthScale::range},
                                    FrechetContinuousOptions{}};
    }();
    return all;
}

void batches_equal_single_calls() {
    const std::vector<Curve> curves = random_curves({9, 2, 40, 300, 7, 8, 64, 17, 3}, 2);
    const std::vector<CurveView> X = views_of(curves);
    const std::vector<CurveView> some(X.begin(), X.begin() + 4);
    const std::size_t k = X.size();
    for (const Measure& measure : measures()) {
        const check::Note note("measure " + std::to_string(measure.index()));
        std::vector<double> matrix, rectangle, condensed;
        for (const CurveView& P : X) {
            for (const CurveView& Q : X) matrix.push_back(evaluate(measure, P, Q));
            for (const CurveView& Q : some) rectangle.push_back(evaluate(measure, P, Q));
        }
        if (is_symmetric(measure)) {
            for (std::size_t i = 0; i < k; ++i) {
                for (std::size_t j = i + 1; j < k; ++j) {
                    condensed.push_back(matrix[i * k + j]);
                    matrix[j * k + i] = matrix[i * k + j];
                }
            }
        }
        for (const std::ptrdiff_t workers : {1, 2, 3, -1}) {
            const BatchOptions options{workers};
            std::vector<double> out(k * k, -1.0);
            cdist(X, measure, out.data(), options);
            CHECK_EQUAL(out, matrix);
            out.assign(k * some.size(), -1.0);
            cdist(X, some, measure, out.data(), options);
            CHECK_EQUAL(out, rectangle);
            if (!is_symmetric(measure)) continue;
            out.assign(condensed.size(), -1.0);
            pdist(X, measure, out.data(), options);
            CHECK_EQUAL(out, condensed);
        }
        CHECK_EQUAL(cdist(X, measure), matrix);
        CHECK_EQUAL(cdist(X, some, measure), rectangle);
        if (is_symmetric(measure)) CHECK_EQUAL(pdist(X, measure, {2}), condensed);
    }
}

void prepared_equals_single_calls() {
    const std::vector<Curve> curves = random_curves({9, 2, 40, 300, 7}, 2);
    const std::vector<CurveView> X = views_of(curves);
    for (const Measure& measure : measures()) {
        Curve P = curves[2];
        const Prepared prepared(P, measure);
        P(0, 0) = 1e9;  // a copy was taken
        std::vector<double> expected, one_by_one;
        for (const CurveView& Q : X) {
            expected.push_back(evaluate(measure, X[2], Q));
            one_by_one.push_back(prepared(Q));
        }
        CHECK_EQUAL(one_by_one, expected);
        std::vector<double> out(X.size());
        prepared(X, out.data(), {2});
        CHECK_EQUAL(out, expected);
    }
}

void symmetry_is_known() {
    std::vector<int> symmetric;
    for (const Measure& measure : measures()) symmetric.push_back(is_symmetric(measure));
    CHECK_EQUAL(symmetric, (std::vector<int>{1, 1, 0, 1, 1, 0, 0, 0, 1}));
}

// Their number times anything must not overflow, which the undefined-behaviour sanitizer would
// tell.
void any_number_of_workers() {
    const std::vector<Curve> curves = random_curves({40, 50, 60}, 2);
    const std::vector<CurveView> X = views_of(curves);
    const auto most = std::numeric_limits<std::ptrdiff_t>::max();
    for (const Measure& measure : measures()) {
        std::vector<double> one(9), many(9);
        cdist(X, X, measure, one.data(), {1});
        cdist(X, X, measure, many.data(), {most});
        CHECK_EQUAL(many, one);
    }
    DtwOptions options;
    const double value = dtw(X[0], X[1], options);
    options.workers = most;
    CHECK_EQUAL(dtw(X[0], X[1], options), value);
}

// Enough curves that threads take several pairs at a time.
void many_small_curves() {
    std::vector<std::ptrdiff_t> sizes;
    for (std::ptrdiff_t k = 0; k < 101; ++k) sizes.push_back(1 + k * k % 7);
    const std::vector<Curve> curves = random_curves(sizes, 6);
    const std::vector<CurveView> X = views_of(curves);
    const FrechetOptions options;
    std::vector<double> matrix, condensed, out(X.size() * X.size(), -1.0);
    for (std::size_t i = 0; i < X.size(); ++i) {
        for (std::size_t j = 0; j < X.size(); ++j) {
            matrix.push_back(frechet(X[i], X[j]));
            if (i < j) condensed.push_back(matrix.back());
        }
    }
    cdist(X, X, options, out.data());
    CHECK(out == matrix);
    out.assign(condensed.size(), -1.0);
    pdist(X, options, out.data());
    CHECK(out == condensed);
}

// Pairs of 2^24 steps and more are shared by two threads one after the other if they are few, and
// computed side by side if they are many.
void pairs_that_are_worth_all_threads() {
    Random random(5);
    const Curve all = random.curve(4200, 1), other = random.curve(4200, 1),
                small = other.part(0, 9);
    FrechetOptions options;
    options.prune = false;
    for (const std::ptrdiff_t count : {1, 3, 17}) {
        const check::Note note(std::to_string(count) + " large pairs");
        std::vector<CurveView> rows{small};
        for (std::ptrdiff_t k = 0; k < count; ++k)
            rows.emplace_back(all.values().data() + k, 4100, 1);
        std::vector<double> expected;
        for (const CurveView& P : rows) {
            expected.push_back(frechet(P, small, options));
            expected.push_back(frechet(P, other, options));
        }
        std::vector<double> out(expected.size(), -1.0);
        cdist(rows, {small, other}, options, out.data(), {2});
        CHECK_EQUAL(out, expected);
    }
}

void cutoff_gives_infinity() {
    const std::vector<Curve> curves = random_curves({300, 600, 2, 700, 40, 1}, 3);
    const std::vector<CurveView> X = views_of(curves);
    std::vector<double> values(15), cut(15), expected(15);
    for (const Measure& measure : {Measure(DtwOptions{}), Measure(FrechetOptions{})}) {
        pdist(X, measure, values.data());
        for (const double cutoff : values) {
            for (std::size_t i = 0; i < values.size(); ++i) {
                expected[i] = values[i] > cutoff ? infinity : values[i];
            }
            pdist(X, measure, cut.data(), {1, cutoff});
            CHECK_EQUAL(cut, expected);
        }
    }
}

void errors_name_the_curve() {
    const Curve P{{0.0, 0.0}, {1.0, 1.0}}, bad{{0.0, 0.0}, {infinity, 1.0}}, solid{{0.0, 1.0, 2.0}};
    double out[4];
    CHECK_THROWS(pdist({P, bad}, DtwOptions{}, out), std::invalid_argument,
                 "X[1][1, 0] is inf; curves must be finite");
    CHECK_THROWS(cdist({P}, {P, solid}, FrechetOptions{}, out), std::invalid_argument,
                 "XA[0] has shape (2, 2) and XB[1] has shape (1, 3); both need the same number of "
                 "coordinates");
    CHECK_THROWS(pdist({P, P}, PcmOptions{}, out), std::invalid_argument,
                 "pdist needs a measure for which d(P, Q) = d(Q, P), which this one with these "
                 "options is not; use cdist");
    CHECK_THROWS(pdist({P, P}, DtwOptions{}, out, {0}), std::invalid_argument,
                 "workers is 0; give a whole number >= 1, or -1 for all cores");
    CHECK_THROWS(check_batch({P, bad}, DtwOptions{}), std::invalid_argument,
                 "XA[1][1, 0] is inf; curves must be finite");
    check_batch({P, P}, DtwOptions{});
    check_batch(std::vector<CurveView>{}, DtwOptions{});
    CHECK_THROWS(Prepared(P, AreaOptions{})(solid), std::invalid_argument,
                 "P has shape (2, 2) and Q has shape (1, 3); both need the same number of "
                 "coordinates");
}

void reports_go_up_to_the_total() {
    Random random(3);
    const Curve P = random.walk(3000), Q = random.walk(2000);
    for (const std::ptrdiff_t workers : {1, 2}) {
        std::vector<std::int64_t> done;
        Control control(
            [&](std::int64_t so_far, std::int64_t total) {
                CHECK_EQUAL(total, 6'000'000);
                done.push_back(so_far);
                return true;
            },
            std::chrono::milliseconds(0));
        const double value = dtw(P, Q, {}, &control);
        CHECK_EQUAL(value, dtw(P, Q));
        CHECK(done.size() > 10);
        CHECK(std::is_sorted(done.begin(), done.end()));
        CHECK_EQUAL(done.back(), 6'000'000);
        CHECK_EQUAL(control.done(), control.total());
        done.clear();
        std::vector<double> out(1);
        cdist({P}, {Q}, DtwOptions{}, out.data(), {workers}, &control);
        CHECK_EQUAL(out[0], value);
        CHECK_EQUAL(done.back(), 6'000'000);
    }
}

// Calls that would take minutes, each stopped by its own report and by another thread.
void a_stopped_call_throws() {
    Random random(4);
    const Curve P = random.walk(200'000), small = random.walk(100);
    const std::vector<CurveView> many(20'000, small);
    std::vector<double> out(many.size() * (many.size() - 1) / 2);
    FrechetOptions slow{{Metric::minkowski, 3.0}};
    DtwOptions threaded;
    threaded.workers = 3;
    const Curve three = small.part(0, 3);
    const std::vector<CurveView> tiny(20'000, three);
    const std::vector<std::function<void(Control*)>> calls{
        [&](Control* control) { pdist(tiny, AreaOptions{}, out.data(), {2}, control); },
        [&](Control* control) { pdist(tiny, FrechetOptions{}, out.data(), {2}, control); },
        [&](Control* control) { return frechet(P, P, slow, control); },
        [&](Control* control) { return dtw(P, P, threaded, control); },
        [&](Control* control) { return dtw_path(P, P, threaded, control); },
        [&](Control* control) { return pcm(P, P, {100'000'000}, control); },
        [&](Control* control) { pdist(many, slow, out.data(), {1}, control); },
        [&](Control* control) { pdist(many, slow, out.data(), {3}, control); },
        [&](Control* control) { return Prepared(P, slow)(P, control); },
    };
    for (std::size_t c = 0; c < calls.size(); ++c) {
        const check::Note note("call " + std::to_string(c));
        Control by_report([](std::int64_t, std::int64_t) { return false; },
                          std::chrono::milliseconds(1));
        CHECK_THROWS(calls[c](&by_report), Stopped, "stopped before the work was done");
        Control by_thread;
        std::thread other([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            by_thread.stop();
        });
        CHECK_THROWS(calls[c](&by_thread), Stopped, "stopped before the work was done");
        other.join();
        CHECK(by_thread.done() < by_thread.total());
    }
}

// Every layout that two strides can describe, and doubles among them.
void floats_are_computed_in_doubles() {
    std::vector<Curve> curves = random_curves({9, 2, 40, 30, 7}, 2);
    std::vector<std::vector<float>> floats;
    for (Curve& curve : curves) {
        floats.emplace_back();
        for (std::ptrdiff_t c = 0; c < 2; ++c) {
            for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
                floats.back().push_back(static_cast<float>(curve(i, c)));
                curve(i, c) = floats.back().back();
            }
        }
    }
    const std::vector<CurveView> doubles = views_of(curves);
    std::vector<CurveView> X;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        X.emplace_back(floats[k].data(), curves[k].size(), 2, 1, curves[k].size());
    }
    X[2] = doubles[2];
    for (const Measure& measure : measures()) {
        const check::Note note("measure " + std::to_string(measure.index()));
        std::vector<double> expected(25), found(25);
        cdist(doubles, measure, expected.data());
        cdist(X, measure, found.data());
        CHECK_EQUAL(found, expected);
        cdist(X, doubles, measure, found.data());
        CHECK_EQUAL(found, expected);
        Prepared(X[4], measure)(X, found.data());
        CHECK(std::equal(found.begin(), found.begin() + 5, expected.begin() + 20));
        Index known(doubles, measure), index(X, measure);
        std::vector<std::int64_t> known_places(10), places(10);
        known.kneighbors(doubles, 2, expected.data(), known_places.data());
        index.kneighbors(X, 2, found.data(), places.data());
        CHECK_EQUAL(places, known_places);
        CHECK(std::equal(found.begin(), found.begin() + 10, expected.begin()));
    }
    CHECK_THROWS(dtw(X[0], X[1]), std::invalid_argument,
                 "P has floats, which only lists may have; give doubles");
}

// Not 0 by every pattern, nor by every threshold.
void the_diagonal_is_that_of_single_calls() {
    Random random(31);
    DtwOptions knight, no_diagonal, negative;
    knight.own_steps.rows = {{1, 1, 2, -1}, {1, 0, 0, 1}, {2, 2, 1, -1}, {2, 0, 0, 1}};
    no_diagonal.own_steps.rows = {{1, 1, 0, -1}, {1, 0, 0, 1}, {2, 0, 1, -1}, {2, 0, 0, 1}};
    negative.own_steps.rows = {{1, 1, 1, -1}, {1, 0, 0, 1},  {2, 1, 0, -1},
                               {2, 0, 0, -1}, {3, 0, 1, -1}, {3, 0, 0, -1}};
    EdrOptions edr, exact;
    exact.epsilon = 0.0;
    Curve constant = random.curve(5, 2);
    for (std::ptrdiff_t i = 0; i < constant.size(); ++i) constant(i, 0) = constant(i, 1) = 1.0;
    const std::vector<Curve> curves{random.curve(7, 2), constant, random.curve(4, 2)};
    const std::vector<CurveView> X = views_of(curves);
    for (const Measure& measure :
         {Measure(knight), Measure(no_diagonal), Measure(negative), Measure(edr), Measure(exact)}) {
        CHECK(is_symmetric(measure));
        for (const double cutoff : {infinity, 1.5}) {
            std::vector<double> found(9), expected(9);
            cdist(X, measure, found.data(), {1, cutoff});
            cdist(X, X, measure, expected.data(), {1, cutoff});
            CHECK_EQUAL(found, expected);
        }
    }
}

void a_curve_that_was_moved_from_is_a_copy() {
    const Curve P{{0, 0}, {1, 1}}, Q{{0, 1}, {2, 1}};
    Prepared first(P, DtwOptions{});
    const Prepared second = std::move(first);
    CHECK_EQUAL(second(Q), dtw(P, Q));
    CHECK_EQUAL(first(Q), dtw(P, Q));
}

void a_cutoff_may_be_negative_where_distances_are() {
    const Curve P{{0, 0}, {1, 1}}, Q{{0, 1}, {2, 1}};
    DtwOptions negative;
    negative.own_steps.rows = {{1, 1, 1, -1}, {1, 0, 0, -3}};
    const double distance = dtw(P, Q, negative);  // 1 - 3
    CHECK_EQUAL(distance, -2.0);
    for (const auto& [cutoff, expected] :
         {std::pair{-1.0, -2.0}, std::pair{-2.0, -2.0}, std::pair{-2.5, infinity}}) {
        double found = 0.0;
        cdist({P}, {Q}, negative, &found, {1, cutoff});
        CHECK_EQUAL(found, expected);
        DtwOptions cut = negative;
        cut.cutoff = cutoff;
        CHECK_EQUAL(dtw(P, Q, cut), expected);
    }
    double out = 0.0;
    CHECK_THROWS(cdist({P}, {Q}, DtwOptions{}, &out, {1, -1.0}), std::invalid_argument,
                 "cutoff is -1.000000; give a number >= 0");
    CHECK_THROWS(cdist({P}, {Q}, LcssOptions{}, &out, {1, -1.0}), std::invalid_argument,
                 "cutoff is -1.000000; give a number >= 0");
    CHECK_THROWS(cdist({P}, {Q}, negative, &out, {1, std::nan("")}), std::invalid_argument,
                 "cutoff is nan; give a number");
}

}  // namespace

int main() {
    return check::run(
        {{"batches equal single calls", batches_equal_single_calls},
         {"floats are computed in doubles", floats_are_computed_in_doubles},
         {"prepared equals single calls", prepared_equals_single_calls},
         {"symmetry is known", symmetry_is_known},
         {"any number of workers", any_number_of_workers},
         {"many small curves", many_small_curves},
         {"pairs that are worth all threads", pairs_that_are_worth_all_threads},
         {"cutoff gives infinity", cutoff_gives_infinity},
         {"errors name the curve", errors_name_the_curve},
         {"reports go up to the total", reports_go_up_to_the_total},
         {"a stopped call throws", a_stopped_call_throws},
         {"the diagonal is that of single calls", the_diagonal_is_that_of_single_calls},
         {"a curve that was moved from is a copy", a_curve_that_was_moved_from_is_a_copy},
         {"a cutoff may be negative where distances are",
          a_cutoff_may_be_negative_where_distances_are}});
}
