// The responses of materials to paths that give strains or stresses. They stand apart from
// material_stress(), so that the compiler inlines the points there as if this did not exist: in one
// file they made it take 8 % more instructions.
#include <cstddef>

#include "curvewise/materials.hpp"
#include "materials/chaboche_voce.hpp"
#include "materials/control_by_stress.hpp"
#include "materials/yoshida_uemori.hpp"

namespace curvewise {

void material_response(const ChabocheVoce& material, const double* parameters, const double* given,
                       const bool* by_stress, std::ptrdiff_t n, double* answer, double* slopes,
                       Control* control) {
    const materials::Parameters checked = materials::checked_parameters(material, parameters);
    materials::check_given(given, by_stress, n);
    const double most = materials::largest_stress(material, checked);
    try {
        materials::respond<materials::ChabocheVocePoint>(material, checked, most, given, by_stress,
                                                         n, answer, slopes, control);
    } catch (const materials::NoStress& found) {
        checked.refuse(found);
    }
}

void material_response(const YoshidaUemori& material, const double* parameters, const double* given,
                       const bool* by_stress, std::ptrdiff_t n, double* answer, double* slopes,
                       Control* control) {
    const materials::Parameters checked = materials::checked_parameters(material, parameters);
    materials::check_given(given, by_stress, n);
    const double longest = 2.0 * materials::most_strain * static_cast<double>(n);
    const double most = materials::largest_stress(material, checked, longest);
    try {
        materials::respond<materials::YoshidaUemoriPoint>(material, checked, most, given, by_stress,
                                                          n, answer, slopes, control);
    } catch (const materials::NoStress& found) {
        checked.refuse(found);
    }
}

}  // namespace curvewise
