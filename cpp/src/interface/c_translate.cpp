#include "interface/c_translate.hpp"

#include <cstddef>
#include <type_traits>
#include <variant>

#include "curvewise/attempt.hpp"

namespace curvewise::c {
namespace {

static_assert(static_cast<int>(Status::invalid_argument) == CURVEWISE_INVALID_ARGUMENT);
static_assert(static_cast<int>(Status::no_memory) == CURVEWISE_NO_MEMORY);
static_assert(static_cast<int>(Status::failed) == CURVEWISE_FAILED);
static_assert(static_cast<int>(Status::stopped) == CURVEWISE_STOPPED);

template <std::size_t measure, class Options>
constexpr bool is_measure = std::is_same_v<std::variant_alternative_t<measure, Measure>, Options>;
static_assert(is_measure<CURVEWISE_AREA, AreaOptions>);
static_assert(is_measure<CURVEWISE_PCM, PcmOptions>);
static_assert(is_measure<CURVEWISE_FRECHET, FrechetOptions>);
static_assert(is_measure<CURVEWISE_DTW, DtwOptions>);
static_assert(is_measure<CURVEWISE_CURVE_LENGTH, CurveLengthOptions>);
static_assert(is_measure<CURVEWISE_FRECHET_CONTINUOUS, FrechetContinuousOptions>);
// The Hausdorff distances and the edit distances are C++'s and Python's alone.
constexpr int measures = CURVEWISE_FRECHET_CONTINUOUS + 1;

GroundDistance ground_distance(int metric, double p, double radius) {
    return {choice<Metric>("metric", metric), p, radius};
}

template <class Given>
Given complete(const Given* given, const Given& defaults, const char* start) {
    return given == nullptr ? defaults : covered(given, defaults, start);
}

// Of closed curves, only single values and paths are computed (c_measures.cpp).
void refuse_closed(int closed) {
    if (closed == 0) return;
    throw std::invalid_argument(
        "closed is an option of single pairs; call dtw, frechet or frechet_continuous for each");
}

template <class Given>
ChosenMeasure chosen(const void* options) {
    const Given given = c::complete(static_cast<const Given*>(options));
    return {translate(given), control_of(given.control)};
}

}  // namespace

void require(const void* pointer, const char* name) {
    if (pointer == nullptr) throw std::invalid_argument(std::string(name) + " is a null pointer");
}

CurveView view(const curvewise_curve* curve, const char* name) {
    const curvewise_curve& given = at(curve, name);
    if (given.n > 0 && given.dim > 0) require(given.data, (std::string(name) + "->data").c_str());
    return {given.data, given.n, given.dim, given.row_stride, given.col_stride};
}

std::vector<CurveView> views(const curvewise_curve* curves, ptrdiff_t count, const char* name) {
    if (count < 0) {
        throw std::invalid_argument(std::string(name) + " has " + std::to_string(count) +
                                    " curves; give a whole number >= 0");
    }
    if (count > 0) require(curves, name);
    std::vector<CurveView> result;
    result.reserve(static_cast<std::size_t>(count));
    for (ptrdiff_t i = 0; i < count; ++i) {
        const std::string place = std::string(name) + "[" + std::to_string(i) + "]";
        result.push_back(view(curves + i, place.c_str()));
    }
    return result;
}

void check_count(ptrdiff_t count, const char* things) {
    if (count >= 0) return;
    throw std::invalid_argument("there are " + std::to_string(count) + " " + things +
                                "; give a whole number >= 0");
}

void refuse_choice(const char* option, int given, int count) {
    throw std::invalid_argument("unknown " + std::string(option) + " " + std::to_string(given) +
                                "; choose from 0 to " + std::to_string(count - 1));
}

void refuse_size(std::size_t given, std::size_t known, const char* start) {
    throw std::invalid_argument("the size of the struct is " + std::to_string(given) +
                                ", and curvewise " + version + " needs " + std::to_string(known) +
                                "; start from " + start);
}

AreaOptions translate(const curvewise_area_options& given) {
    return {choice<Spacing>("spacing", given.spacing), choice<Crossing>("crossing", given.crossing),
            given.squared != 0, given.closed != 0};
}

PcmOptions translate(const curvewise_pcm_options& given) {
    return {given.offsets, given.continuous != 0};
}

FrechetOptions translate(const curvewise_frechet_options& given) {
    refuse_closed(given.closed);
    FrechetOptions options;
    options.ground = ground_distance(given.metric, given.p, given.radius);
    options.workers = given.workers;
    options.prune = given.prune != 0;
    options.cutoff = given.cutoff;
    return options;
}

DtwOptions translate(const curvewise_dtw_options& given) {
    refuse_closed(given.closed);
    DtwOptions options;
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

CurveLengthOptions translate(const curvewise_curve_length_options& given) {
    return {choice<LengthScale>("scale", given.scale)};
}

FrechetContinuousOptions translate(const curvewise_frechet_continuous_options& given) {
    refuse_closed(given.closed);
    return {given.workers};
}

curvewise_area_options complete(const curvewise_area_options* given) {
    return complete(given, CURVEWISE_AREA_DEFAULTS, "CURVEWISE_AREA_DEFAULTS");
}

curvewise_pcm_options complete(const curvewise_pcm_options* given) {
    return complete(given, CURVEWISE_PCM_DEFAULTS, "CURVEWISE_PCM_DEFAULTS");
}

curvewise_frechet_options complete(const curvewise_frechet_options* given) {
    return complete(given, CURVEWISE_FRECHET_DEFAULTS, "CURVEWISE_FRECHET_DEFAULTS");
}

curvewise_dtw_options complete(const curvewise_dtw_options* given) {
    return complete(given, CURVEWISE_DTW_DEFAULTS, "CURVEWISE_DTW_DEFAULTS");
}

curvewise_curve_length_options complete(const curvewise_curve_length_options* given) {
    return complete(given, CURVEWISE_CURVE_LENGTH_DEFAULTS, "CURVEWISE_CURVE_LENGTH_DEFAULTS");
}

curvewise_frechet_continuous_options complete(const curvewise_frechet_continuous_options* given) {
    return complete(given, CURVEWISE_FRECHET_CONTINUOUS_DEFAULTS,
                    "CURVEWISE_FRECHET_CONTINUOUS_DEFAULTS");
}

curvewise_compare_options complete(const curvewise_compare_options* given) {
    return complete(given, CURVEWISE_COMPARE_DEFAULTS, "CURVEWISE_COMPARE_DEFAULTS");
}

curvewise_batch_options complete(const curvewise_batch_options* given) {
    return complete(given, CURVEWISE_BATCH_DEFAULTS, "CURVEWISE_BATCH_DEFAULTS");
}

curvewise_search_options complete(const curvewise_search_options* given) {
    return complete(given, CURVEWISE_SEARCH_DEFAULTS, "CURVEWISE_SEARCH_DEFAULTS");
}

ChosenMeasure measure_of(int measure, const void* options) {
    switch (measure) {
        case CURVEWISE_AREA:
            return chosen<curvewise_area_options>(options);
        case CURVEWISE_PCM:
            return chosen<curvewise_pcm_options>(options);
        case CURVEWISE_FRECHET:
            return chosen<curvewise_frechet_options>(options);
        case CURVEWISE_DTW:
            return chosen<curvewise_dtw_options>(options);
        case CURVEWISE_CURVE_LENGTH:
            return chosen<curvewise_curve_length_options>(options);
        case CURVEWISE_FRECHET_CONTINUOUS:
            return chosen<curvewise_frechet_continuous_options>(options);
        default:
            refuse_choice("measure", measure, measures);
    }
}

void write_count(std::size_t found, ptrdiff_t capacity, ptrdiff_t& count) {
    count = static_cast<ptrdiff_t>(found);
    if (count > capacity) throw NoRoom(found, capacity);
}

int status_of_exception(curvewise_error* error) noexcept {
    try {
        throw;
    } catch (const NoRoom& short_of) {
        report(error, short_of.what());
        return CURVEWISE_NO_ROOM;
    } catch (...) {  // nothing may pass through C
        const Failure failure = failure_of_exception();
        report(error, failure.message);
        return static_cast<int>(failure.status);
    }
}

}  // namespace curvewise::c
