// A mutex for readers and writers that serves them in the order of their requests. A writer waits
// for the readers before it, and later readers wait for the writer. The system's locks prefer
// readers, and a writer may then wait forever.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <list>
#include <mutex>

namespace curvewise::runtime {

enum class Use { shared, alone };

class FairMutex {
   public:
    // Waits, and calls `must_stop` every 20 ms. Returns whether it has the mutex: not if
    // must_stop() returned true.
    template <class MustStop>
    bool lock(Use use, MustStop&& must_stop) {
        std::unique_lock<std::mutex> inner(mutex_);
        if (queue_.empty() && is_free(use)) {
            take(use);
            return true;
        }
        const Place place(*this, inner);
        using Clock = std::chrono::steady_clock;
        auto next = Clock::now();
        while (!place.is_first() || !is_free(use)) {
            if (Clock::now() < next) {
                changed_.wait_until(inner, next);
                continue;
            }
            inner.unlock();
            if (must_stop()) return false;
            next = Clock::now() + std::chrono::milliseconds(20);
            inner.lock();
        }
        take(use);
        return true;
    }

    void unlock(Use use) noexcept {
        {
            const std::lock_guard<std::mutex> inner(mutex_);
            if (use == Use::shared) {
                --readers_;
            } else {
                has_writer_ = false;
            }
        }
        changed_.notify_all();
    }

   private:
    // A place in the queue, which ends with this.
    class Place {
       public:
        Place(FairMutex& of, std::unique_lock<std::mutex>& inner)
            : of_(of), inner_(inner), own_(of.queue_.insert(of.queue_.end(), 0)) {}
        Place(const Place&) = delete;
        Place(Place&&) = delete;
        Place& operator=(const Place&) = delete;
        Place& operator=(Place&&) = delete;
        ~Place() {
            if (!inner_.owns_lock()) inner_.lock();
            of_.queue_.erase(own_);
            of_.changed_.notify_all();
        }
        bool is_first() const noexcept { return own_ == of_.queue_.begin(); }

       private:
        FairMutex& of_;
        std::unique_lock<std::mutex>& inner_;
        std::list<char>::iterator own_;
    };

    bool is_free(Use use) const noexcept {
        return !has_writer_ && (use == Use::shared || readers_ == 0);
    }
    void take(Use use) noexcept {
        if (use == Use::shared) {
            ++readers_;
        } else {
            has_writer_ = true;
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::list<char> queue_;  // of those that wait
    std::size_t readers_ = 0;
    bool has_writer_ = false;
};

}  // namespace curvewise::runtime
