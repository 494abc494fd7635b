#include "materials/path.hpp"

namespace curvewise::materials {

std::vector<MaterialParameter> modulus_parameters(Modulus modulus) {
    std::vector<MaterialParameter> parameters{{"E", "stress", "Young's modulus at the start"}};
    if (modulus == Modulus::decaying) {
        parameters.push_back({"Ea", "stress", "its limit after large plastic strain"});
        parameters.push_back({"xi", "-", "rate of its decay with the plastic strain"});
    }
    return parameters;
}

void check_modulus(const Parameters& parameters, Modulus modulus) {
    parameters.above_zero(0);
    if (modulus == Modulus::constant) return;
    parameters.above_zero(1);
    parameters.at_least_zero(2);
}

void check_strains(const double* strain, std::ptrdiff_t n) {
    constexpr double largest = 100.0;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        if (std::abs(strain[i]) <= largest) continue;
        const std::string what = "strain[" + std::to_string(i) + "] is " + text_of(strain[i]);
        if (!std::isfinite(strain[i])) {
            throw std::invalid_argument(what + "; strains must be finite");
        }
        throw std::invalid_argument(what + "; give strains, 0.01 for 1 %, of at most 100");
    }
}

void refuse_stress(std::ptrdiff_t i, double stress) {
    throw std::invalid_argument("with these parameters the stress at strain[" + std::to_string(i) +
                                "] is " + text_of(stress) +
                                "; give values nearer to those of a metal");
}

}  // namespace curvewise::materials
