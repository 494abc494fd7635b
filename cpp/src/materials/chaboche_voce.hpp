// The Chaboche-Voce point. While plastic flow keeps its direction n, with p the plastic strain
// since it began, n s = yield + R + sum of n X_k, and each of the terms is closed in p: from its
// start it rises by amplitude (1 - exp(-rate p)) / rate. The strain behind the yield point is p
// plus what the stress has risen by, over Young's modulus:
//
//     strain(p) = p + integral of (n s)'(p) / E(p)
//
// A step is the root of strain(p) = what is left of the step. Newton's iterates, held between
// bounds that close in, end to rounding; the slopes are those of the implicit function. With a
// constant modulus there is no integral to compute. O(back stresses) a step.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "curvewise/materials.hpp"
#include "materials/path.hpp"
#include "materials/quadrature.hpp"

namespace curvewise::materials {

// The place of the yield stress among the parameters; Q, b, C1, gamma1, C2, ... follow it.
inline std::size_t place_of_yield(Modulus modulus) { return modulus == Modulus::constant ? 1 : 3; }

// R, or n X of a back stress, while flow keeps its direction.
template <class Number>
struct Term {
    Number start, amplitude, rate;

    Number rise(const Number& p) const { return amplitude * p * saturation(rate * p); }
    Number steepness(const Number& p) const { return amplitude * exp(-(rate * p)); }
};

template <class Number>
struct Flow {
    std::vector<Term<Number>> terms;
    YoungsModulus<Number> modulus;
    Number p0{};  // the plastic strain before it

    Number rise(const Number& p) const {
        Number sum(0.0);
        for (const Term<Number>& term : terms) sum += term.rise(p);
        return sum;
    }
    Number steepness(const Number& p) const {
        Number sum(0.0);
        for (const Term<Number>& term : terms) sum += term.steepness(p);
        return sum;
    }
    // The strain behind the yield point, and its derivative.
    Number strain(const Number& p) const {
        if (modulus.is_constant) return p + rise(p) / modulus.initial;
        double largest_rate = value_of(modulus.rate);
        for (const Term<Number>& term : terms) {
            largest_rate = std::max(largest_rate, value_of(term.rate));
        }
        return p + integral_of_decays(p, largest_rate, [this](const Number& s) {
                   return steepness(s) / modulus.after(p0 + s);
               });
    }
    Number slope(const Number& p) const { return 1.0 + steepness(p) / modulus.after(p0 + p); }
};

// The root of flow.strain(p) = target > 0. R alone can fall, by `fall` at most.
inline double plastic_strain(const Flow<double>& flow, double target, double fall) {
    const YoungsModulus<double>& modulus = flow.modulus;
    const double softest =
        modulus.is_constant ? modulus.initial : std::min(modulus.initial, modulus.limit);
    double low = 0.0, high = target + fall / softest;
    double p = target / std::max(1.0, flow.slope(0.0));
    constexpr int most_iterations = 200;  // 60 halvings would do
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const double excess = flow.strain(p) - target;
        (excess > 0.0 ? high : low) = p;
        const double slope = flow.slope(p);
        double next = p - excess / slope;
        if (!(slope > 0.0 && next > low && next < high)) next = 0.5 * (low + high);
        // Newton's next iterate is as good again as this one's step is short.
        const bool is_found = std::abs(next - p) <= 1e-9 * p;
        p = next;
        if (is_found) break;
    }
    return p;
}

template <class Number>
class ChabocheVocePoint {
   public:
    ChabocheVocePoint(const ChabocheVoce& material, const Number* parameters, std::size_t count)
        : modulus_(parameters, material.modulus),
          constants_(parameters + place_of_yield(material.modulus), parameters + count),
          state_((constants_.size() - 1) / 2, Number(0.0)),
          flow_{std::vector<Term<Number>>(state_.size()), modulus_},
          plain_{std::vector<Term<double>>(state_.size()), modulus_.plain()} {}

    // The stress after a further increment of strain.
    Number advance(double increment) {
        const Number slope = modulus_.after(p_), trial = stress_ + slope * increment;
        Number centre(0.0);
        for (std::size_t k = 1; k < state_.size(); ++k) centre += state_[k];
        const double n = value_of(trial) < value_of(centre) ? -1.0 : 1.0;
        const Number excess = n * (trial - centre) - (constants_[0] + state_[0]);
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
            const Number start = k == 0 ? state_[0] : n * state_[k];
            const Number amplitude =
                k == 0 ? rate * (limit_or_slope - start) : limit_or_slope - rate * start;
            flow_.terms[k] = {start, amplitude, rate};
            plain_.terms[k] = {value_of(start), value_of(amplitude), value_of(rate)};
        }
        plain_.p0 = value_of(p_);
        const double fall = std::max(0.0, value_of(state_[0]) - value_of(constants_[1]));
        Number p = plastic_strain(plain_, value_of(strain), fall);
        p += (strain - flow_.strain(p)) / plain_.slope(value_of(p));

        Number stress = constants_[0];
        for (std::size_t k = 0; k < state_.size(); ++k) {
            const Number after = flow_.terms[k].start + flow_.terms[k].rise(p);
            state_[k] = k == 0 ? after : n * after;
            stress += after;
        }
        p_ += p;
        return n * stress;
    }

    YoungsModulus<Number> modulus_;
    std::vector<Number> constants_;  // yield, Q, b, C1, gamma1, ...
    std::vector<Number> state_;      // R, X1, X2, ...
    Flow<Number> flow_;
    Flow<double> plain_;
    Number stress_{}, p_{};
};

}  // namespace curvewise::materials
