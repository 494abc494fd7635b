#include "watch.hpp"

#include <algorithm>

namespace curvewise::detail {

Watch::Watch(Control* control, Role role) : control_(control), role_(role) {
    if (control_ != nullptr) next_report_ = Clock::now() + control_->interval_;
}

void Watch::begin(std::int64_t total) noexcept {
    if (control_ == nullptr) return;
    control_->done_.store(0, std::memory_order_relaxed);
    control_->total_.store(total, std::memory_order_relaxed);
}

void Watch::finish() {
    if (control_ == nullptr) return;
    pending_ = 0;
    control_->done_.store(control_->total(), std::memory_order_relaxed);
    report();
    throw_if_stopped();
}

bool Watch::poll() {
    if (control_ == nullptr) return false;
    effort_ = 0;
    pass_on();
    if (role_ == Role::caller && !stopped() && Clock::now() >= next_report_) report();
    return stopped();
}

void Watch::pass_on() noexcept {
    if (control_ == nullptr || pending_ == 0) return;
    control_->done_.fetch_add(pending_, std::memory_order_relaxed);
    pending_ = 0;
}

void Watch::report() {
    const std::int64_t total = control_->total();
    const std::int64_t done = std::min(control_->done(), total);
    if (control_->report_ && !control_->report_(done, total)) {
        control_->stop();
    }
    next_report_ = Clock::now() + control_->interval_;
}

}  // namespace curvewise::detail
