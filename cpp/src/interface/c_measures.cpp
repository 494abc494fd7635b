// The C interface: two curves.
#include <algorithm>
#include <limits>

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

// A measure of two curves.
int measured(int measure, const curvewise_curve* P, const curvewise_curve* Q, const void* options,
             double* value, curvewise_error* error) noexcept {
    return guarded(error, [&] {
        const auto [chosen, control] = curvewise::c::measure_of(measure, options);
        double& out = at(value, "value");
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
template <class Given, class Function>
int path_of(const curvewise_curve* P, const curvewise_curve* Q, const Given* options,
            const PathArrays& out, curvewise_error* error, Function function) noexcept {
    return guarded(error, [&] {
        double& distance = at(out.distance, "distance");
        ptrdiff_t& count = at(out.count, "count");
        require(out.path, "path");
        const Given given = complete(options);
        const curvewise::Alignment found =
            function(view(P, "P"), view(Q, "Q"), translate(given), control_of(given.control));
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
    return path_of(P, Q, options, {distance, path, capacity, count}, error, curvewise::dtw_path);
}

int curvewise_frechet_path(const curvewise_curve* P, const curvewise_curve* Q,
                           const curvewise_frechet_options* options, double* distance,
                           int64_t* path, ptrdiff_t capacity, ptrdiff_t* count,
                           curvewise_error* error) {
    return path_of(P, Q, options, {distance, path, capacity, count}, error,
                   curvewise::frechet_path);
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
