#include "runtime/poller.hpp"

#include <algorithm>

namespace curvewise::runtime {

Poller::Poller(Control* control, Role role) : control_(control), role_(role) {
    if (control_ != nullptr) next_report_ = Clock::now() + control_->interval_;
}

void Poller::begin(std::int64_t total) noexcept {
    if (control_ == nullptr) return;
    control_->done_.store(0, std::memory_order_relaxed);
    control_->total_.store(total, std::memory_order_relaxed);
}

void Poller::finish() {
    if (control_ == nullptr) return;
    uncounted_ = 0;
    control_->done_.store(control_->total(), std::memory_order_relaxed);
    report(control_->total());
    throw_if_stopped();
}

bool Poller::poll() {
    if (control_ == nullptr) return false;
    effort_ = 0;
    publish_count();
    // The total is reported once, at the end, because threads may still be at work on counted
    // steps.
    if (role_ == Role::caller && !stopped() && Clock::now() >= next_report_) {
        report(std::max<std::int64_t>(control_->total() - 1, 0));
    }
    return stopped();
}

void Poller::publish_count() noexcept {
    if (control_ == nullptr || uncounted_ == 0) return;
    control_->done_.fetch_add(uncounted_, std::memory_order_relaxed);
    uncounted_ = 0;
}

void Poller::report(std::int64_t most) {
    const std::int64_t done = std::min(control_->done(), most);
    try {
        if (control_->report_ && !control_->report_(done, control_->total())) control_->stop();
    } catch (...) {
        control_->stop();
        if (!is_sharing_) throw;
        failure_ = std::current_exception();
    }
    next_report_ = Clock::now() + control_->interval_;
}

}  // namespace curvewise::runtime
