// One thread's side of a Control: counts what the thread has done, passes it on in lumps, and says
// when to stop. The watch of the thread that made the call also makes the reports. Without a
// Control it does nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "curvewise/control.hpp"

namespace curvewise::detail {

class Watch {
   public:
    enum class Role { caller, worker };

    explicit Watch(Control* control, Role role = Role::caller);
    Watch(const Watch&) = delete;
    Watch(Watch&&) = delete;
    Watch& operator=(const Watch&) = delete;
    Watch& operator=(Watch&&) = delete;
    ~Watch() { pass_on(); }

    // For the caller, before and after the work.
    void begin(std::int64_t total) noexcept;
    void finish();

    // `steps` more are done, each as long as `weight` of the shortest there are. Whether to stop.
    bool step(std::int64_t steps, std::int64_t weight = 1) {
        if (control_ == nullptr) return false;
        pending_ += steps;
        effort_ += steps * weight;
        if (effort_ < lump) return control_->stopped();
        return poll();
    }
    // For loops over points: polls in every 2^16th turn and throws Stopped.
    void turn(std::size_t i) {
        if ((i & 0xffff) == 0 && poll()) throw Stopped();
    }
    // Whether to stop; reports if it is time to.
    bool poll();
    bool stopped() const noexcept { return control_ != nullptr && control_->stopped(); }
    void throw_if_stopped() const {
        if (stopped()) throw Stopped();
    }

    Control* control() const noexcept { return control_; }

   private:
    using Clock = std::chrono::steady_clock;

    // Some 20 µs of work: a look at the clock, and a write that other threads see, are nothing
    // beside it.
    static constexpr std::int64_t lump = 1 << 15;

    void pass_on() noexcept;
    void report();

    Control* control_;
    Role role_;
    std::int64_t pending_ = 0;
    std::int64_t effort_ = 0;
    Clock::time_point next_report_;
};

}  // namespace curvewise::detail
