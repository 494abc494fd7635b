// The Swift material: isotropic hardening by a power law of the plastic strain.
#include <cmath>
#include <cstddef>
#include <vector>

#include "materials/isotropic.hpp"

namespace curvewise::materials {
namespace {

template <class Number>
struct SwiftHardening {
    SwiftHardening(const Swift& /*material*/, const Number* parameters)
        : K(parameters[0]), e0(parameters[1]), n(parameters[2]) {}

    Number stress(const Number& p) const { return K * pow(e0 + p, n); }
    double slope(double p) const { return K * n * std::pow(e0 + p, n - 1.0); }

    Number K, e0, n;
};

}  // namespace

template <>
struct Law<Swift> {
    template <class Number>
    using Point = IsotropicPoint<Number, SwiftHardening>;
    static std::vector<MaterialParameter> parameters(const Swift& /*material*/) {
        return {{"E", "stress", "Young's modulus"},
                {"K", "stress", "yield stress where e0 and the plastic strain add up to 1"},
                {"e0", "-", "plastic strain before the test"},
                {"n", "-", "exponent of hardening"}};
    }
    static void check(const Swift& /*material*/, const Parameters& given) {
        for (std::size_t i = 0; i < 3; ++i) given.above_zero(i);
        given.at_least_zero(3);
        if (given[3] > 1.0) given.refuse(3, "it must be at most 1");
    }
    static double largest_stress(const Swift& /*material*/, const Parameters& checked,
                                 const StrainPath& path) {
        return with_rounding(checked[1] * std::pow(checked[2] + path.length(), checked[3]), 1e-9);
    }
};

template struct ByStrain<Swift>;
template struct ByStress<Swift>;

}  // namespace curvewise::materials
