/** \file
 * Material points, as in materials.hpp: stresses along a path of strain, and the response to a path
 * that gives stresses. `material` names a material of materials.hpp, with options after it:
 * "chaboche-voce", or "yoshida-uemori growth=power modulus=decaying". Its `count` parameters are in
 * the order of materials.hpp: E (Ea, xi), yield, Q, b, C1, gamma1, C2, ... for "chaboche-voce". A
 * wrong count is an error that lists them. */
/* NOLINTBEGIN(modernize-*,readability-identifier-naming): rules for C++ */
#ifndef CURVEWISE_C_MATERIALS_H
#define CURVEWISE_C_MATERIALS_H

#include "curvewise/c_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the stress at each of n strains of an initially unloaded material point. If `slopes` is
 * not NULL, slopes[i * count + j] becomes the derivative of stress i by parameter j. */
CURVEWISE_EXPORT int curvewise_material_stress(const char* material, const double* parameters,
                                               ptrdiff_t count, const double* strain, ptrdiff_t n,
                                               double* stress, double* slopes,
                                               curvewise_error* error);

/** Writes the response to a path that gives the stress at some points and the strain at the others.
 * Where by_stress[i] is not 0, given[i] is a stress and answer[i] becomes the strain; elsewhere
 * given[i] is a strain and answer[i] becomes the stress. If `by_stress` is NULL, all are stresses.
 * `slopes` are those of the answers. */
CURVEWISE_EXPORT int curvewise_material_response(const char* material, const double* parameters,
                                                 ptrdiff_t count, const double* given,
                                                 const int* by_stress, ptrdiff_t n, double* answer,
                                                 double* slopes, curvewise_error* error);

#ifdef __cplusplus
}
#endif

#endif
/* NOLINTEND(modernize-*,readability-identifier-naming) */
