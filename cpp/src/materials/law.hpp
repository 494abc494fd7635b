// What the library needs of a material, behind materials.hpp. The header or the source of a law
// specialises Law for the options of its material:
//
//     template <>
//     struct Law<Options> {
//         template <class Number>
//         using Point = ...;                                  // walk() of path.hpp says of what
//         static std::vector<MaterialParameter> parameters(const Options& material);
//         static void check(const Options& material, const Parameters& given);   // may refuse
//         static double largest_stress(const Options& material, const Parameters& checked,
//                                      const StrainPath& path);
//     };
//
// Its source instantiates ByStrain<Options> and ByStress<Options>, with law.inl.hpp.
#pragma once

#include <cstddef>
#include <vector>

#include "curvewise/materials.hpp"

namespace curvewise::materials {

template <class Options>
struct Law;

// The functions of materials.hpp for one material.
template <class Options>
struct ByStrain {
    static std::vector<MaterialParameter> parameters(const Options& material);
    static void stress(const Options& material, const double* parameters, const double* strain,
                       std::ptrdiff_t n, double* stress, double* slopes, Control* control);
};
template <class Options>
struct ByStress {
    static void response(const Options& material, const double* parameters, const double* given,
                         const bool* by_stress, std::ptrdiff_t n, double* answer, double* slopes,
                         Control* control);
};

}  // namespace curvewise::materials
