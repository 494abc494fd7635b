// Releases and reacquires the interpreter's lock, as pybind11's gil_scoped_release and
// gil_scoped_acquire do, with one difference. The interpreter can end while another thread is
// inside a call: a daemon thread, when the main thread leaves. Python before 3.14 then ends a
// thread that requests the lock by pthread_exit(), which unwinds the stack. If that happens in a
// destructor, the program ends. If it passes a frame that holds Python objects, it frees them
// without the lock. So the thread waits forever instead, as it does from 3.14 on, until the process
// ends.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <thread>

namespace curvewise::bindings {

// Calls `call`, which asks Python for the lock and throws nothing; where Python unwinds the thread
// for that, it never returns. (By the rules of pthread_exit, the handler must not be left.)
template <class Call>
auto or_stand_still(Call call) noexcept {
    try {
        return call();
    } catch (...) {
        for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
    }
}

class WithoutLock {
   public:
    WithoutLock() : state_(PyEval_SaveThread()) {}
    WithoutLock(const WithoutLock&) = delete;
    WithoutLock(WithoutLock&&) = delete;
    WithoutLock& operator=(const WithoutLock&) = delete;
    WithoutLock& operator=(WithoutLock&&) = delete;
    ~WithoutLock() {
        or_stand_still([this] { PyEval_RestoreThread(state_); });
    }

   private:
    PyThreadState* state_;
};

class WithLock {
   public:
    WithLock() : state_(or_stand_still([] { return PyGILState_Ensure(); })) {}
    WithLock(const WithLock&) = delete;
    WithLock(WithLock&&) = delete;
    WithLock& operator=(const WithLock&) = delete;
    WithLock& operator=(WithLock&&) = delete;
    ~WithLock() { PyGILState_Release(state_); }

   private:
    PyGILState_STATE state_;
};

}  // namespace curvewise::bindings
