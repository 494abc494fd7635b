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
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

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
    Number CB, Y, C, K, RSAT, SB, H, C1{}, C2{};
};

// What is known of one direction of flow: closed forms of the plastic strain p since it began.
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

    // The bounding surface's centre and R, with their derivatives.
    struct Bound {
        Number centre, centre_slope, R, R_slope;
    };
    Bound bound(const Number& p) const {
        const Number decay = exp(-(k_.K * p)), left = centre_left_ * decay;
        if (!is_growing_) return {k_.SB - left, k_.K * left, R_, Number(0.0)};
        if (k_.growth == BoundGrowth::saturating) {
            const Number R_left = R_left_ * decay;
            return {k_.SB - left, k_.K * left, k_.RSAT - R_left, k_.K * R_left};
        }
        const Number base = k_.C1 + p0_ + p, power = k_.RSAT * pow(base, k_.C2);
        return {k_.SB - left, k_.K * left, R_ + power, k_.C2 * power / base};
    }
    // The derivatives of the state by T, where u has the sign `sign`: continued smoothly beyond 0,
    // so that rounding cannot turn the slopes of |u| there.
    State<Number> rates(const State<Number>& state, double sign) const {
        const Number &u = state[U], &p = state[P];
        const Bound found = bound(p);
        const Number size = k_.CB + found.R - k_.Y, speed = sign * u, pull = k_.C * (1.0 - u);
        const Number steepness = pull * size + found.centre_slope;
        const Number u_rate =
            is_growing_ ? 0.5 * (pull - found.R_slope / size * (u * speed)) : 0.5 * pull;
        return {u_rate, speed, speed + speed * (steepness / k_.modulus.after(p0_ + p))};
    }

   private:
    const Constants<Number>& k_;
    Number R_, centre_left_, p0_, contact_;
    Number R_left_{};
    bool is_growing_ = false;
};

// One step of the integration, and what happens at its end: a component has a value there, and R
// may begin to grow.
struct Leg {
    static constexpr std::size_t T = 3;  // beside U, P and STRAIN
    static constexpr std::size_t nowhere = 4;

    std::size_t by;  // what the step goes along
    double length;
    std::size_t ends_at;
};

// The state and the branch that it goes along, one leg after another.
template <class Number>
class Walk {
   public:
    Walk(Branch<Number>& branch, const Number& u, const Number& target)
        : branch_(branch), state_{u, Number(0.0), Number(0.0)}, target_(target) {
        if (value_of(branch_.contact()) == 0.0) branch_.begin_growth();
    }
    const State<Number>& state() const { return state_; }
    const Branch<Number>& branch() const { return branch_; }

    State<Number> rates(const State<Number>& state, std::size_t by) const {
        State<Number> found = branch_.rates(state, sign(by));
        if (by == Leg::T) return found;
        const Number time = 1.0 / found[by];
        for (Number& rate : found) rate = rate * time;
        found[by] = Number(1.0);
        return found;
    }
    Step<Number, 3> step(std::size_t by, double length) const {
        return runge_kutta_step(state_, length,
                                [&](const auto& state) { return rates(state, by); });
    }
    // Goes along a leg, of which `end` is the step.
    void go(const Leg& leg, const State<Number>& end) {
        state_ = end;
        if (leg.ends_at != Leg::nowhere) settle(leg.ends_at, sign(leg.by));
        if (leg.ends_at == P) branch_.begin_growth();
    }

   private:
    static double sign(std::size_t by) { return by == U ? -1.0 : 1.0; }
    // Moves the state along the flow by the little that a component differs from its value: in the
    // value (by the midpoint rule, to the third power of the little) as in the slopes.
    void settle(std::size_t what, double sign) {
        const Number value = what == P ? branch_.contact() : what == U ? Number(0.0) : target_;
        const Number left = value - state_[what];
        const State<Number> rate = branch_.rates(state_, sign);
        const Number half = 0.5 * (left / rate[what]);
        State<Number> middle = state_;
        for (std::size_t c = 0; c < middle.size(); ++c) middle[c] += rate[c] * half;
        // The time by the middle's rate, too: a time that is wrong by the square of the little has
        // a derivative that is wrong by the little itself.
        const State<Number> rate_there = branch_.rates(middle, sign);
        const Number time = left / rate_there[what];
        for (std::size_t c = 0; c < state_.size(); ++c) state_[c] += rate_there[c] * time;
        state_[what] = value;
    }

    Branch<Number>& branch_;
    State<Number> state_;
    Number target_;
};

// Finds the legs from the yield point to a strain behind it.
class Integration {
   public:
    Integration(Branch<double>& branch, const Constants<double>& constants, double u, double target)
        : walk_(branch, u, target), constants_(constants), target_(target) {}

    // Appends them; returns the state at their end.
    State<double> run(std::vector<Leg>& legs) {
        double length = never;
        for (std::size_t last_by = Leg::T; last_strain() < target_; last_by = legs.back().by) {
            const double u = walk_.state()[U];
            const std::size_t by = u < 0.0 ? U : u < 0.5 ? Leg::T : STRAIN;
            if (by != last_by) length = never;
            const double left = by == U ? -u : by == STRAIN ? target_ - last_strain() : never;
            auto [end, taken] = accepted(by, std::min({length, left, longest(by)}));
            length = 2.0 * taken;
            Leg leg{by, taken, taken == left ? by : Leg::nowhere};
            const Branch<double>& branch = walk_.branch();
            if (!branch.is_growing() && end[P] > branch.contact()) {
                std::tie(leg, end) = landed(leg, end, P, branch.contact());
            }
            if (leg.ends_at != STRAIN && end[STRAIN] > target_) {
                std::tie(leg, end) = landed(leg, end, STRAIN, target_);
            }
            walk_.go(leg, end);
            legs.push_back(leg);
        }
        return walk_.state();
    }

   private:
    // A path has hundreds of steps, and what a parameter hardly moves has slopes with the larger
    // errors.
    static constexpr double share_of_a_step = 1e-3;

    // What a step may be at most, whatever its error: u rises by no more than 1/2 along T; and near
    // u = 1, where the value stands still and says nothing of the step, its slopes decay as
    // exp(-C p / 2), which the method follows up to some six of them only.
    double longest(std::size_t by) const {
        return by == U ? never : (by == Leg::T ? 1.0 : 8.0) / constants_.C;
    }
    double last_strain() const { return walk_.state()[STRAIN]; }
    Step<double, 3> step(std::size_t by, double length) {
        if (--steps_left_ < 0) {
            throw std::invalid_argument(
                "with these parameters the Yoshida-Uemori equations are too steep to integrate; "
                "give values nearer to those of a metal");
        }
        return walk_.step(by, length);
    }
    // A step of this length, or of a shorter one whose error is small enough.
    std::pair<State<double>, double> accepted(std::size_t by, double length) {
        const double in_strain = constants_.modulus.initial / constants_.CB;
        while (true) {
            const Step<double, 3> found = step(by, length);
            const double error = std::max({found.error[U], in_strain * found.error[P],
                                           in_strain * found.error[STRAIN]}) /
                                 (share_of_a_step * constants_.rtol);
            if (error <= 1.0) return {found.end, length};
            length *= std::max(0.2, 0.9 * std::pow(error, -1.0 / 8.0));  // nan: 0.2
        }
    }
    // The leg shortened to where a component has a value that it passes there.
    std::pair<Leg, State<double>> landed(const Leg& leg, State<double> end, std::size_t what,
                                         double aim) {
        const double begin = walk_.state()[what];
        double low = 0.0, high = leg.length;
        double at = leg.length * (aim - begin) / (end[what] - begin);
        constexpr int most_iterations = 60;
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            end = step(leg.by, at).end;
            const double excess = end[what] - aim;
            (excess > 0.0 ? high : low) = at;
            double next = at - excess / walk_.rates(end, leg.by)[what];
            if (!(next >= low && next <= high)) next = 0.5 * (low + high);
            // What is left is less than rounding where the flow is followed: Walk::go does.
            if (std::abs(next - at) <= 1e-6 * at) break;
            at = next;
        }
        return {{leg.by, at, what}, end};
    }

    Walk<double> walk_;
    const Constants<double>& constants_;
    double target_;
    int steps_left_ = 10000;  // a metal's take one to ten
};

template <class Number>
std::vector<double> values_of(const Number* numbers, std::size_t count) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = value_of(numbers[i]);
    return values;
}

template <class Number>
class YoshidaUemoriPoint {
   public:
    YoshidaUemoriPoint(const YoshidaUemori& material, const Number* parameters, std::size_t count)
        : k_(material, parameters), plain_(material, values_of(parameters, count).data()) {}

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
        const Number reached = contact(n, bound);
        Branch<double> plain(plain_, value_of(R_), n * value_of(centre_), value_of(p_),
                             value_of(reached));
        legs_.clear();
        const State<double> found =
            Integration(plain, plain_, n * value_of(u_), value_of(strain)).run(legs_);
        if constexpr (std::is_same_v<Number, double>) {
            return flowed(n, bound, found, plain);
        } else {
            Branch<Number> branch(k_, R_, n * centre_, p_, reached);
            Walk<Number> walk(branch, n * u_, strain);
            for (const Leg& leg : legs_) walk.go(leg, walk.step(leg.by, leg.length).end);
            return flowed(n, bound, walk.state(), branch);
        }
    }
    // The stress at the end of a branch, from which the next step begins.
    Number flowed(double n, const Number& bound, const State<Number>& end,
                  const Branch<Number>& branch) {
        const auto [centre, centre_slope, R, R_slope] = branch.bound(end[P]);
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
    Constants<double> plain_;
    std::vector<Leg> legs_;  // of the last step that flowed
    Number stress_{}, p_{}, R_{}, u_{}, centre_{};
    Number stagnation_size_{}, stagnation_centre_{};
    double touched_ = 0.0;  // the direction in which the stagnation surface was pushed last
};

}  // namespace curvewise::materials
