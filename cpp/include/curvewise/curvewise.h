/** \file
 * curvewise for C (C99), and through cpp/fortran/curvewise.f90 for Fortran: the measures of two
 * curves, batches, prepared curves and indexes of many, and material points. The C++ header of each
 * of them has its definition, cost and errors (area.hpp, pairwise.hpp, materials.hpp, ...). The
 * numbers are bitwise identical.
 *
 *     curvewise_curve P = curvewise_rows(xy, 240, 2), Q = curvewise_rows(uv, 150, 2);
 *     double value;
 *     curvewise_error error;
 *     if (curvewise_dtw(&P, &Q, NULL, &value, &error) != CURVEWISE_OK) puts(error.message);
 *
 * There is no state: any number of threads may call all functions. You free nothing but what a
 * function `..._create` returned, by `..._destroy`. Curves are read in place. NULL options are the
 * defaults; otherwise start from CURVEWISE_..._DEFAULTS, which sets the size, too. A struct of
 * zeros is refused. Every function that can fail returns a curvewise_status. It writes its result
 * only if that is CURVEWISE_OK. It writes the message to `error`, which may be NULL. */
#ifndef CURVEWISE_CURVEWISE_H
#define CURVEWISE_CURVEWISE_H

#include "curvewise/c_many.h"
#include "curvewise/c_materials.h"
#include "curvewise/c_measures.h"
#include "curvewise/c_options.h"
#include "curvewise/c_types.h"
#include "curvewise/export.h"
#include "curvewise/version.hpp" /* CURVEWISE_VERSION_MAJOR, _MINOR and _PATCH */

#ifdef __cplusplus
extern "C" {
#endif

/** The version of the library that is linked, e.g. "0.1.0". */
CURVEWISE_EXPORT const char* curvewise_version(void);

#ifdef __cplusplus
}
#endif

#endif
