#include "runtime/workers.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

namespace curvewise::runtime {
namespace {

// How long a thread that waits for another sleeps at most before it looks at its poller.
constexpr std::chrono::milliseconds nap(20);

// Tests before a waiting thread sleeps: about 50 µs, which may be less than the time to wake it up.
// Each test yields its core to other threads.
constexpr int looks = 200;

}  // namespace

std::ptrdiff_t resolve_workers(std::ptrdiff_t workers) {
    if (workers == -1) return std::max(1U, std::thread::hardware_concurrency());
    if (workers < 1) {
        throw std::invalid_argument("workers is " + std::to_string(workers) +
                                    "; give a whole number >= 1, or -1 for all cores");
    }
    // More than the cores of any machine, but small enough that products with it do not overflow.
    constexpr std::ptrdiff_t most = 1 << 14;
    return std::min(workers, most);
}

void run_workers(std::ptrdiff_t count, Poller& poller, const Work& work) {
    std::vector<std::thread> threads;
    if (count > 1) threads.reserve(static_cast<std::size_t>(count - 1));
    std::mutex mutex;
    std::condition_variable ended;
    std::size_t at_work = 0;
    const auto run = [&](std::ptrdiff_t w) {
        {
            Poller own(poller.control(), Poller::Role::worker);
            work(w, own);
        }
        const std::lock_guard<std::mutex> lock(mutex);
        --at_work;
        ended.notify_one();
    };
    const bool was_sharing = poller.set_sharing(true);
    try {
        for (std::ptrdiff_t w = 1; w < count; ++w) {
            {
                const std::lock_guard<std::mutex> lock(mutex);
                ++at_work;
            }
            threads.emplace_back(run, w);
        }
    } catch (const std::exception&) {
        // The system refuses another thread (std::system_error), or the memory to start one
        // (std::bad_alloc). The running threads, and this one, do the work.
        const std::lock_guard<std::mutex> lock(mutex);
        --at_work;
    }
    work(0, poller);
    // Not joined at once: the poller continues to report, and to check for a stop, until the end.
    for (std::unique_lock<std::mutex> lock(mutex); at_work > 0;) {
        ended.wait_for(lock, nap, [&] { return at_work == 0; });
        lock.unlock();
        poller.poll();
        lock.lock();
    }
    for (std::thread& thread : threads) thread.join();
    poller.set_sharing(was_sharing);
    if (!was_sharing) poller.rethrow_failure();
}

Pipeline::Pipeline(std::ptrdiff_t strips) : strips_(static_cast<std::size_t>(strips)) {}

std::ptrdiff_t Pipeline::take() noexcept {
    const std::ptrdiff_t strip = next_.fetch_add(1, std::memory_order_relaxed);
    return strip < static_cast<std::ptrdiff_t>(strips_.size()) ? strip : -1;
}

bool Pipeline::reached(std::ptrdiff_t strip, std::ptrdiff_t columns) const noexcept {
    const FinishedColumns& above = strips_[static_cast<std::size_t>(strip - 1)];
    return above.columns.load(std::memory_order_acquire) >= columns;
}

bool Pipeline::wait(std::ptrdiff_t strip, std::ptrdiff_t columns, Poller& poller) {
    if (strip == 0) return true;
    for (int i = 0; i < looks; ++i) {
        if (reached(strip, columns)) return true;
        std::this_thread::yield();
    }
    for (;;) {
        {
            std::unique_lock<std::mutex> lock(mutex_);
            if (moved_.wait_for(lock, nap, [&] { return reached(strip, columns); })) return true;
        }
        if (poller.poll()) return false;
    }
}

void Pipeline::publish(std::ptrdiff_t strip, std::ptrdiff_t columns) {
    {
        // Under the lock, so that no waiter misses it between its look and its sleep.
        const std::lock_guard<std::mutex> lock(mutex_);
        strips_[static_cast<std::size_t>(strip)].columns.store(columns, std::memory_order_release);
    }
    moved_.notify_all();
}

void Pipeline::finish(std::ptrdiff_t strip) {
    publish(strip, std::numeric_limits<std::ptrdiff_t>::max());
}

bool Pipeline::is_finished(std::ptrdiff_t strip) const noexcept {
    return strip < 0 || reached(strip + 1, std::numeric_limits<std::ptrdiff_t>::max());
}

}  // namespace curvewise::runtime
