// For ThreadSanitizer alone. ThreadSanitizer (gcc 12, clang 14) does not intercept two functions:
// those with which std::shared_timed_mutex waits until a time of the steady clock. So it reports
// data that such a lock protects as unprotected. Here the two functions call functions that it
// intercepts.
#include <pthread.h>

#include <ctime>

namespace {

// The same moment on the clock of the functions that it knows.
timespec on_real_time(clockid_t clock, const timespec& moment) {
    constexpr long second = 1'000'000'000;
    timespec now_there{}, result{};
    clock_gettime(clock, &now_there);
    clock_gettime(CLOCK_REALTIME, &result);
    long nanoseconds = result.tv_nsec + moment.tv_nsec - now_there.tv_nsec;
    result.tv_sec += moment.tv_sec - now_there.tv_sec;
    for (; nanoseconds < 0; nanoseconds += second) --result.tv_sec;
    for (; nanoseconds >= second; nanoseconds -= second) ++result.tv_sec;
    result.tv_nsec = nanoseconds;
    return result;
}

}  // namespace

extern "C" int pthread_rwlock_clockrdlock(pthread_rwlock_t* lock, clockid_t clock,
                                          const timespec* until) {
    const timespec moment = on_real_time(clock, *until);
    return pthread_rwlock_timedrdlock(lock, &moment);
}

extern "C" int pthread_rwlock_clockwrlock(pthread_rwlock_t* lock, clockid_t clock,
                                          const timespec* until) {
    const timespec moment = on_real_time(clock, *until);
    return pthread_rwlock_timedwrlock(lock, &moment);
}
