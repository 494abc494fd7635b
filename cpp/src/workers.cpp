#include "workers.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

namespace curvewise::detail {
namespace {

// Looks before a waiting thread sleeps: some 50 µs, which is less than waking it up may take. Each
// offers its core to whoever else wants it.
constexpr int looks = 200;

}  // namespace

std::ptrdiff_t resolve_workers(std::ptrdiff_t workers) {
    if (workers == -1) return std::max(1U, std::thread::hardware_concurrency());
    if (workers < 1) {
        throw std::invalid_argument("workers is " + std::to_string(workers) +
                                    "; give a whole number >= 1, or -1 for all cores");
    }
    return workers;
}

void run_workers(std::ptrdiff_t count, const std::function<void(std::ptrdiff_t)>& work) {
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(count));
    try {
        for (std::ptrdiff_t w = 1; w < count; ++w) threads.emplace_back(work, w);
    } catch (const std::system_error&) {
        // The system gives no more threads; those there are, and this one, do the work.
    }
    work(0);
    for (std::thread& thread : threads) thread.join();
}

Pipeline::Pipeline(std::ptrdiff_t strips) : progress_(static_cast<std::size_t>(strips)) {}

std::ptrdiff_t Pipeline::take() noexcept {
    const std::ptrdiff_t strip = next_.fetch_add(1, std::memory_order_relaxed);
    return strip < static_cast<std::ptrdiff_t>(progress_.size()) ? strip : -1;
}

bool Pipeline::reached(std::ptrdiff_t strip, std::ptrdiff_t columns) const noexcept {
    const Progress& above = progress_[static_cast<std::size_t>(strip - 1)];
    return above.columns.load(std::memory_order_acquire) >= columns;
}

void Pipeline::wait(std::ptrdiff_t strip, std::ptrdiff_t columns) {
    if (strip == 0) return;
    for (int i = 0; i < looks; ++i) {
        if (reached(strip, columns)) return;
        std::this_thread::yield();
    }
    std::unique_lock<std::mutex> lock(mutex_);
    moved_.wait(lock, [&] { return reached(strip, columns); });
}

void Pipeline::publish(std::ptrdiff_t strip, std::ptrdiff_t columns) {
    {
        // Under the lock, so that no waiter misses it between its look and its sleep.
        const std::lock_guard<std::mutex> lock(mutex_);
        progress_[static_cast<std::size_t>(strip)].columns.store(columns,
                                                                 std::memory_order_release);
    }
    moved_.notify_all();
}

void Pipeline::finish(std::ptrdiff_t strip) {
    publish(strip, std::numeric_limits<std::ptrdiff_t>::max());
}

}  // namespace curvewise::detail
