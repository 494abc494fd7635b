// The C interface: two curves.
#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "interface/c_translate.hpp"

namespace {

using curvewise::c::at;
using curvewise::c::choice;
using curvewise::c::complete;
using curvewise::c::control_of;
using curvewise::c::guarded;
using curvewise::c::require;
using curvewise::c::translate;
using curvewise::c::view;

// The options of closed curves: those that open curves have, if the others are the defaults.
template <class Given>
std::optional<curvewise::ClosedOptions> closed_options(Given given) {
    if (given.closed == 0) return std::nullopt;
    given.closed = 0;
    curvewise::ClosedOptions options;
    options.ground = translate(given).ground;
    options.cutoff = given.cutoff;
    return options;
}

std::optional<curvewise::ClosedOptions> closed_options(const curvewise_dtw_options& given) {
    const auto refuse = [&](const char* option, bool is_given) {
        if (given.closed == 0 || !is_given) return;
        throw std::invalid_argument("closed has no " + std::string(option) + "; leave its default");
    };
    refuse("step_pattern", given.step_pattern != CURVEWISE_SYMMETRIC1);
    refuse("open_begin", given.open_begin != 0);
    refuse("open_end", given.open_end != 0);
    refuse("window", given.window != CURVEWISE_NO_WINDOW);
    refuse("window_fraction", given.window_fraction != 0.0);
    refuse("normalize", given.normalize != 0);
    refuse("penalty", given.penalty != 0.0);
    refuse("relax", given.relax_p_begin != 0 || given.relax_p_end != 0 ||
                        given.relax_q_begin != 0 || given.relax_q_end != 0);
    return closed_options<curvewise_dtw_options>(given);
}

// The value of closed curves, if the options ask for it.
std::optional<double> closed_value(int measure, const curvewise_curve* P, const curvewise_curve* Q,
                                   const void* options) {
    if (measure == CURVEWISE_DTW) {
        const auto given = complete(static_cast<const curvewise_dtw_options*>(options));
        if (const auto closed = closed_options(given)) {
            return curvewise::closed_dtw(view(P, "P"), view(Q, "Q"), *closed,
                                         control_of(given.control));
        }
    } else if (measure == CURVEWISE_FRECHET) {
        const auto given = complete(static_cast<const curvewise_frechet_options*>(options));
        if (const auto closed = closed_options(given)) {
            return curvewise::closed_frechet(view(P, "P"), view(Q, "Q"), *closed,
                                             control_of(given.control));
        }
    } else if (measure == CURVEWISE_FRECHET_CONTINUOUS) {
        const auto given =
            complete(static_cast<const curvewise_frechet_continuous_options*>(options));
        if (given.closed != 0) {
            return curvewise::closed_frechet_continuous(view(P, "P"), view(Q, "Q"), {given.workers},
                                                        control_of(given.control));
        }
    }
    return std::nullopt;
}

// A measure of two curves.
int measured(int measure, const curvewise_curve* P, const curvewise_curve* Q, const void* options,
             double* value, curvewise_error* error) noexcept {
    return guarded(error, [&] {
        double& out = at(value, "value");
        if (const auto closed = closed_value(measure, P, Q, options)) {
            out = *closed;
            return;
        }
        const auto [chosen, control] = curvewise::c::measure_of(measure, options);
        out = curvewise::evaluate(chosen, view(P, "P"), view(Q, "Q"), control);
    });
}

// The caller's arrays of a path.
struct PathArrays {
    double* distance;
    int64_t* path;
    ptrdiff_t capacity;
    ptrdiff_t* count;
};

// A path of two curves, by the function of its measure.
template <class Given, class Function, class ClosedFunction>
int path_of(const curvewise_curve* P, const curvewise_curve* Q, const Given* options,
            const PathArrays& out, curvewise_error* error, Function function,
            ClosedFunction closed_function) noexcept {
    return guarded(error, [&] {
        double& distance = at(out.distance, "distance");
        ptrdiff_t& count = at(out.count, "count");
        require(out.path, "path");
        const Given given = complete(options);
        const curvewise::CurveView p = view(P, "P"), q = view(Q, "Q");
        curvewise::Control* const control = control_of(given.control);
        const auto closed = closed_options(given);
        const curvewise::Alignment found = closed ? closed_function(p, q, *closed, control)
                                                  : function(p, q, translate(given), control);
        curvewise::c::write_count(found.path.size(), out.capacity, count);
        int64_t* place = out.path;
        for (const auto& pair : found.path) place = std::copy(pair.begin(), pair.end(), place);
        distance = found.distance;
    });
}

double value_or_nan(const std::optional<double>& value) {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

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

int curvewise_evaluate(const curvewise_curve* P, const curvewise_curve* Q, int measure,
                       const void* options, double* value, curvewise_error* error) {
    return measured(measure, P, Q, options, value, error);
}

int curvewise_normalize(const curvewise_curve* P, const curvewise_curve* C, double* out,
                        curvewise_error* error) {
    return guarded(error, [&] {
        require(out, "out");
        curvewise::normalize(view(P, "P"), view(C, "C"), out, "C");
    });
}

int curvewise_compare(const curvewise_curve* P, const curvewise_curve* Q,
                      const curvewise_compare_options* options, curvewise_comparison* found,
                      curvewise_error* error) {
    return guarded(error, [&] {
        constexpr const char* start = "CURVEWISE_COMPARISON";
        require(found, "found");
        curvewise::c::size_of<curvewise_comparison>(found, start);
        const curvewise_compare_options given = complete(options);
        const curvewise::Comparison compared = curvewise::compare(
            view(P, "P"), view(Q, "Q"), choice<curvewise::Preset>("preset", given.preset),
            control_of(given.control));
        const curvewise_comparison result{sizeof result,
                                          value_or_nan(compared.area),
                                          value_or_nan(compared.pcm),
                                          compared.frechet,
                                          compared.dtw,
                                          value_or_nan(compared.curve_length)};
        curvewise::c::write_covered(result, found, start);
    });
}

int curvewise_dtw_path(const curvewise_curve* P, const curvewise_curve* Q,
                       const curvewise_dtw_options* options, double* distance, int64_t* path,
                       ptrdiff_t capacity, ptrdiff_t* count, curvewise_error* error) {
    return path_of(P, Q, options, {distance, path, capacity, count}, error, curvewise::dtw_path,
                   curvewise::closed_dtw_path);
}

int curvewise_frechet_path(const curvewise_curve* P, const curvewise_curve* Q,
                           const curvewise_frechet_options* options, double* distance,
                           int64_t* path, ptrdiff_t capacity, ptrdiff_t* count,
                           curvewise_error* error) {
    return path_of(P, Q, options, {distance, path, capacity, count}, error, curvewise::frechet_path,
                   curvewise::closed_frechet_path);
}

int curvewise_pcm_match(const curvewise_curve* P, const curvewise_curve* Q,
                        const curvewise_pcm_options* options, curvewise_pcm_place* place,
                        double* points, ptrdiff_t capacity, ptrdiff_t* count,
                        curvewise_error* error) {
    return guarded(error, [&] {
        constexpr const char* start = "CURVEWISE_PCM_PLACE";
        require(place, "place");
        curvewise::c::size_of<curvewise_pcm_place>(place, start);
        if (points != nullptr) require(count, "count");
        const curvewise_pcm_options given = complete(options);
        const curvewise::PcmMatch match = curvewise::pcm_match(
            view(P, "P"), view(Q, "Q"), translate(given), control_of(given.control));
        if (points != nullptr) {
            curvewise::c::write_count(match.points.size(), capacity, *count);
            for (const auto& point : match.points) {
                points = std::copy(point.begin(), point.end(), points);
            }
        } else if (count != nullptr) {
            *count = static_cast<ptrdiff_t>(match.points.size());
        }
        const curvewise_pcm_place result{sizeof result, match.maps_p ? 1 : 0, match.value,
                                         match.offset,  match.coverage,       match.tolerance};
        curvewise::c::write_covered(result, place, start);
    });
}

int curvewise_area_quads(const curvewise_curve* P, const curvewise_curve* Q,
                         const curvewise_area_options* options, double* quads, double* areas,
                         ptrdiff_t capacity, ptrdiff_t* count, curvewise_error* error) {
    return guarded(error, [&] {
        require(count, "count");
        if (quads == nullptr && areas != nullptr) require(quads, "quads");
        if (areas == nullptr && quads != nullptr) require(areas, "areas");
        const curvewise_area_options given = complete(options);
        const curvewise::AreaQuads found = curvewise::area_quads(
            view(P, "P"), view(Q, "Q"), translate(given), control_of(given.control));
        *count = static_cast<ptrdiff_t>(found.areas.size());
        if (areas == nullptr) return;
        curvewise::c::write_count(found.areas.size(), capacity, *count);
        std::copy(found.areas.begin(), found.areas.end(), areas);
        for (const auto& quad : found.quads) {
            for (const auto& vertex : quad) quads = std::copy(vertex.begin(), vertex.end(), quads);
        }
    });
}
