/// \file
/// Watches a long call and can stop it. A Control is the last argument of a call. Then any thread
/// or a signal handler may call stop(), and any thread may read done(). The call checks the Control
/// every fraction of a millisecond. If it is stopped, the call ends all its threads and throws
/// Stopped. A call without a Control pays nothing.
///
///     curvewise::Control control([](std::int64_t done, std::int64_t total) {
///         std::printf("%3.0f %%\r", 100.0 * done / total);
///         return !user_pressed_cancel();
///     });
///     double value = curvewise::dtw(P, Q, {}, &control);
///
/// Work is counted in nominal steps. For dtw and frechet these are cells of the table, n m for a
/// pair of n and m points (twice that for a path). For the other measures they are points, n + m
/// for a pair.
///
/// A program with a thread pool lends it to a call, which then starts no thread of its own:
///
///     control.run_on([&](std::function<void()> task) { pool.submit(std::move(task)); });
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>

#include "curvewise/export.h"

namespace curvewise {

namespace runtime {
class Poller;
}

/// The exception of a call whose Control was stopped. Its output arrays are then unspecified.
class CURVEWISE_EXPORT Stopped : public std::runtime_error {
   public:
    Stopped() : std::runtime_error("stopped before the work was done") {}
};

/// Serves one call at a time. Can be used again for another call unless it was stopped.
class Control {
   public:
    /// Called with (done, total) by the thread that made the call, about once an interval during
    /// the work and once at its end. Returns whether to continue. An exception stops the call, with
    /// all its threads, and the call then throws it.
    using Report = std::function<bool(std::int64_t done, std::int64_t total)>;

    /// Passes a task to a thread pool, and returns without waiting for it.
    using Executor = std::function<void(std::function<void()> task)>;

    Control() = default;
    explicit Control(Report report,
                     std::chrono::milliseconds interval = std::chrono::milliseconds(50))
        : report_(std::move(report)), interval_(interval) {}
    Control(const Control&) = delete;
    Control(Control&&) = delete;
    Control& operator=(const Control&) = delete;
    Control& operator=(Control&&) = delete;
    ~Control() = default;

    /// Calls with more than one worker give their work to `executor`, as workers - 1 tasks, in the
    /// place of new threads. The thread that makes the call works too, and its call ends when the
    /// work is done. Tasks that begin later return at once. Thus a busy pool makes a call slower,
    /// and a pool whose threads call the library does not deadlock. If `executor` throws, fewer
    /// threads work. Results do not depend on it. Not during a call; an empty function is the
    /// default.
    void run_on(Executor executor) { executor_ = std::move(executor); }

    void stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }
    bool stopped() const noexcept { return stopped_.load(std::memory_order_relaxed); }
    std::int64_t done() const noexcept { return done_.load(std::memory_order_relaxed); }
    std::int64_t total() const noexcept { return total_.load(std::memory_order_relaxed); }

   private:
    friend class runtime::Poller;

    Report report_;
    Executor executor_;
    std::chrono::milliseconds interval_{50};
    std::atomic<bool> stopped_{false};
    std::atomic<std::int64_t> done_{0};
    std::atomic<std::int64_t> total_{0};
};

}  // namespace curvewise
