// Threads for one call: started for it and joined before it returns, or lent by the executor of its
// Control. No work outlives a call and nothing is shared between calls, so that calls may be made
// from any number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

#include "runtime/poller.hpp"

namespace curvewise::runtime {

// The number of threads for `workers`: -1 is one per core. Throws std::invalid_argument for 0 and
// for numbers below -1.
std::ptrdiff_t resolve_workers(std::ptrdiff_t workers);

// Calls work(w, poller) for w = 0, 1, ... in up to `count` threads. This thread is 0 and has
// `poller`; the other threads have their own pollers. If the system refuses a thread, or the
// executor has none, fewer threads do the work, so `work` must share itself out: what has not begun
// when work(0) returns is left out. `work` must not throw. An exception of a report is thrown when
// all threads have ended.
using Work = std::function<void(std::ptrdiff_t w, Poller& poller)>;
void run_workers(std::ptrdiff_t count, Poller& poller, const Work& work);

// What the threads of for_each() share.
class SharedItems {
   public:
    explicit SharedItems(std::size_t count) noexcept : count_(count) {}

    // The next item, or `count`.
    std::size_t take() noexcept { return std::min(next_++, count_); }
    // Gives up the items that are left, for the exception that is being handled.
    void fail() noexcept;
    void rethrow_failure() const {
        if (failure_) std::rethrow_exception(failure_);
    }

   private:
    std::size_t count_;
    std::atomic<std::size_t> next_{0};
    std::mutex mutex_;
    std::exception_ptr failure_;  // the first
};

// Shares 0 .. count - 1 out among up to `workers` threads, in ascending order. Each thread calls
// begin(poller) once, and the function that this returns for one item after the other. An exception
// ends the work of all threads, and is thrown when they have ended.
template <class Begin>
void for_each(std::size_t count, std::ptrdiff_t workers, Poller& poller, const Begin& begin) {
    SharedItems items(count);
    const auto take_items = [&](std::ptrdiff_t /*w*/, Poller& own) {
        try {
            auto visit = begin(own);
            for (std::size_t i = items.take(); i < count; i = items.take()) visit(i);
        } catch (...) {
            items.fail();
        }
    };
    // By reference: a copy of what it captures would be allocated.
    run_workers(std::min(workers, static_cast<std::ptrdiff_t>(count)), poller,
                std::cref(take_items));
    items.rethrow_failure();
}

// Strips handed out from top to bottom, each following the one above it. A strip is taken only
// after the one above it, by a thread that continues until the strip is finished, so that waiting
// always ends.
class Pipeline {
   public:
    explicit Pipeline(std::ptrdiff_t strips);

    // The next strip, or -1.
    std::ptrdiff_t take() noexcept;
    // Until the strip above `strip` has finished `columns` columns. Looks for some microseconds,
    // then sleeps. False where the work was given up meanwhile.
    bool wait(std::ptrdiff_t strip, std::ptrdiff_t columns, Poller& poller);
    void publish(std::ptrdiff_t strip, std::ptrdiff_t columns);
    void finish(std::ptrdiff_t strip);
    // Whether a strip is finished, as all above the first one are.
    bool is_finished(std::ptrdiff_t strip) const noexcept;

   private:
    // Has a separate cache line, because one thread writes it and another reads it.
    struct alignas(64) FinishedColumns {
        std::atomic<std::ptrdiff_t> columns{0};
    };
    bool reached(std::ptrdiff_t strip, std::ptrdiff_t columns) const noexcept;

    std::vector<FinishedColumns> strips_;
    std::atomic<std::ptrdiff_t> next_{0};
    std::mutex mutex_;
    std::condition_variable moved_;
};

}  // namespace curvewise::runtime
