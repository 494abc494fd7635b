// Calls of an Index after it was moved, and calls by the report of its own calls.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

void an_index_that_was_moved_from_is_empty() {
    const Curve P{{0, 0}, {1, 1}};
    Index first({P}, DtwOptions{});
    const Index second = std::move(first);
    CHECK_EQUAL(second.size(), std::size_t{1});
    CHECK_EQUAL(first.size(), std::size_t{0});
    CHECK_EQUAL(first.curves().size(), std::size_t{0});
    const char* const message = "the index has been moved from; make another, or assign one to it";
    double distance = 0.0;
    std::int64_t place = 0;
    CHECK_THROWS(first.add({P}), std::logic_error, message);
    CHECK_THROWS(first.kneighbors({P}, 1, &distance, &place), std::logic_error, message);
    CHECK_THROWS(first.kneighbors(1, &distance, &place), std::logic_error, message);
    CHECK_THROWS(first.radius_neighbors({P}, 1.0), std::logic_error, message);
    CHECK_THROWS(first.radius_neighbors(1.0), std::logic_error, message);
    first = Index({P, P}, DtwOptions{});
    first.add({P});
    CHECK_EQUAL(first.size(), std::size_t{3});
}

// A report may query the index, but not add to it: the call that reports would not see it.
void a_report_does_not_wait_for_its_own_call() {
    const Curve P = Random(13).curve(2000, 2);
    Index index({P, P}, DtwOptions{});
    double distance = 0.0;
    std::int64_t place = -1;
    int reports = 0;
    const auto ask = [&](std::int64_t, std::int64_t) {
        ++reports;
        CHECK_EQUAL(index.size(), std::size_t{2});
        CHECK_EQUAL(index.curves().size(), std::size_t{2});
        index.kneighbors({P.part(0, 5)}, 1, &distance, &place);
        return true;
    };
    const auto add = [&](std::int64_t, std::int64_t) {
        index.add({P});
        return true;
    };
    const char* const message =
        "add was called by the report of a call of the same index, which does not see the curves; "
        "add them after that call";
    const std::chrono::milliseconds often(0);
    double found[2];
    std::int64_t nearest[2];
    for (const std::ptrdiff_t workers : {1, 2}) {
        Control asking(ask, often), adding(add, often), adding_anew(add, often);
        index.kneighbors({P, P}, 1, found, nearest, {workers}, &asking);
        CHECK_THROWS(index.kneighbors({P, P}, 1, found, nearest, {workers}, &adding),
                     std::logic_error, message);
        CHECK_THROWS(index.add({P}, &adding_anew), std::logic_error, message);
        CHECK_EQUAL(index.size(), std::size_t{2});
    }
    CHECK(reports > 2);
    Control asking(ask, often);
    index.add({}, &asking);
    index.add({P});
    CHECK_EQUAL(index.size(), std::size_t{3});
}

// The system's lock for readers and writers lets no add() in while searches overlap.
void add_gets_in_while_others_ask() {
    Random random(14);
    const Curve P = random.curve(60, 2);
    Index index({P, P}, DtwOptions{});
    for (const int threads : {1, 3, 6}) {
        std::atomic<bool> is_done{false};
        std::atomic<int> answers{0};
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        std::vector<std::thread> asking;
        for (int t = 0; t < threads; ++t) {
            asking.emplace_back([&] {
                double distance = 0.0;
                std::int64_t place = 0;
                while (!is_done && std::chrono::steady_clock::now() < end) {
                    index.kneighbors({P}, 1, &distance, &place);
                    ++answers;
                }
            });
        }
        while (answers < threads) std::this_thread::yield();
        const std::size_t before = index.size();
        for (int i = 0; i < 20; ++i) index.add({P.part(0, 20)});
        CHECK_EQUAL(index.size(), before + 20);
        CHECK(std::chrono::steady_clock::now() < end);
        is_done = true;
        for (std::thread& thread : asking) thread.join();
    }
}

// A search that lasts keeps no other call waiting, and sees the curves that were there at first.
void a_search_and_an_add_do_not_wait_for_each_other() {
    const Curve P = Random(15).curve(300, 2), Q = Random(16).curve(20, 2);
    Index index({P, P}, DtwOptions{});
    std::atomic<bool> is_asking{false}, may_end{false};
    Control slow(
        [&](std::int64_t, std::int64_t) {
            is_asking = true;
            while (!may_end) std::this_thread::yield();
            return true;
        },
        std::chrono::milliseconds(0));
    double found[4];
    std::int64_t nearest[4];
    std::thread search([&] {
        index.kneighbors({P, Q}, 2, found, nearest, SearchOptions{}, &slow);
    });
    while (!is_asking) std::this_thread::yield();
    index.add({Q});
    CHECK_EQUAL(index.size(), std::size_t{3});
    double distance = -1.0;
    std::int64_t place = -1;
    index.kneighbors({Q}, 1, &distance, &place);
    CHECK_EQUAL(distance, 0.0);
    CHECK_EQUAL(place, std::int64_t{2});
    may_end = true;
    search.join();
    for (int i = 0; i < 4; ++i) CHECK_EQUAL(nearest[i], std::int64_t{i % 2});
    CHECK_EQUAL(found[2], dtw(Q, P));
}

// Each curve is nearer to the query than all before. So an answer says how many curves the search
// has seen: no fewer than there were before it, and no more than after it.
void check_answers_while_others_add(const Measure& measure) {
    const std::ptrdiff_t first = 5, all = 1200;  // enough for trees that are merged

    std::vector<Curve> curves;
    for (std::ptrdiff_t j = 0; j < all; ++j) {
        const double up = static_cast<double>(all - j) / static_cast<double>(all);
        curves.push_back({{0, up}, {0.5, up}, {1, up}});
        if (j < all / 2) curves.back() = {{0, up}, {0.25, up}, {0.5, up}, {1, up}};
    }
    const Curve Q{{0, 0}, {0.5, 0}, {1, 0}};
    const std::vector<CurveView> views(curves.begin(), curves.end());
    std::vector<double> expected(views.size());
    cdist({Q}, views, measure, expected.data());
    Index index({views.begin(), views.begin() + first}, measure);
    std::vector<std::thread> asking;
    std::atomic<bool> is_done{false};
    for (int t = 0; t < 2; ++t) {
        asking.emplace_back([&] {
            double distance[2];
            std::int64_t place[2];
            for (bool is_last = false; !is_last;) {
                is_last = is_done;
                const auto before = static_cast<std::int64_t>(index.size());
                index.kneighbors({Q}, 2, distance, place);
                const std::vector<std::vector<Neighbor>> within =
                    index.radius_neighbors({Q}, expected[0], {1, false});
                const auto after = static_cast<std::int64_t>(index.size());
                CHECK(before <= place[0] + 1 && place[0] < after);
                for (const int k : {0, 1}) {
                    CHECK_EQUAL(place[k], place[0] - k);
                    CHECK_EQUAL(distance[k], expected[static_cast<std::size_t>(place[k])]);
                }
                CHECK(within[0].size() > static_cast<std::size_t>(place[0]));
                for (std::size_t j = 0; j < within[0].size(); ++j) {
                    CHECK_EQUAL(within[0][j].index, static_cast<std::int64_t>(j));
                }
            }
        });
    }
    std::ptrdiff_t next = first;
    for (std::ptrdiff_t more = 1; next < all; more = more % 7 + 1) {
        const std::ptrdiff_t end = std::min(next + more, all);
        index.add({views.begin() + next, views.begin() + end});
        next = end;
    }
    is_done = true;
    for (std::thread& thread : asking) thread.join();
    CHECK_EQUAL(index.size(), views.size());
}

void answers_are_those_of_the_curves_that_were_there() {
    DtwOptions on_sphere;
    on_sphere.ground.metric = Metric::haversine;
    const Measure measures[] = {DtwOptions{}, on_sphere, FrechetOptions{},
                                FrechetContinuousOptions{}, AreaOptions{}};
    for (std::size_t k = 0; k < std::size(measures); ++k) {
        const check::Note note("measure " + std::to_string(k));
        check_answers_while_others_add(measures[k]);
    }
}

}  // namespace

int main() {
    return check::run(
        {{"an index that was moved from is empty", an_index_that_was_moved_from_is_empty},
         {"a report does not wait for its own call", a_report_does_not_wait_for_its_own_call},
         {"add gets in while others ask", add_gets_in_while_others_ask},
         {"a search and an add do not wait for each other",
          a_search_and_an_add_do_not_wait_for_each_other},
         {"answers are those of the curves that were there",
          answers_are_those_of_the_curves_that_were_there}});
}
