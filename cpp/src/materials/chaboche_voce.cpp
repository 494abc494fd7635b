// The Chaboche-Voce material: its parameters and their valid values.
#include "materials/chaboche_voce.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/law.inl.hpp"

namespace curvewise::materials {

std::vector<MaterialParameter> Law<ChabocheVoce>::parameters(const ChabocheVoce& material) {
    if (material.backstresses < 0 || material.backstresses > 99) {
        throw std::invalid_argument("backstresses is " + std::to_string(material.backstresses) +
                                    "; give a whole number from 0 to 99");
    }
    std::vector<MaterialParameter> parameters = modulus_parameters(material.modulus);
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

void Law<ChabocheVoce>::check(const ChabocheVoce& material, const Parameters& given) {
    check_modulus(given, material.modulus);
    const std::size_t yield = place_of_yield(material.modulus);
    given.above_zero(yield);
    for (std::size_t i = yield + 2; i < given.count(); ++i) given.at_least_zero(i);
    if (given[yield] + given[yield + 1] <= 0.0) {
        given.refuse(yield + 1, "a yield stress of " + text_of(given[yield]) +
                                    " would soften to nothing; give Q > -yield");
    }
}

double Law<ChabocheVoce>::largest_stress(const ChabocheVoce& material, const Parameters& checked,
                                         const StrainPath& /*path*/) {
    const std::size_t yield = place_of_yield(material.modulus);
    double most = checked[yield] + std::max(0.0, checked[yield + 1]);
    for (std::size_t i = yield + 3; i < checked.count(); i += 2) {
        if (checked[i] > 0.0) most += checked[i] / checked[i + 1];
    }
    return with_rounding(most, 1e-9);
}

template struct ByStrain<ChabocheVoce>;

}  // namespace curvewise::materials
