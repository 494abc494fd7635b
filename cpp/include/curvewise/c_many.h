/** \file
 * Many curves: all pairs, one curve against others as they come, and the nearest of many. */
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): rules for C++ */
#ifndef CURVEWISE_C_MANY_H
#define CURVEWISE_C_MANY_H

#include "curvewise/c_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the measure of XA[i] (as P) and XB[j] (as Q) to out[i * nb + j]. */
CURVEWISE_EXPORT int curvewise_cdist(const curvewise_curve* XA, ptrdiff_t na,
                                     const curvewise_curve* XB, ptrdiff_t nb, int measure,
                                     const void* options, const curvewise_batch_options* batch,
                                     double* out, curvewise_error* error);

/** Writes the measure of X[i] and X[j], i < j, row by row: k (k - 1) / 2 values: (0, 1), (0, 2)
 * and so on. For symmetric measures: area except with the spacings arc_length and matched, both
 * Frechet distances, and dtw without open ends. */
CURVEWISE_EXPORT int curvewise_pdist(const curvewise_curve* X, ptrdiff_t k, int measure,
                                     const void* options, const curvewise_batch_options* batch,
                                     double* out, curvewise_error* error);

/** A curve P, checked, packed and scaled once, for comparison with others. It owns a copy of P. Any
 * number of threads may use it. */
typedef struct curvewise_prepared curvewise_prepared;

/** Prepares P. curvewise_prepared_destroy() frees the result. */
CURVEWISE_EXPORT int curvewise_prepared_create(const curvewise_curve* P, int measure,
                                               const void* options, curvewise_prepared** prepared,
                                               curvewise_error* error);
/** Frees it, when no call uses it any more; NULL is allowed. */
CURVEWISE_EXPORT void curvewise_prepared_destroy(curvewise_prepared* prepared);
/** The measure of P and Q, in *value; infinity if it is above the cutoff of `batch`. */
CURVEWISE_EXPORT int curvewise_prepared_value(const curvewise_prepared* prepared,
                                              const curvewise_curve* Q,
                                              const curvewise_batch_options* batch, double* value,
                                              curvewise_error* error);
/** Writes the measure of P and Q[j] to out[j], for all `count` of them. */
CURVEWISE_EXPORT int curvewise_prepared_values(const curvewise_prepared* prepared,
                                               const curvewise_curve* Q, ptrdiff_t count,
                                               const curvewise_batch_options* batch, double* out,
                                               curvewise_error* error);

/** Curves to search for the nearest of other curves, exactly, as in nearest.hpp. It owns copies of
 * them. Curves are numbered from 0 on in the order in which they are added; the number of a curve
 * never changes. Any number of threads may use an index, also while curves are added. */
typedef struct curvewise_index curvewise_index;

/** Creates an index of `count` curves, which may be 0. curvewise_index_destroy() frees it. */
CURVEWISE_EXPORT int curvewise_index_create(const curvewise_curve* curves, ptrdiff_t count,
                                            int measure, const void* options,
                                            curvewise_control* control, curvewise_index** index,
                                            curvewise_error* error);
/** Frees it, when no call uses it any more; NULL is allowed. */
CURVEWISE_EXPORT void curvewise_index_destroy(curvewise_index* index);
/** Adds all of the curves, or none if it fails. */
CURVEWISE_EXPORT int curvewise_index_add(curvewise_index* index, const curvewise_curve* curves,
                                         ptrdiff_t count, curvewise_control* control,
                                         curvewise_error* error);
/** Removes the curves of these indices, or none if it fails. Later calls do not see them. */
CURVEWISE_EXPORT int curvewise_index_remove(curvewise_index* index, const int64_t* indices,
                                            ptrdiff_t count, curvewise_error* error);
/** The number of its curves, without those removed; 0 for NULL. */
CURVEWISE_EXPORT ptrdiff_t curvewise_index_size(const curvewise_index* index);
/** Writes the indices of its curves in ascending order, and their number to *count. If there are
 * more than `capacity`, the call returns CURVEWISE_NO_ROOM and writes only *count. */
CURVEWISE_EXPORT int curvewise_index_indices(const curvewise_index* index, int64_t* indices,
                                             ptrdiff_t capacity, ptrdiff_t* count,
                                             curvewise_error* error);
/** Writes a file of the curves, without those removed, with their indices. At the end, the file
 * replaces another of this name. If the call fails, an older file stays as it is. The name is in
 * UTF-8 on Windows, and as the system has it elsewhere. */
CURVEWISE_EXPORT int curvewise_index_save(const curvewise_index* index, const char* path,
                                          curvewise_control* control, curvewise_error* error);
/** Opens a file of curvewise_index_save(), of C++ or of Python. Processes that open the same file
 * share its points in memory. CURVEWISE_FAILED says that there is no such file, that it is damaged,
 * or that it is no index. curvewise_index_destroy() frees the index. */
CURVEWISE_EXPORT int curvewise_index_open(const char* path, int measure, const void* options,
                                          curvewise_control* control, curvewise_index** index,
                                          curvewise_error* error);

/** Writes the n_neighbors nearest of X[i] to distances[i * n_neighbors] and indices[i *
 * n_neighbors] on, in ascending order. n_neighbors is from 1 to the size of the index. */
CURVEWISE_EXPORT int curvewise_index_kneighbors(const curvewise_index* index,
                                                const curvewise_curve* X, ptrdiff_t count,
                                                ptrdiff_t n_neighbors,
                                                const curvewise_search_options* options,
                                                double* distances, int64_t* indices,
                                                curvewise_error* error);

/** All curves whose distance from X[i] is at most `radius`: their indices are indices[starts[i]] to
 * indices[starts[i + 1] - 1], and their distances stand at the same places of `distances`, which
 * may be NULL. `starts` has count + 1 elements; the others have room for `capacity` neighbours. If
 * there are more, the call returns CURVEWISE_NO_ROOM and writes only `starts`: repeat it with room
 * for starts[count]. If `indices` is NULL, `starts` is all that is written. */
CURVEWISE_EXPORT int curvewise_index_radius_neighbors(
    const curvewise_index* index, const curvewise_curve* X, ptrdiff_t count, double radius,
    const curvewise_search_options* options, ptrdiff_t* starts, double* distances, int64_t* indices,
    ptrdiff_t capacity, curvewise_error* error);

#ifdef __cplusplus
}
#endif

#endif
/* NOLINTEND(modernize-*,readability-identifier-naming) */
