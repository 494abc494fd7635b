// What the functions of curvewise.h have in common: options and curves translated, exceptions
// turned into a status and a message. Nothing is computed here, and no exception passes into C.
#pragma once

#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "curvewise/curvewise.h"
#include "curvewise/curvewise.hpp"

struct curvewise_control {
    curvewise::Control control;
};

namespace curvewise::c {

// Throws where a pointer that the caller must give is null.
void require(const void* pointer, const char* name);

template <class T>
T& at(T* pointer, const char* name) {
    require(pointer, name);
    return *pointer;
}

inline Control* control_of(curvewise_control* given) noexcept {
    return given == nullptr ? nullptr : &given->control;
}

CurveView view(const curvewise_curve* curve, const char* name);
std::vector<CurveView> views(const curvewise_curve* curves, ptrdiff_t count, const char* name);

// Throws where a number of things, "-2 strains", is below 0.
void check_count(ptrdiff_t count, const char* things);

[[noreturn]] void refuse_choice(const char* option, int given, int count);

// An int of C as the enumerator of the same place. A test holds the enumerations of C and C++
// together, name by name (test_registry.py).
template <class Enum>
Enum choice(const char* option, int given) {
    constexpr int count = choice_names(Enum{}).size();
    if (given < 0 || given >= count) refuse_choice(option, given, count);
    return static_cast<Enum>(given);
}

// The size of a struct in the first version of the library that had it. A struct that has grown
// since has its first size here. Its new members must begin behind that size, and not in the
// padding that the first version had at its end, which holds any numbers.
template <class Given>
inline constexpr std::size_t first_size = sizeof(Given);

[[noreturn]] void refuse_size(std::size_t given, std::size_t known, const char* start);

// The size that a struct of the caller says it has: that of this version, or of an older one. Its
// address is one of bytes, because an older struct is no object of this version's type.
template <class Given>
std::size_t size_of(const void* given, const char* start) {
    std::size_t size = 0;
    std::memcpy(&size, given, sizeof size);
    if (size < first_size<Given> || size > sizeof(Given)) refuse_size(size, sizeof(Given), start);
    return size;
}

// A struct of this version whose members are those of the caller as far as the caller's reaches,
// and `defaults` behind that.
template <class Given>
Given covered(const void* given, Given defaults, const char* start) {
    std::memcpy(&defaults, given, size_of<Given>(given, start));
    return defaults;
}

// Writes `result` to the caller's struct as far as that reaches. Its size stays.
template <class Given>
void write_covered(Given result, void* to, const char* start) {
    result.size = size_of<Given>(to, start);
    std::memcpy(to, &result, result.size);
}

// A measure with its options, and the control that stands among them.
struct ChosenMeasure {
    Measure measure;
    Control* control;
};
ChosenMeasure measure_of(int measure, const void* options);

AreaOptions translate(const curvewise_area_options& given);
PcmOptions translate(const curvewise_pcm_options& given);
FrechetOptions translate(const curvewise_frechet_options& given);
DtwOptions translate(const curvewise_dtw_options& given);
CurveLengthOptions translate(const curvewise_curve_length_options& given);
FrechetContinuousOptions translate(const curvewise_frechet_continuous_options& given);

// Options of this version, complete; the defaults for null.
curvewise_area_options complete(const curvewise_area_options* given);
curvewise_pcm_options complete(const curvewise_pcm_options* given);
curvewise_frechet_options complete(const curvewise_frechet_options* given);
curvewise_dtw_options complete(const curvewise_dtw_options* given);
curvewise_curve_length_options complete(const curvewise_curve_length_options* given);
curvewise_frechet_continuous_options complete(const curvewise_frechet_continuous_options* given);
curvewise_compare_options complete(const curvewise_compare_options* given);
curvewise_batch_options complete(const curvewise_batch_options* given);
curvewise_search_options complete(const curvewise_search_options* given);

// The exception of a result that the caller's array has no room for.
class NoRoom : public std::runtime_error {
   public:
    NoRoom(std::size_t count, ptrdiff_t capacity)
        : std::runtime_error("the result has " + std::to_string(count) +
                             " elements, and the arrays have room for " +
                             std::to_string(capacity)) {}
};

// Writes the number of elements of a result, and throws if it exceeds `capacity`.
void write_count(std::size_t found, ptrdiff_t capacity, ptrdiff_t& count);

inline void report(curvewise_error* error, const char* message) noexcept {
    if (error != nullptr) std::snprintf(error->message, sizeof error->message, "%s", message);
}

// Reports the exception that is being handled, and returns its status.
int status_of_exception(curvewise_error* error) noexcept;

// Calls `function` and says how it went.
template <class Function>
int guarded(curvewise_error* error, Function function) noexcept {
    try {
        function();
        report(error, "");
        return CURVEWISE_OK;
    } catch (...) {
        return status_of_exception(error);
    }
}

}  // namespace curvewise::c
