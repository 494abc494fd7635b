/** \file
 * The options of the functions of curvewise.h, and the values that they choose from. Every struct
 * begins with its size, which CURVEWISE_..._DEFAULTS sets. A struct may grow in a later version.
 * The functions read only the options that `size` covers, and take the defaults of the others, so a
 * program continues to work with a newer library. */
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): rules for C++ */
#ifndef CURVEWISE_C_OPTIONS_H
#define CURVEWISE_C_OPTIONS_H

#include <math.h>
#include <stddef.h>

#include "curvewise/c_types.h"

/** Values of `measure`. The `options` next to it point to the options of the measure (to a
 * curvewise_dtw_options for CURVEWISE_DTW), or are NULL. */
enum curvewise_measure {
    CURVEWISE_AREA,
    CURVEWISE_PCM,
    CURVEWISE_FRECHET,
    CURVEWISE_DTW,
    CURVEWISE_CURVE_LENGTH,
    CURVEWISE_FRECHET_CONTINUOUS
};

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
enum curvewise_crossing { CURVEWISE_REARRANGE, CURVEWISE_SPLIT, CURVEWISE_POLYGON };
/** Values of curvewise_curve_length_options.scale. */
enum curvewise_length_scale { CURVEWISE_MEAN, CURVEWISE_MEAN_ABS, CURVEWISE_RANGE };

/** Values of curvewise_compare_options.preset. */
enum curvewise_preset { CURVEWISE_SCALED, CURVEWISE_PAPER, CURVEWISE_RAW };

/** Options of curvewise_area(), as in area.hpp. */
typedef struct curvewise_area_options {
    size_t size;                /**< of the struct */
    curvewise_control* control; /**< watches and stops the call; may be NULL */
    int spacing;                /**< curvewise_spacing */
    int crossing;               /**< curvewise_crossing */
    int squared;                /**< not 0: sum the squared areas */
    int closed;                 /**< not 0: join the ends of both curves */
} curvewise_area_options;
/** The options for NULL. */
#define CURVEWISE_AREA_DEFAULTS \
    { sizeof(curvewise_area_options), NULL, CURVEWISE_SPACING_DISTANCE, CURVEWISE_REARRANGE, 0, 0 }

/** Options of curvewise_pcm(), as in pcm.hpp. */
typedef struct curvewise_pcm_options {
    size_t size;
    curvewise_control* control;
    ptrdiff_t offsets; /**< at least 1 */
    int continuous;    /**< not 0: search all offsets; `offsets` is not used */
} curvewise_pcm_options;
/** The options for NULL. */
#define CURVEWISE_PCM_DEFAULTS \
    { sizeof(curvewise_pcm_options), NULL, 200, 0 }

/** Options of curvewise_frechet(), as in frechet.hpp. */
typedef struct curvewise_frechet_options {
    size_t size;
    curvewise_control* control;
    int metric;        /**< curvewise_metric */
    double p;          /**< the order of CURVEWISE_MINKOWSKI; not used by other metrics */
    ptrdiff_t workers; /**< threads, -1 for one per core */
    int prune;         /**< not 0: skip cells that cannot affect the result */
    double cutoff;     /**< a value above it becomes infinity */
    double radius;     /**< of the sphere of CURVEWISE_HAVERSINE; not used by other metrics */
    int closed;        /**< not 0: both curves are closed (closed_curves.hpp); not in batches */
} curvewise_frechet_options;
/** The options for NULL. */
#define CURVEWISE_FRECHET_DEFAULTS                                                         \
    {                                                                                      \
        sizeof(curvewise_frechet_options), NULL, CURVEWISE_EUCLIDEAN, 2.0, 1, 1, HUGE_VAL, \
            6371008.8, 0                                                                   \
    }

/** Options of curvewise_dtw(), as in dtw.hpp. */
typedef struct curvewise_dtw_options {
    size_t size;
    curvewise_control* control;
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
    int closed; /**< not 0: both curves are closed (closed_curves.hpp); not in batches */
} curvewise_dtw_options;
/** As the window: no band. */
#define CURVEWISE_NO_WINDOW (-1)
/** The options for NULL. */
#define CURVEWISE_DTW_DEFAULTS                                                                     \
    {                                                                                              \
        sizeof(curvewise_dtw_options), NULL, CURVEWISE_EUCLIDEAN, 2.0, CURVEWISE_SYMMETRIC1, 0, 0, \
            CURVEWISE_NO_WINDOW, 1, 1, HUGE_VAL, 0.0, 0, 0.0, 6371008.8, 0, 0, 0, 0, 0             \
    }

/** Options of curvewise_curve_length(), as in curve_length.hpp. */
typedef struct curvewise_curve_length_options {
    size_t size;
    curvewise_control* control;
    int scale; /**< curvewise_length_scale */
} curvewise_curve_length_options;
/** The options for NULL. */
#define CURVEWISE_CURVE_LENGTH_DEFAULTS \
    { sizeof(curvewise_curve_length_options), NULL, CURVEWISE_MEAN }

/** Options of curvewise_frechet_continuous(), as in frechet_continuous.hpp. */
typedef struct curvewise_frechet_continuous_options {
    size_t size;
    curvewise_control* control;
    ptrdiff_t workers; /**< threads, -1 for one per core; one pair is searched by one thread */
    int closed;        /**< not 0: both curves are closed; not in batches */
} curvewise_frechet_continuous_options;
/** The options for NULL. */
#define CURVEWISE_FRECHET_CONTINUOUS_DEFAULTS \
    { sizeof(curvewise_frechet_continuous_options), NULL, 1, 0 }

/** Options of curvewise_compare(), as in compare.hpp. */
typedef struct curvewise_compare_options {
    size_t size;
    curvewise_control* control; /**< watches one measure after the other */
    int preset;                 /**< curvewise_preset */
} curvewise_compare_options;
/** The options for NULL. */
#define CURVEWISE_COMPARE_DEFAULTS \
    { sizeof(curvewise_compare_options), NULL, CURVEWISE_SCALED }

/** How calls with many curves are run, as in pairwise.hpp. The options of the measure have their
 * own `control` and `workers` are then not used. */
typedef struct curvewise_batch_options {
    size_t size;
    curvewise_control* control;
    ptrdiff_t workers; /**< threads, -1 for one per core; the measure's own are not used */
    double cutoff;     /**< a value above it becomes infinity, which may save its computation */
} curvewise_batch_options;
/** The options for NULL. */
#define CURVEWISE_BATCH_DEFAULTS \
    { sizeof(curvewise_batch_options), NULL, 1, HUGE_VAL }

/** How an index is searched, as in nearest.hpp. */
typedef struct curvewise_search_options {
    size_t size;
    curvewise_control* control;
    ptrdiff_t workers; /**< threads, -1 for one per core; the measure's own are not used */
    int sort_results; /**< not 0: neighbours within a radius by distance, then index; 0: by index */
    int with_distances; /**< not 0: compute the distances of the neighbours within a radius */
} curvewise_search_options;
/** The options for NULL. */
#define CURVEWISE_SEARCH_DEFAULTS \
    { sizeof(curvewise_search_options), NULL, 1, 1, 1 }

#endif
/* NOLINTEND(modernize-*,readability-identifier-naming) */
