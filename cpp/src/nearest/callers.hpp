// The threads that run calls of an index, so that a call is refused that a report of another makes.
#pragma once

#include <algorithm>
#include <mutex>
#include <thread>
#include <vector>

namespace curvewise::nearest {

// A thread is listed once for each of its calls.
class Callers {
   public:
    void add() {
        const std::lock_guard<std::mutex> lock(mutex_);
        threads_.push_back(std::this_thread::get_id());
    }
    void remove() noexcept {
        const std::lock_guard<std::mutex> lock(mutex_);
        threads_.erase(std::find(threads_.begin(), threads_.end(), std::this_thread::get_id()));
    }
    bool have_this_thread() const {
        const std::lock_guard<std::mutex> lock(mutex_);
        const auto end = threads_.end();
        return std::find(threads_.begin(), end, std::this_thread::get_id()) != end;
    }

   private:
    mutable std::mutex mutex_;
    std::vector<std::thread::id> threads_;
};

// As long as this is there, its thread is among the callers.
class Caller {
   public:
    explicit Caller(Callers& callers) : callers_(callers) { callers_.add(); }
    Caller(const Caller&) = delete;
    Caller(Caller&&) = delete;
    Caller& operator=(const Caller&) = delete;
    Caller& operator=(Caller&&) = delete;
    ~Caller() { callers_.remove(); }

   private:
    Callers& callers_;
};

}  // namespace curvewise::nearest
