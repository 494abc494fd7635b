// The Yoshida-Uemori point. In one direction of plastic flow, all quantities taken times its sign,
// with p the plastic strain since it began:
//
//     stress                          s = Y + t + c
//     bounding surface's centre       dc = K (SB - c) dp, closed in p
//     its size over the yield         a = CB + R - Y; R grows from where c leaves the stagnation
//     surface's                       surface, which is closed in p as well
//     yield surface's centre to c's   dt = C (a - sign(t) sqrt(a |t|)) dp
//
// The last has no closed form, and a root in it. With t = a u |u| and the time T in which
// dp = |u| dT, du/dT = C (1 - u) / 2 - a' u |u| / (2 a): smooth where u keeps its sign. So one
// system (u, p, strain) is integrated, by u up to u = 0, by T up to u = 1/2, and by the strain from
// there on, since that ends where a step ends; DOP853 with its error held below rtol. A step that
// passes the strain wanted, or the place where R begins to grow, is shortened to end there
// (Newton), and the derivative of that place by the parameters is given to the slopes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "curvewise/materials.hpp"
#include "materials/path.hpp"
#include "materials/runge_kutta.hpp"

namespace curvewise::materials {

constexpr double never = std::numeric_limits<double>::infinity();

// The components of the state that is integrated.
enum : std::size_t { U, P, STRAIN };
template <class Number>
using State = std::array<Number, 3>;

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
    Number CB, Y, C, K, RSAT, SB, H, C1, C2;
};

// What is known of one direction of flow: closed forms of the plastic strain p since it began.
template <class Number>
class Branch {
   public:
    // Where R is `R`, c is `centre`, the plastic strain p0, and R grows from p = `contact` on.
    Branch(const Constants<Number>& constants, const Number& R, const Number& centre,
           const Number& p0, const Number& contact)
        : k_(constants), R_(R), centre_(centre), p0_(p0), contact_(contact) {}

    void begin_growth() { is_growing_ = true; }
    bool is_growing() const { return is_growing_; }
    const Number& contact() const { return contact_; }

    Number centre(const Number& p) const { return k_.SB - (k_.SB - centre_) * exp(-(k_.K * p)); }
    // R, and its derivative.
    std::array<Number, 2> R(const Number& p) const {
        if (!is_growing_) return {R_, Number(0.0)};
        if (k_.growth == BoundGrowth::saturating) {
            const Number left = (k_.RSAT - R_) * exp(-(k_.K * (p - contact_)));
            return {k_.RSAT - left, k_.K * left};
        }
        const Number base = k_.C1 + p0_ + p, begun = k_.C1 + p0_ + contact_;
        const Number power = k_.RSAT * pow(base, k_.C2);
        return {R_ + power - k_.RSAT * pow(begun, k_.C2), k_.C2 * power / base};
    }
    // The derivatives of the state by T, where u has the sign `sign`: continued smoothly beyond 0,
    // so that rounding cannot turn the slopes of |u| there.
    State<Number> rates(const State<Number>& state, double sign) const {
        const Number &u = state[U], &p = state[P];
        const auto [R, R_slope] = this->R(p);
        const Number size = k_.CB + R - k_.Y;
        const Number speed = sign * u;
        const Number pull = k_.C * (1.0 - u);
        const Number steepness = pull * size + k_.K * (k_.SB - centre(p));
        return {0.5 * pull - 0.5 * (R_slope / size) * u * speed, speed,
                speed * (1.0 + steepness / k_.modulus.after(p0_ + p))};
    }

   private:
    const Constants<Number>& k_;
    Number R_, centre_, p0_, contact_;
    bool is_growing_ = false;
};

// Integrates one branch from the yield point to a strain behind it.
template <class Number>
class Integration {
   public:
    Integration(Branch<Number>& branch, const Constants<Number>& constants, const Number& u,
                const Number& target)
        : branch_(branch),
          constants_(constants),
          state_{u, Number(0.0), Number(0.0)},
          target_(target) {}

    State<Number> run() {
        if (value_of(branch_.contact()) == 0.0) branch_.begin_growth();
        double length = never;
        while (true) {
            const std::size_t last_by = by_;
            by_ = value_of(state_[U]) < 0.0 ? U : value_of(state_[U]) < 0.5 ? T : STRAIN;
            if (by_ != last_by) length = never;
            const double left = by_ == U ? -value_of(state_[U])
                                : by_ == T
                                    ? 1.0 / value_of(constants_.C)  // u rises by no more than 1/2
                                    : value_of(target_) - value_of(state_[STRAIN]);
            const auto [step, taken] = accepted(std::min(length, left));
            length = 2.0 * taken;
            const bool touches = !branch_.is_growing() && passes(step, P, branch_.contact());
            const State<Number> next = touches ? landed(taken, P, branch_.contact()) : step;
            if (by_ == STRAIN && taken == left && !touches) {
                return settled(next, STRAIN, target_);
            }
            if (passes(next, STRAIN, target_)) return landed(taken, STRAIN, target_);
            state_ = by_ == U && taken == left && !touches ? settled(next, U, Number(0.0)) : next;
            if (touches) branch_.begin_growth();
        }
    }

   private:
    static constexpr std::size_t T = 3;  // beside U, P and STRAIN
    // A path has hundreds of steps, and what a parameter hardly moves has slopes with the larger
    // errors.
    static constexpr double share_of_a_step = 1e-3;

    double sign() const { return by_ == U ? -1.0 : 1.0; }
    State<Number> rates(const State<Number>& state) const {
        State<Number> found = branch_.rates(state, sign());
        if (by_ == T) return found;
        const Number speed = found[by_];
        for (Number& rate : found) rate = rate / speed;
        found[by_] = Number(1.0);
        return found;
    }
    Step<Number, 3> step(double length) {
        if (--steps_left_ < 0) {
            throw std::invalid_argument(
                "with these parameters the Yoshida-Uemori equations are too steep to integrate; "
                "give values nearer to those of a metal");
        }
        return runge_kutta_step(state_, length, [this](const auto& state) { return rates(state); });
    }
    // A step of this length, or of a shorter one whose error is small enough.
    std::pair<State<Number>, double> accepted(double length) {
        const double E = value_of(constants_.modulus.initial), CB = value_of(constants_.CB);
        while (true) {
            const Step<Number, 3> found = step(length);
            const double error =
                std::max({found.error[U], E / CB * found.error[P], E / CB * found.error[STRAIN]}) /
                (share_of_a_step * constants_.rtol);
            if (error <= 1.0) return {found.end, length};
            length *= std::max(0.2, 0.9 * std::pow(error, -1.0 / 8.0));  // nan: 0.2
        }
    }
    static bool passes(const State<Number>& end, std::size_t what, const Number& value) {
        return value_of(end[what]) > value_of(value);
    }
    // The state less than `length` further, where a component has a value that it passes there.
    State<Number> landed(double length, std::size_t what, const Number& value) {
        const double aim = value_of(value), begin = value_of(state_[what]);
        double low = 0.0, high = length;
        double at = length * (aim - begin) / (value_of(step(length).end[what]) - begin);
        State<Number> end = state_;
        constexpr int most_iterations = 60;
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            end = step(at).end;
            const double excess = value_of(end[what]) - aim;
            (excess > 0.0 ? high : low) = at;
            double next = at - excess / value_of(rates(end)[what]);
            if (!(next >= low && next <= high)) next = 0.5 * (low + high);
            // What is left is less than rounding where the flow is followed: settled() does.
            if (std::abs(next - at) <= 1e-6 * at) break;
            at = next;
        }
        return settled(end, what, value);
    }
    // The state moved along the flow by the little that a component differs from its value: in the
    // value (by the midpoint rule, to the third power of the little) as in the slopes.
    State<Number> settled(State<Number> state, std::size_t what, const Number& value) const {
        const State<Number> rate = branch_.rates(state, sign());
        const Number time = (value - state[what]) / rate[what];
        State<Number> middle = state;
        for (std::size_t c = 0; c < state.size(); ++c) middle[c] += 0.5 * (rate[c] * time);
        const State<Number> rate_there = branch_.rates(middle, sign());
        for (std::size_t c = 0; c < state.size(); ++c) state[c] += rate_there[c] * time;
        state[what] = value;
        return state;
    }

    Branch<Number>& branch_;
    const Constants<Number>& constants_;
    State<Number> state_;
    Number target_;
    std::size_t by_ = T;      // what a step goes along
    int steps_left_ = 10000;  // a metal's take one to ten
};

template <class Number>
class YoshidaUemoriPoint {
   public:
    YoshidaUemoriPoint(const YoshidaUemori& material, const Number* parameters,
                       std::size_t /*count*/)
        : k_(material, parameters) {}

    // The stress after a further increment of strain.
    Number advance(double increment) {
        const Number slope = k_.modulus.after(p_), trial = stress_ + slope * increment;
        const Number size = k_.CB + R_ - k_.Y;
        const Number middle = size * u_ * (value_of(u_) < 0.0 ? -u_ : u_) + centre_;
        const double n = value_of(trial) < value_of(middle) ? -1.0 : 1.0;
        const Number excess = n * (trial - middle) - k_.Y;
        if (value_of(excess) <= 0.0) return stress_ = trial;
        return stress_ = flow(n, excess / slope);
    }

   private:
    // The stress after plastic flow in the direction n, by `strain` behind the yield point.
    Number flow(double n, const Number& strain) {
        const Number bound = stagnation_size_ + n * stagnation_centre_;
        Branch<Number> branch(k_, R_, n * centre_, p_, contact(n, bound));
        const State<Number> end = Integration<Number>(branch, k_, n * u_, strain).run();

        const Number centre = branch.centre(end[P]), R = branch.R(end[P])[0];
        touched_ = branch.is_growing() ? n : n == touched_ ? n : 0.0;
        if (branch.is_growing()) {
            // The stagnation surface is pushed along: H of the way it grows, the rest it moves.
            const Number pushed = centre - bound;
            stagnation_size_ += k_.H * pushed;
            stagnation_centre_ += n * (pushed - k_.H * pushed);
        }
        p_ += end[P];
        R_ = R;
        u_ = n * end[U];
        centre_ = n * centre;
        const Number size = k_.CB + R - k_.Y;
        return n * (k_.Y + size * end[U] * (value_of(end[U]) < 0.0 ? -end[U] : end[U]) + centre);
    }

    // The plastic strain after which the bounding surface's centre reaches `bound`, where the
    // stagnation surface ends.
    Number contact(double n, const Number& bound) const {
        if (touched_ == n) return Number(0.0);
        const Number left = k_.SB - bound;
        if (value_of(k_.K) == 0.0 || value_of(left) <= 0.0) return Number(never);
        const Number ratio = left / (k_.SB - n * centre_);
        return value_of(ratio) >= 1.0 ? Number(0.0) : -log(ratio) / k_.K;
    }

    Constants<Number> k_;
    Number stress_{}, p_{}, R_{}, u_{}, centre_{};
    Number stagnation_size_{}, stagnation_centre_{};
    double touched_ = 0.0;  // the direction in which the stagnation surface was pushed last
};

}  // namespace curvewise::materials
