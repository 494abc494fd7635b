// The Johnson-Cook material at one rate of strain and one temperature: isotropic hardening with the
// yield stress (A + B p^n) (1 + C ln(rate / reference_rate)).
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "materials/isotropic.hpp"

namespace curvewise::materials {
namespace {

double log_of_rates(const JohnsonCook& material) {
    return std::log(material.rate / material.reference_rate);
}

template <class Number>
struct JohnsonCookHardening {
    JohnsonCookHardening(const JohnsonCook& material, const Number* parameters)
        : A(parameters[0]),
          B(parameters[1]),
          n(parameters[2]),
          factor(1.0 + parameters[3] * log_of_rates(material)) {}

    // Before plastic strain, B and n do not matter: p^n has no derivative there.
    Number stress(const Number& p) const {
        return value_of(p) > 0.0 ? factor * (A + B * pow(p, n)) : factor * A;
    }
    double slope(double p) const { return factor * B * n * std::pow(p, n - 1.0); }

    Number A, B, n, factor;
};

}  // namespace

template <>
struct Law<JohnsonCook> {
    template <class Number>
    using Point = IsotropicPoint<Number, JohnsonCookHardening>;
    static std::vector<MaterialParameter> parameters(const JohnsonCook& material) {
        for (const double rate : {material.rate, material.reference_rate}) {
            if (rate > 0.0 && std::isfinite(rate)) continue;
            throw std::invalid_argument("a rate of strain is " + text_of(rate) +
                                        "; give a positive number");
        }
        return {{"E", "stress", "Young's modulus"},
                {"A", "stress", "initial yield stress at the reference rate"},
                {"B", "stress", "factor of hardening"},
                {"n", "-", "exponent of hardening"},
                {"C", "-", "sensitivity to the rate of strain"}};
    }
    static void check(const JohnsonCook& material, const Parameters& given) {
        given.above_zero(0);
        given.above_zero(1);
        given.at_least_zero(2);
        given.at_least_zero(4);
        // The first plastic strains of a lower exponent are below all doubles.
        constexpr double least_exponent = 0.05;
        if (!(given[3] >= least_exponent && given[3] <= 1.0)) {
            given.refuse(3, "give a number from 0.05 to 1");
        }
        if (!(1.0 + given[4] * log_of_rates(material) > 0.0)) {
            given.refuse(4, "at a rate of " + text_of(material.rate) + ", nothing is left of the " +
                                "yield stress; give less");
        }
    }
    static double largest_stress(const JohnsonCook& material, const Parameters& checked,
                                 const StrainPath& path) {
        const double factor = 1.0 + checked[4] * log_of_rates(material);
        const double grown = checked[1] + checked[2] * std::pow(path.length(), checked[3]);
        return with_rounding(factor * grown, 1e-9);
    }
};

template struct ByStrain<JohnsonCook>;
template struct ByStress<JohnsonCook>;

}  // namespace curvewise::materials
