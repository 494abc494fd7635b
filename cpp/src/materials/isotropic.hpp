// A point of isotropic hardening: |s| <= Y(p), with a yield stress that rises with the plastic
// strain p and is concave. A step that yields solves
//
//     p + (Y(p0 + p) - Y(p0)) / E = the strain behind the yield point
//
// whose left side rises and is concave: from below, Newton's iterates come to the root, and a
// bracket holds them. The derivatives are those of the implicit function. O(1) a step.
//
// Hardening<Number>(material, parameters behind E) has stress(p), the yield stress, and, for
// doubles, slope(p), its derivative by p, which may be infinite at 0.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "materials/law.inl.hpp"

namespace curvewise::materials {

template <class Number, template <class> class Hardening>
class IsotropicPoint {
   public:
    template <class Material>
    IsotropicPoint(const Material& material, const Number* parameters, std::size_t count)
        : E_(parameters[0]),
          law_(material, parameters + 1),
          plain_(plain(material, parameters, count)) {}

    // The stress after a further increment of strain.
    template <class Increment>
    Number advance(const Increment& increment) {
        const Number trial = stress_ + E_ * increment, limit = law_.stress(p_);
        const double direction = value_of(trial) < 0.0 ? -1.0 : 1.0;
        const Number excess = direction * trial - limit;
        if (value_of(excess) <= 0.0) return stress_ = trial;
        const Number strain = excess / E_;
        const double p = plastic_strain(value_of(strain), value_of(limit));
        // The last step to the root, whose derivatives are those of the implicit function.
        const Number reached = p + (law_.stress(p_ + p) - limit) / E_;
        p_ += p + (strain - reached) / slope(value_of(p_) + p);
        return stress_ = direction * law_.stress(p_);
    }

   private:
    template <class Material>
    static Hardening<double> plain(const Material& material, const Number* parameters,
                                   std::size_t count) {
        std::vector<double> values;
        for (std::size_t i = 1; i < count; ++i) values.push_back(value_of(parameters[i]));
        return {material, values.data()};
    }
    // That of the strain behind the yield point, by p.
    double slope(double p) const { return 1.0 + plain_.slope(p) / value_of(E_); }
    // The root, nearly: the next iterate is it to rounding.
    double plastic_strain(double target, double limit) const {
        const double E = value_of(E_), p0 = value_of(p_);
        double low = 0.0, high = target, p = target / slope(p0);
        if (!(p > 0.0)) p = target;
        constexpr int most_iterations = 250;  // from 1 to the least double by hundredths
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            const double excess = p + (plain_.stress(p0 + p) - limit) / E - target;
            (excess > 0.0 ? high : low) = p;
            const double next = p - excess / slope(p0 + p), step = next - p;
            const bool is_held = next > 0.0 && next >= low && next <= high;
            p = is_held ? next : low > 0.0 ? 0.5 * (low + high) : 0.01 * high;
            if (is_held && std::abs(step) <= 1e-9 * p) break;
        }
        return p;
    }

    Number E_;
    Hardening<Number> law_;
    Hardening<double> plain_;
    Number stress_{}, p_{};
};

}  // namespace curvewise::materials
