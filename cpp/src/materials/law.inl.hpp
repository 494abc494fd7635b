// The functions of a material from its law (law.hpp): checks, then the walk along the path.
#pragma once

#include "materials/control_by_stress.hpp"
#include "materials/law.hpp"
#include "materials/path.hpp"

namespace curvewise::materials {

template <class Options>
Parameters checked_parameters(const Options& material, const double* values) {
    const Parameters given(Law<Options>::parameters(material), values);
    Law<Options>::check(material, given);
    return given;
}

template <class Options>
std::vector<MaterialParameter> ByStrain<Options>::parameters(const Options& material) {
    return Law<Options>::parameters(material);
}

template <class Options>
void ByStrain<Options>::stress(const Options& material, const double* parameters,
                               const double* strain, std::ptrdiff_t n, double* stress,
                               double* slopes, Control* control) {
    const Parameters checked = checked_parameters(material, parameters);
    check_strains(strain, n);
    const double most = Law<Options>::largest_stress(material, checked, {strain, n});
    try {
        integrate<Law<Options>::template Point>(material, checked, most, strain, n, stress, slopes,
                                                control);
    } catch (const NoStress& found) {
        checked.refuse(found);
    }
}

template <class Options>
void ByStress<Options>::response(const Options& material, const double* parameters,
                                 const double* given, const bool* by_stress, std::ptrdiff_t n,
                                 double* answer, double* slopes, Control* control) {
    const Parameters checked = checked_parameters(material, parameters);
    check_given(given, by_stress, n);
    const double most = Law<Options>::largest_stress(material, checked, {nullptr, n});
    try {
        respond<Law<Options>::template Point>(material, checked, most, given, by_stress, n, answer,
                                              slopes, control);
    } catch (const NoStress& found) {
        checked.refuse(found);
    }
}

}  // namespace curvewise::materials
