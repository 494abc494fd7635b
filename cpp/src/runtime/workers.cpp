#include "runtime/workers.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
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

// The threads that do the work of a call, besides the one that makes it. Tasks that an executor
// begins late outlive the call, and find only this.
class Crew {
   public:
    // Whether there is still work; leave() follows.
    bool enter() {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (is_closed_) return false;
        ++at_work_;
        return true;
    }

    void leave() {
        const std::lock_guard<std::mutex> lock(mutex_);
        --at_work_;
        left_.notify_one();
    }

    // Waits for those at work. Meanwhile the poller reports, and checks for a stop.
    void close(Poller& poller) {
        std::unique_lock<std::mutex> lock(mutex_);
        is_closed_ = true;
        while (at_work_ > 0) {
            left_.wait_for(lock, nap, [&] { return at_work_ == 0; });
            lock.unlock();
            poller.poll();
            lock.lock();
        }
    }

   private:
    std::mutex mutex_;
    std::condition_variable left_;
    std::ptrdiff_t at_work_ = 0;
    bool is_closed_ = false;
};

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
    const std::shared_ptr<Crew> crew = count > 1 ? std::make_shared<Crew>() : nullptr;
    const bool was_sharing = poller.set_sharing(true);
    std::vector<std::thread> threads;
    try {
        for (std::ptrdiff_t w = 1; w < count; ++w) {
            const auto task = [crew, w, &work, control = poller.control()] {
                if (!crew->enter()) return;
                {
                    Poller own(control, Poller::Role::worker);
                    work(w, own);
                }
                crew->leave();
            };
            if (const Control::Executor* executor = poller.executor()) {
                (*executor)(task);
            } else {
                if (w == 1) threads.reserve(static_cast<std::size_t>(count - 1));
                threads.emplace_back(task);
            }
        }
    } catch (...) {
        // There is no other thread, or no memory to start one. The running threads, and this one,
        // do the work.
    }
    work(0, poller);
    if (crew != nullptr) crew->close(poller);
    for (std::thread& thread : threads) thread.join();
    poller.set_sharing(was_sharing);
    if (!was_sharing) poller.rethrow_failure();
}

void SharedItems::fail() noexcept {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    next_ = count_;
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
