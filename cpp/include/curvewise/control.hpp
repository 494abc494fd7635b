/// \file
/// A way to watch a long call and to stop it. A Control is given to a call as its last argument;
/// stop() may then be called from any thread or from a signal handler, and done() read by any
/// thread. The call looks at it every fraction of a millisecond and, when stopped, ends all its
/// threads and throws Stopped. A call without one pays nothing.
///
///     curvewise::Control control([](std::int64_t done, std::int64_t total) {
///         std::printf("%3.0f %%\r", 100.0 * done / total);
///         return !user_pressed_cancel();
///     });
///     double value = curvewise::dtw(P, Q, {}, &control);
///
/// Work is counted in nominal steps: cells of the table, n m for a pair of n and m points, for dtw
/// and frechet (twice that for a path), and points, n + m for a pair, for the other measures.
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

/// What a call throws whose Control was stopped. Its output arrays are then unspecified.
class CURVEWISE_EXPORT Stopped : public std::runtime_error {
   public:
    Stopped() : std::runtime_error("stopped before the work was done") {}
};

/// One per call at a time; may be used again for another call unless it was stopped.
class Control {
   public:
    /// Called with (done, total) by the thread that made the call, about once an interval while the
    /// work goes on and once when it is done. Returns whether to go on. What it throws stops the
    /// call, with all its threads, which then throws it.
    using Report = std::function<bool(std::int64_t done, std::int64_t total)>;

    Control() = default;
    explicit Control(Report report,
                     std::chrono::milliseconds interval = std::chrono::milliseconds(50))
        : report_(std::move(report)), interval_(interval) {}
    Control(const Control&) = delete;
    Control(Control&&) = delete;
    Control& operator=(const Control&) = delete;
    Control& operator=(Control&&) = delete;
    ~Control() = default;

    void stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }
    bool stopped() const noexcept { return stopped_.load(std::memory_order_relaxed); }
    std::int64_t done() const noexcept { return done_.load(std::memory_order_relaxed); }
    std::int64_t total() const noexcept { return total_.load(std::memory_order_relaxed); }

   private:
    friend class runtime::Poller;

    Report report_;
    std::chrono::milliseconds interval_{50};
    std::atomic<bool> stopped_{false};
    std::atomic<std::int64_t> done_{0};
    std::atomic<std::int64_t> total_{0};
};

}  // namespace curvewise
