/** \file
 * Material points, as in materials.hpp: stresses along a path of strain, and the response to a path
 * that gives stresses. */
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): rules for C++ */
#ifndef CURVEWISE_C_MATERIALS_H
#define CURVEWISE_C_MATERIALS_H

#include "curvewise/c_options.h"

#ifdef __cplusplus
extern "C" {
#endif

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

/** Writes the response to a path that gives the stress at some points and the strain at the others.
 * Where by_stress[i] is not 0, given[i] is a stress and answer[i] becomes the strain; elsewhere
 * given[i] is a strain and answer[i] becomes the stress. If `by_stress` is NULL, all are stresses.
 * `slopes` are those of the answers. */
CURVEWISE_EXPORT int curvewise_chaboche_voce_response(const curvewise_chaboche_voce* material,
                                                      const double* parameters, ptrdiff_t count,
                                                      const double* given, const int* by_stress,
                                                      ptrdiff_t n, double* answer, double* slopes,
                                                      curvewise_error* error);
/** The same for the other material. */
CURVEWISE_EXPORT int curvewise_yoshida_uemori_response(const curvewise_yoshida_uemori* material,
                                                       const double* parameters, ptrdiff_t count,
                                                       const double* given, const int* by_stress,
                                                       ptrdiff_t n, double* answer, double* slopes,
                                                       curvewise_error* error);

#ifdef __cplusplus
}
#endif

#endif
/* NOLINTEND(modernize-*,readability-identifier-naming) */
