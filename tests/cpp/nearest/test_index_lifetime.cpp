// Calls of an Index after it was moved, and calls by the report of its own calls.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <stdexcept>
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

// A report may query the index, but not add to it: adding would wait for the end of the call that
// reports.
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
        "add was called by the report of a call of the same index, for whose end it would wait; "
        "add the curves after that call";
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

// add() waits for a search; a Control stops it, and it has added nothing.
void a_control_stops_an_add_that_waits() {
    const Curve P = Random(15).curve(300, 2);
    Index index({P, P}, DtwOptions{});
    std::atomic<bool> is_asking{false}, may_end{false};
    Control slow(
        [&](std::int64_t, std::int64_t) {
            is_asking = true;
            while (!may_end) std::this_thread::yield();
            return true;
        },
        std::chrono::milliseconds(0));
    std::thread search([&] {
        double found[2];
        std::int64_t nearest[2];
        index.kneighbors({P, P}, 1, found, nearest, {}, &slow);
    });
    while (!is_asking) std::this_thread::yield();
    Control stopped;
    std::thread watch([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        stopped.stop();
    });
    bool has_thrown = false;
    try {
        index.add({P}, &stopped);
    } catch (const Stopped&) {
        has_thrown = true;
    }
    watch.join();
    CHECK(has_thrown);
    may_end = true;
    search.join();
    CHECK_EQUAL(index.size(), std::size_t{2});
    index.add({P});
    CHECK_EQUAL(index.size(), std::size_t{3});
}

}  // namespace

int main() {
    return check::run(
        {{"an index that was moved from is empty", an_index_that_was_moved_from_is_empty},
         {"a report does not wait for its own call", a_report_does_not_wait_for_its_own_call},
         {"add gets in while others ask", add_gets_in_while_others_ask},
         {"a control stops an add that waits", a_control_stops_an_add_that_waits}});
}
