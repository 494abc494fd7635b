/** \file
 * curvewise for C (C99), and through cpp/fortran/curvewise.f90 for Fortran: the measures, scaling,
 * all pairs of many curves, and material points. The C++ header of each measure or material has its
 * definition, cost and errors (area.hpp, pcm.hpp, frechet.hpp, dtw.hpp, curve_length.hpp,
 * pairwise.hpp, materials.hpp). The numbers are bitwise identical.
 *
 *     curvewise_curve P = curvewise_rows(xy, 240, 2), Q = curvewise_rows(uv, 150, 2);
 *     double value;
 *     curvewise_error error;
 *     if (curvewise_dtw(&P, &Q, NULL, &value, &error) != CURVEWISE_OK) puts(error.message);
 *
 * You create and free nothing, and there is no state: any number of threads may call all functions.
 * Curves are read in place and never copied by the caller. NULL options are the defaults; otherwise
 * start from CURVEWISE_..._DEFAULTS, since a struct of zeros is not the default. Every function
 * that can fail returns a curvewise_status. It writes its result only if that is CURVEWISE_OK. It
 * writes the message to `error`, which may be NULL. */
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): rules for C++ */
#ifndef CURVEWISE_CURVEWISE_H
#define CURVEWISE_CURVEWISE_H

#include <math.h>
#include <stddef.h>

#include "curvewise/export.h"
#include "curvewise/version.hpp" /* CURVEWISE_VERSION_MAJOR, _MINOR and _PATCH */

#ifdef __cplusplus
extern "C" {
#endif

/** The result of a call. */
enum curvewise_status {
    CURVEWISE_OK = 0,
    CURVEWISE_INVALID_ARGUMENT = 1, /**< a curve or an option is refused */
    CURVEWISE_NO_MEMORY = 2,
    CURVEWISE_FAILED = 3 /**< anything else, e.g. CURVEWISE_ISA names a level this machine lacks */
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

/** Values of `metric` in curvewise_dtw_options and curvewise_frechet_options. */
enum curvewise_metric {
    CURVEWISE_EUCLIDEAN,
    CURVEWISE_SQEUCLIDEAN,
    CURVEWISE_CITYBLOCK,
    CURVEWISE_CHEBYSHEV,
    CURVEWISE_MINKOWSKI,
    CURVEWISE_HAVERSINE /**< longitude and latitude in degrees, along the great circle */
};
/** Values of curvewise_dtw_options.step_pattern. */
enum curvewise_step_pattern {
    CURVEWISE_SYMMETRIC1,
    CURVEWISE_SYMMETRIC2,
    CURVEWISE_ASYMMETRIC,
    CURVEWISE_SYMMETRICP0,
    CURVEWISE_SYMMETRICP05,
    CURVEWISE_SYMMETRICP1,
    CURVEWISE_SYMMETRICP2,
    CURVEWISE_ASYMMETRICP0,
    CURVEWISE_ASYMMETRICP05,
    CURVEWISE_ASYMMETRICP1,
    CURVEWISE_ASYMMETRICP2,
    CURVEWISE_TYPEIA,
    CURVEWISE_TYPEIB,
    CURVEWISE_TYPEIC,
    CURVEWISE_TYPEID,
    CURVEWISE_TYPEIAS,
    CURVEWISE_TYPEIBS,
    CURVEWISE_TYPEICS,
    CURVEWISE_TYPEIDS,
    CURVEWISE_TYPEIIA,
    CURVEWISE_TYPEIIB,
    CURVEWISE_TYPEIIC,
    CURVEWISE_TYPEIID,
    CURVEWISE_TYPEIIIC,
    CURVEWISE_TYPEIVC,
    CURVEWISE_RIGID,
    CURVEWISE_MORI2006
};
/** Values of curvewise_area_options.spacing. */
enum curvewise_spacing {
    CURVEWISE_SPACING_DISTANCE,
    CURVEWISE_SPACING_X,
    CURVEWISE_SPACING_ARC_LENGTH,
    CURVEWISE_SPACING_MATCHED,
    CURVEWISE_SPACING_FUNCTION
};
/** Values of curvewise_area_options.crossing. */
enum curvewise_crossing { CURVEWISE_REARRANGE, CURVEWISE_SPLIT };
/** Values of curvewise_curve_length_options.scale. */
enum curvewise_length_scale { CURVEWISE_MEAN, CURVEWISE_MEAN_ABS, CURVEWISE_RANGE };

/** Options of curvewise_area(), as in area.hpp. */
typedef struct curvewise_area_options {
    int spacing;  /**< curvewise_spacing */
    int crossing; /**< curvewise_crossing */
    int squared;  /**< not 0: sum the squared areas */
} curvewise_area_options;
/** The options for NULL. */
#define CURVEWISE_AREA_DEFAULTS \
    { CURVEWISE_SPACING_DISTANCE, CURVEWISE_REARRANGE, 0 }

/** Options of curvewise_pcm(), as in pcm.hpp. */
typedef struct curvewise_pcm_options {
    ptrdiff_t offsets; /**< at least 1 */
    int continuous;    /**< not 0: search all offsets; `offsets` is not used */
} curvewise_pcm_options;
/** The options for NULL. */
#define CURVEWISE_PCM_DEFAULTS \
    { 200, 0 }

/** Options of curvewise_frechet(), as in frechet.hpp. */
typedef struct curvewise_frechet_options {
    int metric;        /**< curvewise_metric */
    double p;          /**< the order of CURVEWISE_MINKOWSKI; not used by other metrics */
    ptrdiff_t workers; /**< threads, -1 for one per core */
    int prune;         /**< not 0: skip cells that cannot affect the result */
    double cutoff;     /**< a value above it becomes infinity */
    double radius;     /**< of the sphere of CURVEWISE_HAVERSINE; not used by other metrics */
} curvewise_frechet_options;
/** The options for NULL. */
#define CURVEWISE_FRECHET_DEFAULTS \
    { CURVEWISE_EUCLIDEAN, 2.0, 1, 1, HUGE_VAL, 6371008.8 }

/** Options of curvewise_dtw(), as in dtw.hpp. */
typedef struct curvewise_dtw_options {
    int metric;
    double p;
    int step_pattern;       /**< curvewise_step_pattern */
    int open_begin;         /**< not 0: P is matched to a section of Q that may begin anywhere */
    int open_end;           /**< not 0: ... that may end anywhere */
    ptrdiff_t window;       /**< Sakoe-Chiba band, or CURVEWISE_NO_WINDOW */
    ptrdiff_t workers;      /**< threads, -1 for one per core */
    int prune;              /**< not 0: skip cells that cannot affect the result */
    double cutoff;          /**< a value above it becomes infinity */
    double window_fraction; /**< not 0: in place of window, a fraction of the longer curve */
    int normalize;          /**< not 0: divide by the weight of all paths, e.g. n + m */
    double penalty;         /**< of each step that leaves the diagonal */
    double radius;
    ptrdiff_t relax_p_begin; /**< maximum number of first points of P to omit */
    ptrdiff_t relax_p_end;   /**< maximum number of last points of P to omit */
    ptrdiff_t relax_q_begin; /**< the same of Q */
    ptrdiff_t relax_q_end;
} curvewise_dtw_options;
/** As the window: no band. */
#define CURVEWISE_NO_WINDOW (-1)
/** The options for NULL. */
#define CURVEWISE_DTW_DEFAULTS                                                                     \
    {                                                                                              \
        CURVEWISE_EUCLIDEAN, 2.0, CURVEWISE_SYMMETRIC1, 0, 0, CURVEWISE_NO_WINDOW, 1, 1, HUGE_VAL, \
            0.0, 0, 0.0, 6371008.8, 0, 0, 0, 0                                                     \
    }

/** Options of curvewise_curve_length(), as in curve_length.hpp. */
typedef struct curvewise_curve_length_options {
    int scale; /**< curvewise_length_scale */
} curvewise_curve_length_options;
/** The options for NULL. */
#define CURVEWISE_CURVE_LENGTH_DEFAULTS \
    { CURVEWISE_MEAN }

/** Options of curvewise_frechet_continuous(), as in frechet_continuous.hpp. */
typedef struct curvewise_frechet_continuous_options {
    ptrdiff_t workers; /**< threads, -1 for one per core; one pair is searched by one thread */
} curvewise_frechet_continuous_options;
/** The options for NULL. */
#define CURVEWISE_FRECHET_CONTINUOUS_DEFAULTS \
    { 1 }

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

/** Writes C minus P's minimum, divided by P's extent, to out[i * dim + c] (pointwise.hpp). */
CURVEWISE_EXPORT int curvewise_normalize(const curvewise_curve* P, const curvewise_curve* C,
                                         double* out, curvewise_error* error);

/** The measures of curvewise_cdist() and curvewise_pdist(), which compare many curves on several
 * threads. Their `options` point to the options of the measure (to a curvewise_dtw_options for
 * CURVEWISE_DTW), or are NULL. */
enum curvewise_measure {
    CURVEWISE_AREA,
    CURVEWISE_PCM,
    CURVEWISE_FRECHET,
    CURVEWISE_DTW,
    CURVEWISE_CURVE_LENGTH,
    CURVEWISE_FRECHET_CONTINUOUS
};

/** Options of curvewise_cdist() and curvewise_pdist(). */
typedef struct curvewise_batch_options {
    ptrdiff_t workers; /**< threads, -1 for one per core; the measure's own are not used */
    double cutoff;     /**< a value above it becomes infinity, which may save its computation */
} curvewise_batch_options;
/** The options for NULL. */
#define CURVEWISE_BATCH_DEFAULTS \
    { 1, HUGE_VAL }

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

/** Values of `modulus` of a material. */
enum curvewise_modulus { CURVEWISE_CONSTANT, CURVEWISE_DECAYING };
/** Values of curvewise_yoshida_uemori.growth. */
enum curvewise_growth { CURVEWISE_SATURATING, CURVEWISE_POWER };

/** Options of curvewise_chaboche_voce_stress(), as in materials.hpp. */
typedef struct curvewise_chaboche_voce {
    int backstresses; /**< 0 to 99 */
    int modulus;      /**< curvewise_modulus */
} curvewise_chaboche_voce;
/** The options for NULL. */
#define CURVEWISE_CHABOCHE_VOCE_DEFAULTS \
    { 2, CURVEWISE_CONSTANT }

/** Options of curvewise_yoshida_uemori_stress(), as in materials.hpp. */
typedef struct curvewise_yoshida_uemori {
    int growth;  /**< curvewise_growth */
    int modulus; /**< curvewise_modulus */
    double rtol; /**< the error that the integration may make, relative to CB */
} curvewise_yoshida_uemori;
/** The options for NULL. */
#define CURVEWISE_YOSHIDA_UEMORI_DEFAULTS \
    { CURVEWISE_SATURATING, CURVEWISE_CONSTANT, 1e-9 }

/** Writes the stress at each of n strains of an initially unloaded material point. It has `count`
 * parameters in the order of materials.hpp: E (Ea, xi), yield, Q, b, C1, gamma1, C2, ... If
 * `slopes` is not NULL, slopes[i * count + j] becomes the derivative of stress i by parameter j. */
CURVEWISE_EXPORT int curvewise_chaboche_voce_stress(const curvewise_chaboche_voce* material,
                                                    const double* parameters, ptrdiff_t count,
                                                    const double* strain, ptrdiff_t n,
                                                    double* stress, double* slopes,
                                                    curvewise_error* error);
/** The same; the parameters are E (Ea, xi), CB, Y, C, K, RSAT, SB, H (C1, C2). */
CURVEWISE_EXPORT int curvewise_yoshida_uemori_stress(const curvewise_yoshida_uemori* material,
                                                     const double* parameters, ptrdiff_t count,
                                                     const double* strain, ptrdiff_t n,
                                                     double* stress, double* slopes,
                                                     curvewise_error* error);

/** The version of the library that is linked, e.g. "0.1.0". */
CURVEWISE_EXPORT const char* curvewise_version(void);

#ifdef __cplusplus
}
#endif

#endif
/* NOLINTEND(modernize-*,readability-identifier-naming) */
