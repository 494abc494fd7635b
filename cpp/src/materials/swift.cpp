// The Swift material: isotropic hardening by a power law of the plastic strain p,
//
//     |s| <= Y(p) = K (e0 + p)^n
//
// A step that yields solves p + (Y(p0 + p) - Y(p0)) / E = the strain behind the yield point. The
// left side rises and is concave, so that Newton's iterates come to the root from below; a bracket
// holds them. The derivatives are those of the implicit function. O(1) a step.
#include <cmath>
#include <cstddef>
#include <vector>

#include "materials/law.inl.hpp"

namespace curvewise::materials {
namespace {

template <class Number>
class SwiftPoint {
   public:
    SwiftPoint(const Swift& /*material*/, const Number* parameters, std::size_t /*count*/)
        : E_(parameters[0]), K_(parameters[1]), e0_(parameters[2]), n_(parameters[3]) {}

    // The stress after a further increment of strain.
    template <class Increment>
    Number advance(const Increment& increment) {
        const Number trial = stress_ + E_ * increment, limit = yield_stress(p_);
        const double direction = value_of(trial) < 0.0 ? -1.0 : 1.0;
        const Number excess = direction * trial - limit;
        if (value_of(excess) <= 0.0) return stress_ = trial;
        const Number strain = excess / E_;
        const double p = plastic_strain(value_of(strain), value_of(limit));
        // The last step to the root, whose derivatives are those of the implicit function.
        const Number reached = p + (yield_stress(p_ + p) - limit) / E_;
        p_ += p + (strain - reached) / slope(value_of(p_) + p);
        return stress_ = direction * yield_stress(p_);
    }

   private:
    Number yield_stress(const Number& p) const { return K_ * pow(e0_ + p, n_); }
    // That of the strain behind the yield point, by p.
    double slope(double p) const {
        const double n = value_of(n_);
        return 1.0 + value_of(K_) * n * std::pow(value_of(e0_) + p, n - 1.0) / value_of(E_);
    }
    // The root, nearly: the next iterate is it to rounding.
    double plastic_strain(double target, double limit) const {
        const double E = value_of(E_), p0 = value_of(p_);
        double low = 0.0, high = target, p = target / slope(p0);
        constexpr int most_iterations = 100;
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            const double there = value_of(K_) * std::pow(value_of(e0_) + p0 + p, value_of(n_));
            const double excess = p + (there - limit) / E - target;
            (excess > 0.0 ? high : low) = p;
            const double next = p - excess / slope(p0 + p), step = next - p;
            p = next >= low && next <= high ? next : 0.5 * (low + high);
            if (std::abs(step) <= 1e-9 * p) break;
        }
        return p;
    }

    Number E_, K_, e0_, n_;
    Number stress_{}, p_{};
};

}  // namespace

template <>
struct Law<Swift> {
    template <class Number>
    using Point = SwiftPoint<Number>;
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
