// Every call on long curves can be stopped at every stage: while curves are read, packed, scaled
// and refined, and during the work itself. No test asserts a time. A Control with an interval of 0
// is called at every poll. The tests check the number of polls, and that each of them can end the
// call.
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

constexpr std::ptrdiff_t points = std::ptrdiff_t{1} << 17;

using Call = std::function<void(Control*)>;

// How often `call` looks at its Control.
int polls_of(const Call& call) {
    int polls = 0;
    Control control([&](std::int64_t, std::int64_t) { return ++polls > 0; },
                    std::chrono::milliseconds(0));
    call(&control);
    return polls;
}

// Whether `call` ends where the poll of that number says so, counted from 1.
bool ends_at(const Call& call, int number) {
    int polls = 0;
    Control control([&](std::int64_t, std::int64_t) { return ++polls < number; },
                    std::chrono::milliseconds(0));
    try {
        call(&control);
    } catch (const Stopped&) {
        return polls == number;
    }
    return false;
}

// The least number of polls: one in every 2^16 points, and each point is read at least twice.
constexpr int fewest_polls = 2 * points / (std::ptrdiff_t{1} << 16);

void hears(const std::string& name, const Call& call) {
    const check::Note note(name);
    const int polls = polls_of(call);
    CHECK(polls >= fewest_polls);
    const int step = polls / 4 + 1;
    for (int number = 1; number <= polls; number += step) CHECK(ends_at(call, number));
    CHECK(ends_at(call, polls));
}

// Of two points against many the work is linear, and the reading is most of it.
void single_calls() {
    Random random(3);
    const Curve P = random.walk(points), Q = random.walk(points), few = P.part(0, 2);
    std::vector<double> out(static_cast<std::size_t>(2 * points));
    for_each_measure([&](auto options) {
        if constexpr (std::is_same_v<decltype(options), CurveLengthOptions>) {
            options.scale = LengthScale::range;
        }
        hears(options.measure,
              [&](Control* control) { return evaluate(options, few, Q, control); });
        hears(std::string(options.measure) + ", the other way round",
              [&](Control* control) { return evaluate(options, P, few, control); });
    });
    const AreaOptions by_arc_length{Spacing::arc_length};
    const AreaOptions by_x{Spacing::x}, matched{Spacing::matched};
    const CurveLengthOptions by_range{LengthScale::range};
    hears("area, matched", [&](Control* control) { return area(P, Q, matched, control); });
    for (const Crossing crossing : {Crossing::split, Crossing::polygon}) {
        const AreaOptions closed{Spacing::distance, crossing, false, true};
        hears("area, closed", [&](Control* control) { return area(P, few, closed, control); });
    }
    hears("area by arc length",
          [&](Control* control) { return area(P, Q, by_arc_length, control); });
    hears("area_quads", [&](Control* control) { return area_quads(P, few, {}, control); });
    hears("pcm_match", [&](Control* control) { return pcm_match(P, Q, {2}, control); });
    hears("residuals",
          [&](Control* control) { curve_length_residuals(P, Q, out.data(), by_range, control); });
    hears("dtw_path", [&](Control* control) { return dtw_path(few, Q, {}, control); });
    LowerBoundOptions bounds{Metric::sqeuclidean};
    bounds.window = points / 8;
    const Call bound = [&](Control* control) { return lb_improved(P, Q, bounds, control); };
    hears("lb_improved", bound);
    CHECK(polls_of(bound) > 8 * fewest_polls);  // for each size of its blocks of columns
    hears("common_part",
          [&](Control* control) { return common_part(few, Q, 1.0, {}, control).length; });
    hears("frechet_path", [&](Control* control) { return frechet_path(few, Q, {}, control); });
    DtwOptions window;
    window.window = 1;
    hears("dtw_table", [&](Control* control) { dtw_table(few, Q, out.data(), window, control); });
    hears("sum_of_squares", [&](Control* control) { return sum_of_squares(P, Q, control); });
    hears("gradient of sum_of_squares",
          [&](Control* control) { sum_of_squares_and_gradient(P, Q, out.data(), control); });
    hears("gradient of area",
          [&](Control* control) { value_and_gradient(by_x, P, few, out.data(), control); });
    hears("gradient of dtw",
          [&](Control* control) { value_and_gradient(DtwOptions{}, few, Q, out.data(), control); });
    hears("frechet_continuous_path",
          [&](Control* control) { return frechet_continuous_path(few, Q, {}, control); });
    hears("closed_frechet_continuous",
          [&](Control* control) { return closed_frechet_continuous(few, Q, {}, control); });
    hears("closed_frechet_continuous_path",
          [&](Control* control) { return closed_frechet_continuous_path(few, Q, {}, control); });
    hears("frechet_within",
          [&](Control* control) { return frechet_within(few, Q, 1e9, true, control); });
    hears("mse", [&](Control* control) { return mse(P, Q, control); });
    hears("mae", [&](Control* control) { return mae(P, Q, control); });
    hears("normalize", [&](Control* control) { normalize(P, Q, out.data(), "Q", control); });
}

// A circle once around, as vertices of regular polygons, and many times around.
Curve circle(std::ptrdiff_t turns, std::ptrdiff_t vertices, double radius) {
    Curve points(std::vector<double>(static_cast<std::size_t>(2 * turns * vertices)), 2);
    for (std::ptrdiff_t i = 0; i < points.size(); ++i) {
        const double angle =
            6.283185307179586 * static_cast<double>(i % vertices) / static_cast<double>(vertices);
        points(i, 0) = radius * std::cos(angle);
        points(i, 1) = radius * std::sin(angle);
    }
    return points;
}

// A path around may begin on each turn of the second curve, and none leads once around both: each
// decision tries all turns.
void many_beginnings() {
    constexpr std::ptrdiff_t turns = 3000, vertices = 24;
    const Curve once = circle(1, vertices, 1.0), often = circle(turns, vertices, 1.25);
    const Call call = [&](Control* control) {
        return closed_frechet_continuous(once, often, {}, control);
    };
    hears("many beginnings", call);
    // Of one decision, in which each beginning leads through all rows.
    CHECK(polls_of(call) > turns * vertices * 8 / (1 << 15));
}

void batches() {
    Random random(4);
    const Curve P = random.walk(points), Q = random.walk(2);
    const std::vector<CurveView> rows{P}, columns{Q};
    std::vector<double> out(1);
    for_each_measure([&](auto options) {
        if constexpr (std::is_same_v<decltype(options), CurveLengthOptions>) {
            options.scale = LengthScale::range;
        }
        const std::string name = options.measure;
        hears("check_batch, " + name,
              [&](Control* control) { check_batch(rows, rows, options, control); });
        hears("cdist, " + name,
              [&](Control* control) { cdist(rows, columns, options, out.data(), {}, control); });
        hears("Prepared, " + name,
              [&](Control* control) { return Prepared(P, options, control)(Q, control); });
        hears("Index, " + name, [&](Control* control) { Index(rows, options, control); });
    });
}

// Curves are added while another thread searches; the search, which is stopped later, goes on.
void an_index_that_is_busy() {
    Random random(5);
    const Curve P = random.walk(40'000), Q = random.walk(40'000);  // a second
    Index index({Q}, DtwOptions{});
    std::atomic<bool> is_searching{false}, is_over{false};
    Control search([&](std::int64_t, std::int64_t) { return is_searching = true; },
                   std::chrono::milliseconds(0));
    std::thread searching([&] {
        double distance = 0.0;
        std::int64_t place = 0;
        try {
            index.kneighbors({P}, 1, &distance, &place, {}, &search);
        } catch (const Stopped&) {
            is_over = true;
        }
    });
    while (!is_searching) std::this_thread::yield();
    Control adding;
    index.add({Q}, &adding);
    CHECK(!is_over);
    CHECK_EQUAL(index.size(), std::size_t{2});
    search.stop();
    searching.join();
    CHECK(is_over);
}

// With one thread and with several, at the first report and at a later one.
void what_a_report_throws_ends_the_call() {
    const Curve P = Random(5).curve(3000, 2), Q = Random(6).curve(3000, 2);
    std::vector<double> out(9);
    std::vector<std::int64_t> places(3);
    const std::vector<CurveView> curves{P, Q, P};
    for (const std::ptrdiff_t workers : {1, 2, 3}) {
        DtwOptions options;
        options.prune = false;
        options.workers = workers;
        const Index index(curves, DtwOptions{});
        const std::vector<Call> calls{
            [&](Control* control) { return dtw(P, Q, options, control); },
            [&](Control* control) { return dtw_path(P, Q, options, control); },
            [&](Control* control) {
                cdist(curves, curves, options, out.data(), {workers}, control);
            },
            [&](Control* control) { pdist(curves, options, out.data(), {workers}, control); },
            [&](Control* control) {
                index.kneighbors(curves, 1, out.data(), places.data(), {workers}, control);
            }};
        for (const Call& call : calls) {
            for (const int last : {1, 2}) {
                const check::Note note(std::to_string(workers) + " workers, report " +
                                       std::to_string(last));
                int reports = 0;
                Control control(
                    [&](std::int64_t, std::int64_t) {
                        if (++reports == last) throw std::logic_error("from the report");
                        return true;
                    },
                    std::chrono::milliseconds(0));
                CHECK_THROWS(call(&control), std::logic_error, "from the report");
                CHECK_EQUAL(reports, last);
                CHECK(control.stopped());
            }
        }
    }
}

}  // namespace

int main() {
    return check::run({{"single calls", single_calls},
                       {"many beginnings", many_beginnings},
                       {"batches", batches},
                       {"what a report throws ends the call", what_a_report_throws_ends_the_call},
                       {"an index that is busy", an_index_that_is_busy}});
}
