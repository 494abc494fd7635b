// Long calls that Ctrl-C can end and that report progress. The library does not depend on Python:
// its Control calls back from the thread that made the call, about twenty times a second. Only the
// callback takes the interpreter's lock.
#pragma once

#include <pybind11/pybind11.h>

#include "curvewise/control.hpp"
#include "interpreter_lock.hpp"

namespace curvewise::bindings {

namespace py = pybind11;

// The Control of one call from Python. An exception raised by a signal's handler, or by
// `progress(done, total)`, stops the call and stays set in this thread until it is back.
class PythonControl {
   public:
    explicit PythonControl(const py::object& progress)
        : progress_(progress),
          handles_signals_(is_main_thread()),
          control_([this](std::int64_t done, std::int64_t total) { return report(done, total); }) {}

    // Null if neither signals nor progress need reports.
    Control* control() noexcept {
        return handles_signals_ || !progress_.is_none() ? &control_ : nullptr;
    }

   private:
    static bool is_main_thread() {
        const py::object main = py::module_::import("threading").attr("main_thread")();
        return main.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
    }

    // Whether to go on.
    bool report(std::int64_t done, std::int64_t total) {
        const WithLock lock;
        return or_stand_still([&] {
            if (handles_signals_ && PyErr_CheckSignals() != 0) return false;
            if (progress_.is_none()) return true;
            PyObject* const result = PyObject_CallFunction(
                progress_.ptr(), "LL", static_cast<long long>(done), static_cast<long long>(total));
            Py_XDECREF(result);
            return result != nullptr;
        });
    }

    const py::object& progress_;
    bool handles_signals_;
    Control control_;
};

// Calls of fewer elementary steps, about 50 µs at the slowest rate there is, keep the interpreter's
// lock: to release it costs something, too.
inline constexpr double steps_worth_unlocking = 5e3;

// Calls of fewer are over before a report is due.
inline constexpr double steps_worth_watching = 5e5;

// Calls function(), without the interpreter's lock where that is worth its cost.
template <class Function>
auto unlocked(double steps, Function function) {
    if (steps < steps_worth_unlocking) return function();
    const WithoutLock unlocked;
    return function();
}

// Calls function(Control*) in the same way, so that it reports progress and checks for signals. The
// main thread handles signals, because Python delivers them there. Code that throws Stopped has set
// an exception.
template <class Function>
auto interruptible(double steps, const py::object& progress, Function function) {
    try {
        if (progress.is_none() && steps < steps_worth_watching) {
            return unlocked(steps, [&] { return function(nullptr); });
        }
        PythonControl python(progress);
        const WithoutLock unlocked;
        return function(python.control());
    } catch (const Stopped&) {
        throw py::error_already_set();
    }
}

}  // namespace curvewise::bindings
