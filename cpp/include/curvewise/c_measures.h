/** \file
 * Two curves: the measures, several at once, and which points a measure matches. */
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): rules for C++ */
#ifndef CURVEWISE_C_MEASURES_H
#define CURVEWISE_C_MEASURES_H

#include "curvewise/c_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The measure of area.hpp, in *value. */
CURVEWISE_EXPORT int curvewise_area(const curvewise_curve* P, const curvewise_curve* Q,
                                    const curvewise_area_options* options, double* value,
                                    curvewise_error* error);
/** The measure of pcm.hpp, in *value. */
CURVEWISE_EXPORT int curvewise_pcm(const curvewise_curve* P, const curvewise_curve* Q,
                                   const curvewise_pcm_options* options, double* value,
                                   curvewise_error* error);
/** The measure of frechet.hpp, in *value. */
CURVEWISE_EXPORT int curvewise_frechet(const curvewise_curve* P, const curvewise_curve* Q,
                                       const curvewise_frechet_options* options, double* value,
                                       curvewise_error* error);
/** The measure of dtw.hpp, in *value. */
CURVEWISE_EXPORT int curvewise_dtw(const curvewise_curve* P, const curvewise_curve* Q,
                                   const curvewise_dtw_options* options, double* value,
                                   curvewise_error* error);
/** The measure of curve_length.hpp, in *value. */
CURVEWISE_EXPORT int curvewise_curve_length(const curvewise_curve* P, const curvewise_curve* Q,
                                            const curvewise_curve_length_options* options,
                                            double* value, curvewise_error* error);
/** The measure of frechet_continuous.hpp, in *value. */
CURVEWISE_EXPORT int curvewise_frechet_continuous(
    const curvewise_curve* P, const curvewise_curve* Q,
    const curvewise_frechet_continuous_options* options, double* value, curvewise_error* error);

/** The measure that `measure` names, in *value: for code that treats all measures in the same
 * way. */
CURVEWISE_EXPORT int curvewise_evaluate(const curvewise_curve* P, const curvewise_curve* Q,
                                        int measure, const void* options, double* value,
                                        curvewise_error* error);

/** Writes C minus P's minimum, divided by P's extent, to out[i * dim + c] (pointwise.hpp). */
CURVEWISE_EXPORT int curvewise_normalize(const curvewise_curve* P, const curvewise_curve* C,
                                         double* out, curvewise_error* error);

/** The result of curvewise_compare(). A measure of the plane is NaN if the curves do not have two
 * coordinates. */
typedef struct curvewise_comparison {
    size_t size; /**< of the struct: nothing is written behind it */
    double area, pcm, frechet, dtw, curve_length;
} curvewise_comparison;
/** Sets the size. */
#define CURVEWISE_COMPARISON \
    { sizeof(curvewise_comparison), 0.0, 0.0, 0.0, 0.0, 0.0 }

/** Several measures at once, under the conditions of a preset (compare.hpp). `found` starts from
 * CURVEWISE_COMPARISON. */
CURVEWISE_EXPORT int curvewise_compare(const curvewise_curve* P, const curvewise_curve* Q,
                                       const curvewise_compare_options* options,
                                       curvewise_comparison* found, curvewise_error* error);

/** A distance and the path that attains it, as in alignment.hpp: path[2 k] is the index of a point
 * of P and path[2 k + 1] of the point of Q that it is matched to. `path` has room for `capacity`
 * pairs, of which n + m are always enough; *count is their number. */
CURVEWISE_EXPORT int curvewise_dtw_path(const curvewise_curve* P, const curvewise_curve* Q,
                                        const curvewise_dtw_options* options, double* distance,
                                        int64_t* path, ptrdiff_t capacity, ptrdiff_t* count,
                                        curvewise_error* error);
/** The same for frechet.hpp. */
CURVEWISE_EXPORT int curvewise_frechet_path(const curvewise_curve* P, const curvewise_curve* Q,
                                            const curvewise_frechet_options* options,
                                            double* distance, int64_t* path, ptrdiff_t capacity,
                                            ptrdiff_t* count, curvewise_error* error);

/** Where pcm places the shorter curve on the longer one: PcmMatch in pcm.hpp. */
typedef struct curvewise_pcm_place {
    size_t size; /**< of the struct: nothing is written behind it */
    int maps_p;  /**< whether P is the shorter curve, whose points are mapped */
    double value, offset, coverage, tolerance;
} curvewise_pcm_place;
/** Sets the size. */
#define CURVEWISE_PCM_PLACE \
    { sizeof(curvewise_pcm_place), 0, 0.0, 0.0, 0.0, 0.0 }

/** The measure of pcm.hpp and where it is attained. `place` starts from CURVEWISE_PCM_PLACE. The
 * mapped points of the shorter curve go to points[2 k] (x) and points[2 k + 1] (y). There is room
 * for `capacity` of them, of which max(n, m) are always enough, and *count is their number. If
 * `points` is NULL, they are not written, and `count` may be NULL. */
CURVEWISE_EXPORT int curvewise_pcm_match(const curvewise_curve* P, const curvewise_curve* Q,
                                         const curvewise_pcm_options* options,
                                         curvewise_pcm_place* place, double* points,
                                         ptrdiff_t capacity, ptrdiff_t* count,
                                         curvewise_error* error);

/** The quadrilaterals behind curvewise_area(): area k is areas[k], and its vertices are quads[8 k]
 * to quads[8 k + 7] as x0, y0, x1, y1, ... Both have room for `capacity` quadrilaterals, and *count
 * is their number. If both are NULL, only *count is written. `options->squared` is not used. */
CURVEWISE_EXPORT int curvewise_area_quads(const curvewise_curve* P, const curvewise_curve* Q,
                                          const curvewise_area_options* options, double* quads,
                                          double* areas, ptrdiff_t capacity, ptrdiff_t* count,
                                          curvewise_error* error);

#ifdef __cplusplus
}
#endif

#endif
/* NOLINTEND(modernize-*,readability-identifier-naming) */
