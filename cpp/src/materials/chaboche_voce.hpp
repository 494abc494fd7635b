// The Chaboche-Voce point, with one or several isotropic terms R in its sum. Plastic flow keeps its
// direction n; p is the plastic strain since it began. Then n s = yield + R + sum of n X_k, and
// each of the terms is closed in p: from its start it rises by amplitude (1 - exp(-rate p)) / rate.
// The strain behind the yield point is p plus the rise of the stress over Young's modulus:
//
//     strain(p) = p + integral of (n s)'(p) / E(p)
//
// A step solves strain(p) = the rest of the step. Halley's iterates are held between bounds that
// close in, and end to rounding. The derivatives are those of the implicit function. With a
// constant modulus, there is no integral to compute. O(back stresses) a step: about two
// exponentials a back stress, which the derivatives share.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "curvewise/materials.hpp"
#include "materials/law.hpp"
#include "materials/path.hpp"
#include "materials/quadrature.hpp"

namespace curvewise::materials {

// The place of the yield stress among the parameters; Q, b, C1, gamma1, C2, ... follow it.
inline std::size_t place_of_yield(Modulus modulus) { return modulus == Modulus::constant ? 1 : 3; }

// A term of isotropic hardening R, or n X of a back stress, while flow keeps its direction.
template <class Number>
struct Term {
    Number start, amplitude, rate;
};

template <class Number>
struct Flow {
    std::vector<Term<Number>> terms;
    YoungsModulus<Number> modulus;
    Number p0{};  // the plastic strain before it

    // The strain behind the yield point, where the modulus decays.
    Number strain(const Number& p) const {
        double largest_rate = modulus.largest_rate(value_of(modulus.after(p0)));
        for (const Term<Number>& term : terms) {
            largest_rate = std::max(largest_rate, value_of(term.rate));
        }
        return p + integral_of_decays(p, largest_rate, [this](const Number& s) {
                   Number steepness(0.0);
                   for (const Term<Number>& term : terms) {
                       steepness += term.amplitude * exp(-(term.rate * s));
                   }
                   return steepness / modulus.after(p0 + s);
               });
    }
};

// The strain behind the yield point, and its derivatives by p.
struct Behind {
    double strain, slope, bend;
};

// That of a flow, and to `falls` exp(-rate p) - 1 of each term.
inline Behind strain_of(const Flow<double>& flow, double p, std::vector<double>& falls) {
    double height = 0.0, steepness = 0.0, bend = 0.0;
    for (std::size_t k = 0; k < falls.size(); ++k) {
        const Term<double>& term = flow.terms[k];
        const double z = term.rate * p,
                     slope = term.amplitude * (1.0 + (falls[k] = std::expm1(-z)));
        height += term.amplitude * p * saturation(z, falls[k]);
        steepness += slope;
        bend -= term.rate * slope;
    }
    const YoungsModulus<double>& modulus = flow.modulus;
    const double E = modulus.after(flow.p0 + p);
    if (modulus.is_constant) return {p + height / E, 1.0 + steepness / E, bend / E};
    return {flow.strain(p), 1.0 + steepness / E,
            (bend + steepness * modulus.rate * (E - modulus.limit) / E) / E};
}

// The root of the flow's strain = target > 0, nearly: the next iterate is it to rounding. Isotropic
// terms alone can fall, by `fall` at most. `falls` are those of the root.
inline double plastic_strain(const Flow<double>& flow, double target, double fall,
                             std::vector<double>& falls) {
    const YoungsModulus<double>& modulus = flow.modulus;
    const double softest =
        modulus.is_constant ? modulus.initial : std::min(modulus.initial, modulus.limit);
    double low = 0.0, high = target + fall / softest;
    double slope = 0.0, bend = 0.0;
    for (const Term<double>& term : flow.terms) {
        slope += term.amplitude;
        bend -= term.rate * term.amplitude;
    }
    const double E = modulus.after(flow.p0), first = std::max(1.0, 1.0 + slope / E);
    const double square = first * first + 2.0 * target * bend / E;
    // Where R falls faster than E, the strain may rise, fall and rise again. From this guess on the
    // iterates come to the first root from below, or, beyond the maximum, to the last one.
    double p =
        square > 0.0 ? std::min(high, 2.0 * target / (first + std::sqrt(square))) : target / first;
    constexpr int most_iterations = 200;  // 60 halvings would do
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const Behind found = strain_of(flow, p, falls);
        const double excess = found.strain - target, newton = excess / found.slope;
        (excess > 0.0 ? high : low) = p;
        const double next =
            p - newton / std::max(0.5, 1.0 - 0.5 * newton * found.bend / found.slope);
        // The error of the next iterate is some multiple of the cube of this step. This test comes
        // before the test of the bounds, because the root itself may be one of them. Near an
        // extremum, Halley's step is short far from the root, and Newton's is not.
        const double step = next - p;
        const bool is_near =
            found.slope > 0.0 && std::abs(step) <= 1e-5 * p && std::abs(newton) <= 2e-5 * p;
        p = is_near || (found.slope > 0.0 && next > low && next < high) ? next : 0.5 * (low + high);
        if (!is_near) continue;
        for (std::size_t k = 0; k < falls.size(); ++k) {  // exp(-z) - 1, z small
            const double z = flow.terms[k].rate * step;
            falls[k] -= (1.0 + falls[k]) * z * (1.0 - 0.5 * z * (1.0 - z / 3.0));
        }
        break;
    }
    return p;
}

// The first terms, so many of them, are isotropic: behind the yield stress, the limit and the rate
// of each.
template <class Number, std::size_t isotropic>
class SaturatingPoint {
   public:
    SaturatingPoint(Modulus modulus, const Number* parameters, std::size_t count)
        : modulus_(parameters, modulus),
          constants_(parameters + place_of_yield(modulus), parameters + count),
          state_((constants_.size() - 1) / 2, Number(0.0)),
          flow_{std::vector<Term<Number>>(state_.size()), modulus_},
          plain_{std::vector<Term<double>>(state_.size()), modulus_.plain()},
          rises_(state_.size()),
          falls_(state_.size()) {}

    // The stress after a further increment of strain.
    template <class Increment>
    Number advance(const Increment& increment) {
        const Number slope = modulus_.after(p_), trial = stress_ + slope * increment;
        Number centre(0.0);
        for (std::size_t k = isotropic; k < state_.size(); ++k) centre += state_[k];
        const double n = value_of(trial) < value_of(centre) ? -1.0 : 1.0;
        Number excess = n * (trial - centre) - (constants_[0] + state_[0]);
        for (std::size_t k = 1; k < isotropic; ++k) excess -= state_[k];
        if (value_of(excess) <= 0.0) return stress_ = trial;
        return stress_ = flow(n, excess / slope);
    }

   private:
    // The stress after plastic flow in the direction n, by `strain` behind the yield point.
    Number flow(double n, const Number& strain) {
        flow_.p0 = p_;
        for (std::size_t k = 0; k < state_.size(); ++k) {
            const Number &limit_or_slope = constants_[2 * k + 1], &rate = constants_[2 * k + 2];
            // R tends to Q with the rate b, n X rises with the slope C.
            const bool is_isotropic = k < isotropic;
            const Number start = is_isotropic ? state_[k] : n * state_[k];
            const Number amplitude =
                is_isotropic ? rate * (limit_or_slope - start) : limit_or_slope - rate * start;
            flow_.terms[k] = {start, amplitude, rate};
            plain_.terms[k] = {value_of(start), value_of(amplitude), value_of(rate)};
        }
        plain_.p0 = value_of(p_);
        double fall = 0.0;
        for (std::size_t k = 0; k < isotropic; ++k) {
            fall += std::max(0.0, value_of(state_[k]) - value_of(constants_[2 * k + 1]));
        }
        const double p = plastic_strain(plain_, value_of(strain), fall, falls_);

        // The last step to the root, whose derivatives are those of the implicit function. The step
        // moves p so little that the rest is linear in it.
        Number risen(0.0);
        double steepness = 0.0;
        for (std::size_t k = 0; k < state_.size(); ++k) {
            const Term<Number>& term = flow_.terms[k];
            rises_[k] = term.amplitude * p * saturation(term.rate * p, falls_[k]);
            risen += rises_[k];
            steepness += plain_.terms[k].amplitude * (1.0 + falls_[k]);
        }
        const Number reached =
            modulus_.is_constant ? p + risen / modulus_.initial : flow_.strain(Number(p));
        const Number rest =
            (strain - reached) / (1.0 + steepness / plain_.modulus.after(plain_.p0 + p));
        Number stress = constants_[0];
        for (std::size_t k = 0; k < state_.size(); ++k) {
            const Number after = flow_.terms[k].start + rises_[k] +
                                 plain_.terms[k].amplitude * (1.0 + falls_[k]) * rest;
            state_[k] = k < isotropic ? after : n * after;
            stress += after;
        }
        p_ += p + rest;
        return n * stress;
    }

    YoungsModulus<Number> modulus_;
    std::vector<Number> constants_;  // yield, Q, b, C1, gamma1, ...
    std::vector<Number> state_;      // R, X1, X2, ...
    Flow<Number> flow_;
    Flow<double> plain_;
    std::vector<Number> rises_;
    std::vector<double> falls_;  // exp(-rate p) - 1 of each term
    Number stress_{}, p_{};
};

template <class Number>
class ChabocheVocePoint : public SaturatingPoint<Number, 1> {
   public:
    ChabocheVocePoint(const ChabocheVoce& material, const Number* parameters, std::size_t count)
        : SaturatingPoint<Number, 1>(material.modulus, parameters, count) {}
};

template <>
struct Law<ChabocheVoce> {
    template <class Number>
    using Point = ChabocheVocePoint<Number>;
    static std::vector<MaterialParameter> parameters(const ChabocheVoce& material);
    static void check(const ChabocheVoce& material, const Parameters& given);
    static double largest_stress(const ChabocheVoce& material, const Parameters& checked,
                                 const StrainPath& path);
};

}  // namespace curvewise::materials
