// The C interface: options and curves translated, exceptions turned into a status and a message.
// Nothing is computed here, and no exception passes into C.
#include <cstdio>
#include <initializer_list>
#include <new>
#include <stdexcept>
#include <string>

#include "curvewise/curvewise.h"
#include "curvewise/curvewise.hpp"

namespace {

using curvewise::CurveView;

template <class T>
const T& at(const T* pointer, const char* name) {
    if (pointer != nullptr) return *pointer;
    throw std::invalid_argument(std::string(name) + " is a null pointer");
}

double* written(double* pointer, const char* name) {
    at(pointer, name);
    return pointer;
}

CurveView view(const curvewise_curve* curve, const char* name) {
    const curvewise_curve& given = at(curve, name);
    if (given.n > 0 && given.dim > 0) at(given.data, (std::string(name) + "->data").c_str());
    return {given.data, given.n, given.dim, given.row_stride, given.col_stride};
}

// An int of C as the enumerator of the same place; `last` is the last one there is.
template <class Enum>
Enum choice(const char* option, int given, Enum last) {
    const int most = static_cast<int>(last);
    if (given >= 0 && given <= most) return static_cast<Enum>(given);
    throw std::invalid_argument("unknown " + std::string(option) + " " + std::to_string(given) +
                                "; choose from 0 to " + std::to_string(most));
}

curvewise::GroundDistance ground_distance(int metric, double p) {
    return {choice("metric", metric, curvewise::Metric::minkowski), p};
}

curvewise::AreaOptions translate(const curvewise_area_options& given) {
    return {choice("spacing", given.spacing, curvewise::Spacing::arc_length),
            choice("crossing", given.crossing, curvewise::Crossing::split), given.squared != 0};
}

curvewise::PcmOptions translate(const curvewise_pcm_options& given) {
    return {given.offsets, given.continuous != 0};
}

curvewise::FrechetOptions translate(const curvewise_frechet_options& given) {
    curvewise::FrechetOptions options;
    options.ground = ground_distance(given.metric, given.p);
    options.workers = given.workers;
    return options;
}

curvewise::DtwOptions translate(const curvewise_dtw_options& given) {
    curvewise::DtwOptions options;
    options.ground = ground_distance(given.metric, given.p);
    options.step_pattern =
        choice("step_pattern", given.step_pattern, curvewise::StepPattern::symmetric2);
    if (given.window != CURVEWISE_NO_WINDOW) options.window = given.window;
    options.open_begin = given.open_begin != 0;
    options.open_end = given.open_end != 0;
    options.workers = given.workers;
    return options;
}

curvewise::CurveLengthOptions translate(const curvewise_curve_length_options& given) {
    return {choice("scale", given.scale, curvewise::LengthScale::range)};
}

void report(curvewise_error* error, const char* message) noexcept {
    if (error != nullptr) std::snprintf(error->message, sizeof error->message, "%s", message);
}

// Calls `function` and says how it went.
template <class Function>
int guarded(curvewise_error* error, Function function) noexcept {
    try {
        function();
        report(error, "");
        return CURVEWISE_OK;
    } catch (const std::invalid_argument& refused) {
        report(error, refused.what());
        return CURVEWISE_INVALID_ARGUMENT;
    } catch (const std::bad_alloc& exhausted) {
        report(error, exhausted.what());
        return CURVEWISE_NO_MEMORY;
    } catch (const std::exception& failure) {
        report(error, failure.what());
        return CURVEWISE_FAILED;
    } catch (...) {
        report(error, "an exception of unknown type");
        return CURVEWISE_FAILED;
    }
}

// One measure of two curves; `Options` is what options given as NULL stand for.
template <class Options, class Given, class Measure>
int measured(const curvewise_curve* P, const curvewise_curve* Q, const Given* given, double* value,
             curvewise_error* error, Measure measure) noexcept {
    return guarded(error, [&] {
        const Options options = given == nullptr ? Options{} : translate(*given);
        double* const out = written(value, "value");
        *out = measure(view(P, "P"), view(Q, "Q"), options);
    });
}

}  // namespace

curvewise_curve curvewise_rows(const double* data, ptrdiff_t n, ptrdiff_t dim) {
    return {data, n, dim, dim, 1};
}

int curvewise_area(const curvewise_curve* P, const curvewise_curve* Q,
                   const curvewise_area_options* options, double* value, curvewise_error* error) {
    return measured<curvewise::AreaOptions>(
        P, Q, options, value, error,
        [](const auto& p, const auto& q, const auto& o) { return curvewise::area(p, q, o); });
}

int curvewise_pcm(const curvewise_curve* P, const curvewise_curve* Q,
                  const curvewise_pcm_options* options, double* value, curvewise_error* error) {
    return measured<curvewise::PcmOptions>(
        P, Q, options, value, error,
        [](const auto& p, const auto& q, const auto& o) { return curvewise::pcm(p, q, o); });
}

int curvewise_frechet(const curvewise_curve* P, const curvewise_curve* Q,
                      const curvewise_frechet_options* options, double* value,
                      curvewise_error* error) {
    return measured<curvewise::FrechetOptions>(
        P, Q, options, value, error,
        [](const auto& p, const auto& q, const auto& o) { return curvewise::frechet(p, q, o); });
}

int curvewise_dtw(const curvewise_curve* P, const curvewise_curve* Q,
                  const curvewise_dtw_options* options, double* value, curvewise_error* error) {
    return measured<curvewise::DtwOptions>(
        P, Q, options, value, error,
        [](const auto& p, const auto& q, const auto& o) { return curvewise::dtw(p, q, o); });
}

int curvewise_curve_length(const curvewise_curve* P, const curvewise_curve* Q,
                           const curvewise_curve_length_options* options, double* value,
                           curvewise_error* error) {
    return measured<curvewise::CurveLengthOptions>(P, Q, options, value, error,
                                                   [](const auto& p, const auto& q, const auto& o) {
                                                       return curvewise::curve_length(p, q, o);
                                                   });
}

int curvewise_normalize(const curvewise_curve* P, const curvewise_curve* C, double* out,
                        curvewise_error* error) {
    return guarded(
        error, [&] { curvewise::normalize(view(P, "P"), view(C, "C"), written(out, "out"), "C"); });
}

const char* curvewise_version(void) { return curvewise::version; }
