// Threads that wait for each other: a strip begins when the one above it has got far enough,
// however long that takes, unless the work is given up meanwhile.
#include <atomic>
#include <chrono>
#include <thread>

#include "check.hpp"
#include "curvewise/control.hpp"
#include "runtime/workers.hpp"

namespace {

using curvewise::Control;
using curvewise::runtime::Pipeline;
using curvewise::runtime::Poller;

constexpr auto longer_than_a_look = std::chrono::milliseconds(50);

void a_strip_waits_for_the_one_above() {
    Pipeline pipeline(2);
    CHECK_EQUAL(pipeline.take(), 0);
    CHECK_EQUAL(pipeline.take(), 1);
    CHECK_EQUAL(pipeline.take(), -1);
    std::atomic<bool> has_waited{false};
    std::thread below([&] {
        Poller poller(nullptr);
        CHECK(pipeline.wait(0, 1000, poller));  // nothing is above
        CHECK(pipeline.wait(1, 7, poller));
        has_waited = true;
    });
    pipeline.publish(0, 6);
    std::this_thread::sleep_for(longer_than_a_look);
    CHECK(!has_waited);
    pipeline.publish(0, 7);
    below.join();
    CHECK(has_waited);
    CHECK(!pipeline.is_finished(0));
    pipeline.finish(0);
    CHECK(pipeline.is_finished(0));
    CHECK(!pipeline.is_finished(1));
}

void a_strip_that_waits_hears_of_a_stop() {
    Pipeline pipeline(2);
    Control control;
    std::thread other([&] {
        std::this_thread::sleep_for(longer_than_a_look);
        control.stop();
    });
    Poller poller(&control);
    CHECK(!pipeline.wait(1, 7, poller));
    other.join();
}

}  // namespace

int main() {
    return check::run({{"a strip waits for the one above", a_strip_waits_for_the_one_above},
                       {"a strip that waits hears of a stop", a_strip_that_waits_hears_of_a_stop}});
}
