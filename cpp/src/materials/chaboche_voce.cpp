// The Chaboche-Voce material: its parameters, their valid values, and the walk along a path.
#include "materials/chaboche_voce.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "curvewise/materials.hpp"

namespace curvewise {
namespace materials {

Parameters checked_parameters(const ChabocheVoce& material, const double* values) {
    const Parameters checked(material_parameters(material), values);
    check_modulus(checked, material.modulus);
    const std::size_t yield = place_of_yield(material.modulus);
    checked.above_zero(yield);
    for (std::size_t i = yield + 2; i < checked.count(); ++i) checked.at_least_zero(i);
    if (checked[yield] + checked[yield + 1] <= 0.0) {
        checked.refuse(yield + 1, "a yield stress of " + text_of(checked[yield]) +
                                      " would soften to nothing; give Q > -yield");
    }
    return checked;
}

double largest_stress(const ChabocheVoce& material, const Parameters& checked) {
    const std::size_t yield = place_of_yield(material.modulus);
    double most = checked[yield] + std::max(0.0, checked[yield + 1]);
    for (std::size_t i = yield + 3; i < checked.count(); i += 2) {
        if (checked[i] > 0.0) most += checked[i] / checked[i + 1];
    }
    return with_rounding(most, 1e-9);
}

}  // namespace materials

std::vector<MaterialParameter> material_parameters(const ChabocheVoce& material) {
    if (material.backstresses < 0 || material.backstresses > 99) {
        throw std::invalid_argument("backstresses is " + std::to_string(material.backstresses) +
                                    "; give a whole number from 0 to 99");
    }
    std::vector<MaterialParameter> parameters = materials::modulus_parameters(material.modulus);
    parameters.push_back({"yield", "stress", "initial yield stress"});
    parameters.push_back(
        {"Q", "stress", "final increase of the yield stress; negative: softening"});
    parameters.push_back({"b", "-", "rate of this increase with the plastic strain"});
    for (int k = 1; k <= material.backstresses; ++k) {
        const std::string number = std::to_string(k);
        parameters.push_back({"C" + number, "stress", "initial modulus of back stress " + number});
        parameters.push_back(
            {"gamma" + number, "-",
             "recall of back stress " + number + ", which saturates at C / gamma"});
    }
    return parameters;
}

void material_stress(const ChabocheVoce& material, const double* parameters, const double* strain,
                     std::ptrdiff_t n, double* stress, double* slopes, Control* control) {
    const materials::Parameters checked = materials::checked_parameters(material, parameters);
    materials::check_strains(strain, n);
    const double most = materials::largest_stress(material, checked);
    try {
        materials::integrate<materials::ChabocheVocePoint>(material, checked, most, strain, n,
                                                           stress, slopes, control);
    } catch (const materials::NoStress& found) {
        checked.refuse(found);
    }
}

}  // namespace curvewise
