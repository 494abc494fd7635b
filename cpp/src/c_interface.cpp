// The C interface: options and curves translated, exceptions turned into a status and a message.
// Nothing is computed here, and no exception passes into C.
#include <cstdio>
#include <initializer_list>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

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

template <class Options, class Given>
Options translate_or_default(const void* given) {
    return given == nullptr ? Options{} : translate(*static_cast<const Given*>(given));
}

curvewise::Measure translate(int measure, const void* options) {
    switch (measure) {
        case CURVEWISE_AREA:
            return translate_or_default<curvewise::AreaOptions, curvewise_area_options>(options);
        case CURVEWISE_PCM:
            return translate_or_default<curvewise::PcmOptions, curvewise_pcm_options>(options);
        case CURVEWISE_FRECHET:
            return translate_or_default<curvewise::FrechetOptions, curvewise_frechet_options>(
                options);
        case CURVEWISE_DTW:
            return translate_or_default<curvewise::DtwOptions, curvewise_dtw_options>(options);
        case CURVEWISE_CURVE_LENGTH:
            return translate_or_default<curvewise::CurveLengthOptions,
                                        curvewise_curve_length_options>(options);
        default:
            throw std::invalid_argument("unknown measure " + std::to_string(measure) +
                                        "; choose from 0 to 4");
    }
}

std::vector<CurveView> views(const curvewise_curve* curves, ptrdiff_t count, const char* name) {
    if (count < 0) {
        throw std::invalid_argument(std::string(name) + " has " + std::to_string(count) +
                                    " curves; give a whole number >= 0");
    }
    if (count > 0) at(curves, name);
    std::vector<CurveView> result;
    result.reserve(static_cast<std::size_t>(count));
    for (ptrdiff_t i = 0; i < count; ++i) {
        const std::string place = std::string(name) + "[" + std::to_string(i) + "]";
        result.push_back(view(curves + i, place.c_str()));
    }
    return result;
}

curvewise::BatchOptions translate(const curvewise_batch_options* given) {
    curvewise::BatchOptions options;
    if (given != nullptr) options = {given->workers, given->cutoff};
    return options;
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
        const auto options = translate_or_default<Options, Given>(given);
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

int curvewise_cdist(const curvewise_curve* XA, ptrdiff_t na, const curvewise_curve* XB,
                    ptrdiff_t nb, int measure, const void* options,
                    const curvewise_batch_options* batch, double* out, curvewise_error* error) {
    return guarded(error, [&] {
        const std::vector<CurveView> a = views(XA, na, "XA"), b = views(XB, nb, "XB");
        if (!a.empty() && !b.empty()) at(out, "out");
        curvewise::cdist(a, b, translate(measure, options), out, translate(batch));
    });
}

int curvewise_pdist(const curvewise_curve* X, ptrdiff_t k, int measure, const void* options,
                    const curvewise_batch_options* batch, double* out, curvewise_error* error) {
    return guarded(error, [&] {
        const std::vector<CurveView> curves = views(X, k, "X");
        if (k > 1) at(out, "out");
        curvewise::pdist(curves, translate(measure, options), out, translate(batch));
    });
}

const char* curvewise_version(void) { return curvewise::version; }
