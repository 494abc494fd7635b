// One thread's side of a Control: counts the steps that the thread has done, adds them to the
// Control's count now and then, and says when to stop. The poller of the thread that made the call
// also makes the reports. Without a Control it does nothing.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <utility>

#include "curvewise/control.hpp"

namespace curvewise::runtime {

class Poller {
   public:
    enum class Role { caller, worker };

    explicit Poller(Control* control, Role role = Role::caller);
    Poller(const Poller&) = delete;
    Poller(Poller&&) = delete;
    Poller& operator=(const Poller&) = delete;
    Poller& operator=(Poller&&) = delete;
    ~Poller() { publish_count(); }

    // For the caller, before and after the work.
    void begin(std::int64_t total) noexcept;
    void finish();

    // Whether to stop. Looks at the Control, and at the clock for whether a report is due.
    bool poll();
    // Counts steps that are done, each as long as `weight` of the shortest there are, and polls
    // when enough have come together. Whether to stop.
    bool count_steps(std::int64_t steps, std::int64_t weight = 1) {
        if (control_ == nullptr) return false;
        if (is_counting_) uncounted_ += steps;
        effort_ += steps * weight;
        if (effort_ < effort_between_polls) return control_->stopped();
        return poll();
    }
    // The same for work that is counted as no step: throws Stopped.
    void spend(std::int64_t effort) {
        if (control_ == nullptr) return;
        effort_ += effort;
        if (effort_ >= effort_between_polls && poll()) throw Stopped();
    }
    // Whether steps are counted (the default), or only lead to polls. Returns the previous setting.
    bool set_counting(bool is_counting) noexcept {
        return std::exchange(is_counting_, is_counting);
    }
    // For a caller that shares its work with other threads, which no exception may leave behind: an
    // exception of a report stops the call and is kept for rethrow_failure(). Returns the previous
    // setting.
    bool set_sharing(bool is_sharing) noexcept { return std::exchange(is_sharing_, is_sharing); }
    void rethrow_failure() {
        if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    }
    // Takes back steps that have been counted, and are to be done again in another way.
    void take_back(std::int64_t steps) noexcept { uncounted_ -= steps; }
    // For loops over points: polls in every 2^16th iteration and throws Stopped.
    void poll_in_loop(std::size_t i) {
        if ((i & 0xffff) == 0 && poll()) throw Stopped();
    }
    // Calls visit(first, end) for one run of 0 .. count - 1 after the other, and polls between
    // them; throws Stopped. A run has about 10^5 elements, and each index counts as `elements`. The
    // inner loop has no polls, so compilers can vectorise it.
    template <class Visit>
    void in_runs(std::ptrdiff_t count, std::ptrdiff_t elements, Visit visit) {
        constexpr std::ptrdiff_t elements_in_a_run = 1 << 17;
        const std::ptrdiff_t length =
            elements_in_a_run / std::clamp<std::ptrdiff_t>(elements, 1, elements_in_a_run);
        for (std::ptrdiff_t first = 0; first < count; first += length) {
            visit(first, first + std::min(length, count - first));
            if (count > length && poll()) throw Stopped();
        }
    }

    bool stopped() const noexcept { return control_ != nullptr && control_->stopped(); }
    void throw_if_stopped() const {
        if (stopped()) throw Stopped();
    }

    Control* control() const noexcept { return control_; }
    // Null where the library starts its own threads.
    const Control::Executor* executor() const noexcept {
        return control_ != nullptr && control_->executor_ ? &control_->executor_ : nullptr;
    }

   private:
    using Clock = std::chrono::steady_clock;

    // About 20 µs of work. Reading the clock, and a write that other threads see, are negligible
    // compared with it.
    static constexpr std::int64_t effort_between_polls = 1 << 15;

    void publish_count() noexcept;
    // Reports the completed steps, or `most` if that is less.
    void report(std::int64_t most);

    Control* control_;
    Role role_;
    bool is_counting_ = true;
    bool is_sharing_ = false;
    std::exception_ptr failure_;
    std::int64_t uncounted_ = 0;
    std::int64_t effort_ = 0;
    Clock::time_point next_report_;
};

}  // namespace curvewise::runtime
