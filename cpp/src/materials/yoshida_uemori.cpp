// The Yoshida-Uemori material: its parameters and their valid values.
#include "materials/yoshida_uemori.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/law.inl.hpp"

namespace curvewise::materials {

std::size_t place_of_bound(const YoshidaUemori& material) {
    return material.modulus == Modulus::constant ? 1 : 3;
}

std::vector<MaterialParameter> Law<YoshidaUemori>::parameters(const YoshidaUemori& material) {
    std::vector<MaterialParameter> parameters = modulus_parameters(material.modulus);
    parameters.push_back({"CB", "stress", "initial size of the bounding surface"});
    parameters.push_back({"Y", "stress", "size of the yield surface"});
    parameters.push_back({"C", "-", "rate of the yield surface's motion"});
    parameters.push_back({"K", "-", "rate of the bounding surface's motion and growth"});
    parameters.push_back({"RSAT", "stress", "final growth of the bounding surface"});
    parameters.push_back({"SB", "stress", "limit of the motion of the bounding surface's centre"});
    parameters.push_back({"H", "-", "share of growth in the stagnation surface's motion"});
    if (material.growth == BoundGrowth::power) {
        parameters[parameters.size() - 3].meaning = "factor of the bounding surface's growth";
        parameters.push_back({"C1", "-", "plastic strain at which the power law of growth begins"});
        parameters.push_back({"C2", "-", "exponent of the power law of growth"});
    }
    return parameters;
}

void Law<YoshidaUemori>::check(const YoshidaUemori& material, const Parameters& given) {
    check_modulus(given, material.modulus);
    const std::size_t CB = place_of_bound(material), Y = CB + 1, C = CB + 2, H = CB + 6;
    given.above_zero(Y);
    given.above_zero(C);
    for (std::size_t i = C + 1; i < given.count(); ++i) given.at_least_zero(i);
    if (given[CB] <= given[Y]) {
        given.refuse(CB, "the bounding surface must enclose the yield surface; give CB > Y");
    }
    if (material.growth == BoundGrowth::power && given[H + 1] == 0.0) {
        given.refuse(H + 1, "it must be above 0");
    }
    constexpr double most_share = 1e6;  // beyond it rounding decides where growth stagnates
    if (given[H] > most_share) given.refuse(H, "it must be at most 1e6");
    if (!(material.rtol >= 1e-12 && material.rtol <= 1e-3)) {
        throw std::invalid_argument("rtol is " + text_of(material.rtol) +
                                    "; give a number from 1e-12 to 1e-3");
    }
}

double Law<YoshidaUemori>::largest_stress(const YoshidaUemori& material, const Parameters& checked,
                                          const StrainPath& path) {
    const std::size_t CB = place_of_bound(material), RSAT = CB + 4, SB = CB + 5, H = CB + 6;
    double growth = checked[RSAT];
    if (material.growth == BoundGrowth::power) {
        const double C1 = checked[H + 1], C2 = checked[H + 2];
        growth *= std::pow(C1 + path.length(), C2) - std::pow(C1, C2);
    }
    return with_rounding(checked[CB] + growth + checked[SB], 10.0 * material.rtol);
}

template struct ByStrain<YoshidaUemori>;

}  // namespace curvewise::materials
