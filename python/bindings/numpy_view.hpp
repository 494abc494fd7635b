// Between numpy and the library: arrays as views, options from Python objects, results as arrays.
// Errors in options are ValueErrors (std::invalid_argument), whatever type the option has.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "curvewise/curve.hpp"

namespace curvewise::bindings {

namespace py = pybind11;

// A float64 array of one or two dimensions, aligned; any strides.
using CurveArray = py::array_t<double, 0>;

CurveView view(const CurveArray& array);

// Whether an object is a str that reads `text`.
bool is_text(const py::object& given, std::string_view text);

// The value that an option's name stands for, or
// "unknown metric 'foo'; choose from euclidean, ...".
template <class Enum>
Enum choose(const char* option, const py::object& given,
            std::initializer_list<std::pair<std::string_view, Enum>> choices) {
    for (const auto& [valid, value] : choices) {
        if (is_text(given, valid)) return value;
    }
    std::string list;
    for (const auto& choice : choices) {
        list += (list.empty() ? "" : ", ") + std::string(choice.first);
    }
    throw py::value_error("unknown " + std::string(option) + " " +
                          py::repr(given).cast<std::string>() + "; choose from " + list);
}

// A whole number of at least `least`, one beyond ptrdiff_t cut to its largest value; a ValueError
// with `advice` for anything else.
std::ptrdiff_t whole_number(const char* option, const py::object& given, std::ptrdiff_t least,
                            const char* advice);

// Python's truth.
bool is_true(const py::object& given);

// Without the interpreter's lock where that is worth its cost: `work` is the number of elementary
// steps ahead.
template <class Function>
auto unlocked(double work, Function function) {
    constexpr double worth_it = 5e3;  // steps; about 50 µs at the slowest rate there is
    if (work < worth_it) return function();
    const py::gil_scoped_release release;
    return function();
}

}  // namespace curvewise::bindings
