// Seconds from one lap to the next, for the phases that a call reports.
#pragma once

#include <chrono>

namespace curvewise::runtime {

class Stopwatch {
   public:
    double lap() {
        const Clock::time_point now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        return seconds;
    }

   private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace curvewise::runtime
