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

void check_strain(double strain, std::ptrdiff_t i) {
    if (std::abs(strain) <= most_strain) return;
    const std::string what = "strain[" + std::to_string(i) + "] is " + text_of(strain);
    if (!std::isfinite(strain)) throw std::invalid_argument(what + "; strains must be finite");
    throw std::invalid_argument(what + "; give strains, 0.01 for 1 %, of at most 100");
}

void check_strains(const double* strain, std::ptrdiff_t n) {
    for (std::ptrdiff_t i = 0; i < n; ++i) check_strain(strain[i], i);
}

void refuse_stress(std::ptrdiff_t i, double stress) {
    throw NoStress{"the stress at strain[" + std::to_string(i) + "] is " + text_of(stress) +
                       ", beyond what hardening leads to",
                   ""};
}

void check_given(const double* given, const bool* by_stress, std::ptrdiff_t n) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        if (!by_stress[i]) {
            check_strain(given[i], i);
        } else if (!std::isfinite(given[i])) {
            throw std::invalid_argument("stress[" + std::to_string(i) + "] is " +
                                        text_of(given[i]) + "; stresses must be finite");
        }
    }
}

void refuse_target(std::ptrdiff_t i, double target, double reached) {
    throw std::invalid_argument("the material does not reach stress[" + std::to_string(i) +
                                "] = " + text_of(target) +
                                " with these parameters; hardening ends at " + text_of(reached));
}

void check_slopes(const char* place, std::ptrdiff_t i, const double* slopes, std::size_t first,
                  std::size_t width, const Parameters& parameters) {
    for (std::size_t k = 0; k < width; ++k) {
        if (std::isfinite(slopes[k])) continue;
        throw NoStress{std::string("the slope of the ") + place + "[" + std::to_string(i) +
                           "] by " + parameters.name(first + k) + " is " + text_of(slopes[k]),
                       parameters.name(first + k)};
    }
}

void Parameters::refuse(const NoStress& found) const {
    const auto decades = [&](std::size_t i) {
        if (names_[i].name == found.parameter) return std::numeric_limits<double>::infinity();
        const double usual = names_[i].unit == "stress" ? 1e3 : 10.0;
        return values_[i] == 0.0 ? 0.0 : std::abs(std::log10(std::abs(values_[i]) / usual));
    };
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < count(); ++i) {
        if (decades(i) > decades(farthest)) farthest = i;
    }
    refuse(farthest,
           "with these parameters " + found.what + "; give values nearer to those of a metal");
}

}  // namespace curvewise::materials
