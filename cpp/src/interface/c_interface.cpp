// The C interface: options and curves translated, exceptions turned into a status and a message.
// Nothing is computed here, and no exception passes into C.
#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
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

using curvewise::Crossing;
using curvewise::LengthScale;
using curvewise::Metric;
using curvewise::Spacing;
using curvewise::StepPattern;

template <int measure, class Options>
constexpr bool is_measure =
    std::is_same_v<std::variant_alternative_t<measure, curvewise::Measure>, Options>;
static_assert(is_measure<CURVEWISE_AREA, curvewise::AreaOptions>);
static_assert(is_measure<CURVEWISE_PCM, curvewise::PcmOptions>);
static_assert(is_measure<CURVEWISE_FRECHET, curvewise::FrechetOptions>);
static_assert(is_measure<CURVEWISE_DTW, curvewise::DtwOptions>);
static_assert(is_measure<CURVEWISE_CURVE_LENGTH, curvewise::CurveLengthOptions>);
static_assert(is_measure<CURVEWISE_FRECHET_CONTINUOUS, curvewise::FrechetContinuousOptions>);
// The Hausdorff distances and the edit distances are C++'s and Python's alone.
constexpr int measures = CURVEWISE_FRECHET_CONTINUOUS + 1;

[[noreturn]] void refuse_choice(const char* option, int given, int count) {
    throw std::invalid_argument("unknown " + std::string(option) + " " + std::to_string(given) +
                                "; choose from 0 to " + std::to_string(count - 1));
}

// An int of C as the enumerator of the same place. A test holds the enumerations of C and C++
// together, name by name (test_registry.py).
template <class Enum>
Enum choice(const char* option, int given) {
    constexpr int count = choice_names(Enum{}).size();
    if (given < 0 || given >= count) refuse_choice(option, given, count);
    return static_cast<Enum>(given);
}

curvewise::GroundDistance ground_distance(int metric, double p, double radius) {
    return {choice<Metric>("metric", metric), p, radius};
}

curvewise::AreaOptions translate(const curvewise_area_options& given) {
    return {choice<Spacing>("spacing", given.spacing), choice<Crossing>("crossing", given.crossing),
            given.squared != 0};
}

curvewise::PcmOptions translate(const curvewise_pcm_options& given) {
    return {given.offsets, given.continuous != 0};
}

curvewise::FrechetOptions translate(const curvewise_frechet_options& given) {
    curvewise::FrechetOptions options;
    options.ground = ground_distance(given.metric, given.p, given.radius);
    options.workers = given.workers;
    options.prune = given.prune != 0;
    options.cutoff = given.cutoff;
    return options;
}

curvewise::DtwOptions translate(const curvewise_dtw_options& given) {
    curvewise::DtwOptions options;
    options.ground = ground_distance(given.metric, given.p, given.radius);
    options.step_pattern = choice<StepPattern>("step_pattern", given.step_pattern);
    options.penalty = given.penalty;
    if (given.window != CURVEWISE_NO_WINDOW) options.window = given.window;
    if (given.window_fraction != 0.0) options.window_fraction = given.window_fraction;
    options.normalize = given.normalize != 0;
    options.open_begin = given.open_begin != 0;
    options.open_end = given.open_end != 0;
    options.relax = {given.relax_p_begin, given.relax_p_end, given.relax_q_begin,
                     given.relax_q_end};
    options.workers = given.workers;
    options.prune = given.prune != 0;
    options.cutoff = given.cutoff;
    return options;
}

curvewise::CurveLengthOptions translate(const curvewise_curve_length_options& given) {
    return {choice<LengthScale>("scale", given.scale)};
}

curvewise::FrechetContinuousOptions translate(const curvewise_frechet_continuous_options& given) {
    return {given.workers};
}

// Options given as a null pointer are the defaults.
template <class Given>
curvewise::Measure measure_or_default(const void* given) {
    using Options = decltype(translate(Given{}));
    return given == nullptr ? Options{} : translate(*static_cast<const Given*>(given));
}

curvewise::Measure measure_of(int measure, const void* options) {
    switch (measure) {
        case CURVEWISE_AREA:
            return measure_or_default<curvewise_area_options>(options);
        case CURVEWISE_PCM:
            return measure_or_default<curvewise_pcm_options>(options);
        case CURVEWISE_FRECHET:
            return measure_or_default<curvewise_frechet_options>(options);
        case CURVEWISE_DTW:
            return measure_or_default<curvewise_dtw_options>(options);
        case CURVEWISE_CURVE_LENGTH:
            return measure_or_default<curvewise_curve_length_options>(options);
        case CURVEWISE_FRECHET_CONTINUOUS:
            return measure_or_default<curvewise_frechet_continuous_options>(options);
        default:
            refuse_choice("measure", measure, measures);
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

curvewise::ChabocheVoce translate(const curvewise_chaboche_voce& given) {
    return {given.backstresses, choice<curvewise::Modulus>("modulus", given.modulus)};
}

curvewise::YoshidaUemori translate(const curvewise_yoshida_uemori& given) {
    return {choice<curvewise::BoundGrowth>("growth", given.growth),
            choice<curvewise::Modulus>("modulus", given.modulus), given.rtol};
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
    } catch (...) {  // the library throws no others; nothing may pass through C
        report(error, "an exception of unknown type");
        return CURVEWISE_FAILED;
    }
}

// A measure of two curves.
int measured(int measure, const curvewise_curve* P, const curvewise_curve* Q, const void* options,
             double* value, curvewise_error* error) noexcept {
    return guarded(error, [&] {
        const curvewise::Measure chosen = measure_of(measure, options);
        double* const out = written(value, "value");
        *out = curvewise::evaluate(chosen, view(P, "P"), view(Q, "Q"));
    });
}

// The stresses of a material point, and their derivatives if requested.
template <class Given>
int driven(const Given* material, const double* parameters, ptrdiff_t count, const double* strain,
           ptrdiff_t n, double* stress, double* slopes, curvewise_error* error) noexcept {
    return guarded(error, [&] {
        using Material = decltype(translate(*material));
        const Material chosen = material == nullptr ? Material{} : translate(*material);
        const auto names = curvewise::material_parameters(chosen);
        if (count != static_cast<ptrdiff_t>(names.size())) {
            std::string listed;
            for (const auto& one : names) listed += (listed.empty() ? "" : ", ") + one.name;
            throw std::invalid_argument("there are " + std::to_string(count) +
                                        " parameters; the material has " +
                                        std::to_string(names.size()) + ": " + listed);
        }
        if (n < 0) {
            throw std::invalid_argument("there are " + std::to_string(n) +
                                        " strains; give a whole number >= 0");
        }
        at(parameters, "parameters");
        if (n > 0) at(strain, "strain"), at(stress, "stress");
        curvewise::material_stress(chosen, parameters, strain, n, stress, slopes);
    });
}

}  // namespace

curvewise_curve curvewise_rows(const double* data, ptrdiff_t n, ptrdiff_t dim) {
    return {data, n, dim, dim, 1};
}

int curvewise_area(const curvewise_curve* P, const curvewise_curve* Q,
                   const curvewise_area_options* options, double* value, curvewise_error* error) {
    return measured(CURVEWISE_AREA, P, Q, options, value, error);
}

int curvewise_pcm(const curvewise_curve* P, const curvewise_curve* Q,
                  const curvewise_pcm_options* options, double* value, curvewise_error* error) {
    return measured(CURVEWISE_PCM, P, Q, options, value, error);
}

int curvewise_frechet(const curvewise_curve* P, const curvewise_curve* Q,
                      const curvewise_frechet_options* options, double* value,
                      curvewise_error* error) {
    return measured(CURVEWISE_FRECHET, P, Q, options, value, error);
}

int curvewise_dtw(const curvewise_curve* P, const curvewise_curve* Q,
                  const curvewise_dtw_options* options, double* value, curvewise_error* error) {
    return measured(CURVEWISE_DTW, P, Q, options, value, error);
}

int curvewise_curve_length(const curvewise_curve* P, const curvewise_curve* Q,
                           const curvewise_curve_length_options* options, double* value,
                           curvewise_error* error) {
    return measured(CURVEWISE_CURVE_LENGTH, P, Q, options, value, error);
}

int curvewise_frechet_continuous(const curvewise_curve* P, const curvewise_curve* Q,
                                 const curvewise_frechet_continuous_options* options, double* value,
                                 curvewise_error* error) {
    return measured(CURVEWISE_FRECHET_CONTINUOUS, P, Q, options, value, error);
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
        curvewise::cdist(a, b, measure_of(measure, options), out, translate(batch));
    });
}

int curvewise_pdist(const curvewise_curve* X, ptrdiff_t k, int measure, const void* options,
                    const curvewise_batch_options* batch, double* out, curvewise_error* error) {
    return guarded(error, [&] {
        const std::vector<CurveView> curves = views(X, k, "X");
        if (k > 1) at(out, "out");
        curvewise::pdist(curves, measure_of(measure, options), out, translate(batch));
    });
}

int curvewise_chaboche_voce_stress(const curvewise_chaboche_voce* material,
                                   const double* parameters, ptrdiff_t count, const double* strain,
                                   ptrdiff_t n, double* stress, double* slopes,
                                   curvewise_error* error) {
    return driven(material, parameters, count, strain, n, stress, slopes, error);
}

int curvewise_yoshida_uemori_stress(const curvewise_yoshida_uemori* material,
                                    const double* parameters, ptrdiff_t count, const double* strain,
                                    ptrdiff_t n, double* stress, double* slopes,
                                    curvewise_error* error) {
    return driven(material, parameters, count, strain, n, stress, slopes, error);
}

const char* curvewise_version(void) { return curvewise::version; }
