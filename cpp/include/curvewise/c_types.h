/** \file
 * What all functions of curvewise.h take: a curve, a status, a message, and a control, by which
 * another thread watches a long call and stops it. */
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): rules for C++ */
#ifndef CURVEWISE_C_TYPES_H
#define CURVEWISE_C_TYPES_H

#include <stddef.h>
#include <stdint.h>

#include "curvewise/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The result of a call. */
enum curvewise_status {
    CURVEWISE_OK = 0,
    CURVEWISE_INVALID_ARGUMENT = 1, /**< a curve or an option is refused */
    CURVEWISE_NO_MEMORY = 2,
    CURVEWISE_FAILED = 3, /**< anything else, e.g. CURVEWISE_ISA names a level this machine lacks */
    CURVEWISE_STOPPED = 4, /**< by its control; result arrays are then unspecified */
    CURVEWISE_NO_ROOM = 5  /**< an array has too few elements; *count has the number it needs */
};

/** One line, ended by a zero; a longer message is cut. Empty after CURVEWISE_OK. */
typedef struct curvewise_error {
    char message[256];
} curvewise_error;

/** n points of dim coordinates; coordinate c of point i is data[i * row_stride + c * col_stride].
 * Strides count doubles and may be negative. */
typedef struct curvewise_curve {
    const double* data;
    ptrdiff_t n, dim, row_stride, col_stride;
} curvewise_curve;

/** Row-major points: x0, y0, x1, y1, ... */
CURVEWISE_EXPORT curvewise_curve curvewise_rows(const double* data, ptrdiff_t n, ptrdiff_t dim);

/** Watches a call and can stop it, as in control.hpp: `options.control` of the call points to it.
 * It serves one call at a time, and can be used again unless it was stopped. */
typedef struct curvewise_control curvewise_control;

/** Called by the thread that made the call, about once an interval and once at the end. Returns
 * not 0 to continue, and 0 to stop. It must not throw, and must not leave by longjmp(). */
typedef int (*curvewise_report)(void* context, int64_t done, int64_t total);

/** Creates a control with a report, or without one if that is NULL. The report takes `context`, and
 * is called about once in `interval` milliseconds (at least 0; 50 is usual). */
CURVEWISE_EXPORT int curvewise_control_create(curvewise_report report, void* context, int interval,
                                              curvewise_control** control, curvewise_error* error);
/** Frees a control, which no call uses any more; NULL is allowed. */
CURVEWISE_EXPORT void curvewise_control_destroy(curvewise_control* control);
/** Stops the call, which returns CURVEWISE_STOPPED. Any thread and any signal handler may call it,
 * also before the call. */
CURVEWISE_EXPORT void curvewise_control_stop(curvewise_control* control);
/** Whether it was stopped. */
CURVEWISE_EXPORT int curvewise_control_stopped(const curvewise_control* control);
/** The steps that are done. Any thread may read it during the call. */
CURVEWISE_EXPORT int64_t curvewise_control_done(const curvewise_control* control);
/** The steps of the call. */
CURVEWISE_EXPORT int64_t curvewise_control_total(const curvewise_control* control);

#ifdef __cplusplus
}
#endif

#endif
/* NOLINTEND(modernize-*,readability-identifier-naming) */
