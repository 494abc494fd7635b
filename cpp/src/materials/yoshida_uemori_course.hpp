// The parameters of the Yoshida-Uemori point by name, the closed forms of its flow in one
// direction, and the progress of that flow (yoshida_uemori_flow.hpp has the equations).
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "curvewise/materials.hpp"
#include "materials/flow_series.hpp"
#include "materials/path.hpp"

namespace curvewise::materials {

constexpr double never = std::numeric_limits<double>::infinity();

// The parameters by name.
template <class Number>
struct Constants {
    Constants(const YoshidaUemori& material, const Number* all)
        : growth(material.growth), rtol(material.rtol), modulus(all, material.modulus) {
        const Number* const own = all + (modulus.is_constant ? 1 : 3);
        CB = own[0], Y = own[1], C = own[2], K = own[3], RSAT = own[4], SB = own[5], H = own[6];
        if (growth == BoundGrowth::power) C1 = own[7], C2 = own[8];
    }
    BoundGrowth growth;
    double rtol;
    YoungsModulus<Number> modulus;
    Number CB, Y, C, K, RSAT, SB, H, C1{}, C2{};
};

// The known values of one direction of flow: closed forms of the plastic strain p since it began.
template <class Number>
class Branch {
   public:
    // Where R is `R`, c is `centre`, the plastic strain p0, and R grows from p = `contact` on.
    Branch(const Constants<Number>& constants, const Number& R, const Number& centre,
           const Number& p0, const Number& contact)
        : k_(constants), R_(R), centre_left_(k_.SB - centre), p0_(p0), contact_(contact) {}

    void begin_growth() {
        is_growing_ = true;
        if (k_.growth == BoundGrowth::saturating) {
            R_left_ = (k_.RSAT - R_) * exp(k_.K * contact_);
        } else {
            R_ = R_ - k_.RSAT * pow(k_.C1 + p0_ + contact_, k_.C2);
        }
    }
    bool is_growing() const { return is_growing_; }
    const Number& contact() const { return contact_; }
    Number modulus(const Number& p) const { return k_.modulus.after(p0_ + p); }

    // The bounding surface's centre, R, and its size over the yield surface, with slopes by p.
    struct Bound {
        Number centre, centre_slope, R, R_slope, size;
    };
    Bound bound(const Number& p) const {
        const Number decay = exp(-(k_.K * p)), left = centre_left_ * decay;
        const auto with = [&](const Number& R, const Number& R_slope) {
            return Bound{k_.SB - left, k_.K * left, R, R_slope, k_.CB + R - k_.Y};
        };
        if (!is_growing_) return with(R_, Number(0.0));
        if (k_.growth == BoundGrowth::saturating) {
            const Number R_left = R_left_ * decay;
            return with(k_.RSAT - R_left, k_.K * R_left);
        }
        const Number base = k_.C1 + p0_ + p, power = k_.RSAT * pow(base, k_.C2);
        return with(R_ + power, k_.C2 * power / base);
    }
    // The same after a further plastic strain so small that it is linear in it.
    Bound moved(const Bound& from, const Number& p, const Number& by) const {
        Bound to = from;
        to.centre += from.centre_slope * by;
        to.centre_slope += -k_.K * from.centre_slope * by;
        if (!is_growing_) return to;
        to.R += from.R_slope * by;
        to.size += from.R_slope * by;
        to.R_slope += bend(p) * from.R_slope * by;
        return to;
    }
    // The initial values of the flow from u and p.
    FlowStart<Number> start(const Number& u, const Number& p, const Bound& bound,
                            const Number& unit) const {
        FlowStart<Number> found{};
        found[START] = u;
        if (is_growing_) {
            found[GROWTH] = unit * (bound.R_slope / bound.size);
            const bool is_power = k_.growth == BoundGrowth::power;
            found[BASE] = unit * (is_power ? 1.0 / (k_.C1 + p0_ + p) : -k_.K);
            found[EXPONENT] = is_power ? k_.C2 - 1.0 : Number(1.0);
        }
        if (!k_.modulus.is_constant) {
            found[LEFT] = unit * (bound.centre_slope / bound.size);
            found[DECAY] = unit * k_.K;
            found[SOFTENING] = unit * k_.modulus.rate;
            found[LIMIT] = k_.modulus.limit / modulus(p);
        }
        return found;
    }

   private:
    // R's second derivative over its first.
    Number bend(const Number& p) const {
        if (k_.growth == BoundGrowth::saturating) return -k_.K;
        return (k_.C2 - 1.0) / (k_.C1 + p0_ + p);
    }

    const Constants<Number>& k_;
    Number R_, centre_left_, p0_, contact_;
    Number R_left_{};
    bool is_growing_ = false;
};

// u, p, and the strain since the flow began; or their derivatives by T.
template <class Number>
struct FlowState {
    Number u, p, strain;
};

// The flow in one direction: how far it has come, and how far it is to go.
template <class Number>
struct Course {
    using Bound = typename Branch<Number>::Bound;

    Course(const Constants<Number>& constants, const Branch<Number>& along, const Number& u,
           const Number& aim)
        : k(constants),
          branch(along),
          unit(1.0 / constants.C),
          state{u, Number(0.0), Number(0.0)},
          target(aim) {
        if (value_of(branch.contact()) == 0.0) branch.begin_growth();
        bound = branch.bound(state.p);
        begin = height(u, bound);
    }
    // The stress without Y.
    static Number height(const Number& u, const Bound& at) {
        return at.size * u * (value_of(u) < 0.0 ? -u : u) + at.centre;
    }
    // The strain for the rise of the stress, with a constant modulus.
    Number strain(const Number& u, const Number& p, const Bound& at) const {
        return p + (height(u, at) - begin) / k.modulus.initial;
    }
    FlowState<double> rates(double u, double p, const typename Branch<double>::Bound& at) const {
        const double speed = std::abs(u) * unit, left = 1.0 - u;
        const double steepness = k.C * left * at.size + at.centre_slope;
        return {0.5 * (left - at.R_slope / at.size * u * speed), speed,
                speed * (1.0 + steepness / branch.modulus(p))};
    }
    FlowState<double> rates() const { return rates(state.u, state.p, bound); }

    const Constants<Number>& k;
    Branch<Number> branch;
    Number unit;  // of the plastic strain in a series
    FlowState<Number> state;
    Bound bound;  // at the state
    Number target, begin;
};

// The share in (0, high] at which a rising quantity is 0, nearly: Newton's next iterate is exact to
// rounding. `never` if the quantity is below 0 at the end. excess(share) gives its value and its
// derivative.
template <class Excess>
double root_of(Excess excess, double guess, double high) {
    double low = 0.0, at = std::min(guess, high);
    bool is_enclosed = false;
    constexpr int most_iterations = 100;  // 60 halvings would do
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const std::pair<double, double> found = excess(at);
        if (found.first >= 0.0) {
            high = at;
            is_enclosed = true;
        } else {
            low = at;
        }
        const double next = at - found.first / found.second;
        // rounding decides about a root at the end, which would leave nothing of the step
        if (low == high && !is_enclosed) {
            return next - high <= 1e-10 * high ? next : never;
        }
        if (std::abs(next - at) <= 1e-6 * at && (is_enclosed || next <= high)) return next;
        at = next > low && next < high ? next : is_enclosed ? 0.5 * (low + high) : high;
    }
    return at;
}

}  // namespace curvewise::materials
