// The flow of the Yoshida-Uemori point in one direction, all quantities taken times its sign, with
// p the plastic strain since it began:
//
//     stress                          s = Y + t + c
//     bounding surface's centre       dc = K (SB - c) dp, closed in p
//     its size over the yield         a = CB + R - Y; R grows from where c leaves the stagnation
//     surface's                       surface, which is closed in p as well
//     yield surface's centre to c's   dt = C (a - sign(t) sqrt(a |t|)) dp
//
// The last has no closed form, and a root in it. With t = a u |u| and the time T in which
// dp = |u| dT / C, it is smooth where u keeps its sign, and a Taylor series (flow_series.hpp). A
// leg goes along one series: to u = 0, to where R begins to grow, to the strain wanted, or as far
// as the terms left out are below rtol. The time of an event is found by Newton's method in double
// precision; for that time the series gives u and p with their slopes, by the few numbers that the
// flow begins with, of which those by the parameters follow; and what is left to the event, next to
// nothing, moves them along the flow. O(1) a leg; a step of a metal takes one or two.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <type_traits>
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
    // What the flow goes on with from u and p.
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
    static Number height(const Number& u, const Bound& bound) {
        return bound.size * u * (value_of(u) < 0.0 ? -u : u) + bound.centre;
    }
    // The strain by what the stress has risen by: of a constant modulus.
    Number strain(const Number& u, const Number& p, const Bound& bound) const {
        return p + (height(u, bound) - begin) / k.modulus.initial;
    }
    FlowState<double> rates(double u, double p, const typename Branch<double>::Bound& bound) const {
        const double speed = std::abs(u) * unit, left = 1.0 - u;
        const double steepness = k.C * left * bound.size + bound.centre_slope;
        return {0.5 * (left - bound.R_slope / bound.size * u * speed), speed,
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

// A part of the flow along one series: up to a share of its length in T.
struct Leg {
    enum Event { none, at_rest, at_contact, at_target };  // u = 0; R begins to grow; the strain

    FlowKind kind;
    double length, share;
    Event event;
};

// The share in (0, high] at which what rises is 0, nearly: Newton's next iterate is it to rounding.
// `never` where it is below 0 at the end. excess(share) is its value and its slope.
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
        if (low == high && !is_enclosed) {  // rounding decides on a root at the end, of which
                                            // nothing would be left
            return next - high <= 1e-10 * high ? next : never;
        }
        if (std::abs(next - at) <= 1e-6 * at && (is_enclosed || next <= high)) return next;
        at = next > low && next < high ? next : is_enclosed ? 0.5 * (low + high) : high;
    }
    return at;
}

// Follows a course to its target, leg by leg.
template <class Number>
class Follower {
   public:
    // The series, kept from one flow to the next for their room.
    struct Series {
        FlowSeries<double> plain;
        FlowSeries<typename ForSlopes<Number>::Few> few;  // of a constant modulus
        FlowSeries<Number> full;                          // of one that decays
    };

    // `plain` is the same without slopes, or the same.
    Follower(Course<Number>& course, Course<double>& plain, Series& series)
        : course_(course), plain_(plain), series_(series) {}

    void run() {
        constexpr int most_legs = 10000;  // a metal's steps take one or two
        for (int i = 0; i < most_legs && std::isfinite(plain_.state.strain); ++i) {
            const Leg leg = next_leg();
            if constexpr (std::is_same_v<Number, double>) {
                go(leg, series_.plain);
            } else {
                leg.kind.softens ? go(leg, series_.full) : go(leg, series_.few);
            }
            if (leg.event == Leg::at_target && std::isfinite(plain_.state.strain)) return;
        }
        throw std::invalid_argument(
            "with these parameters the Yoshida-Uemori equations are too steep to integrate; "
            "give values nearer to those of a metal");
    }

   private:
    Leg next_leg() {
        const Course<double>& c = plain_;
        const double u = c.state.u;
        const FlowStart<double> start = c.branch.start(u, c.state.p, c.bound, c.unit);
        const FlowKind kind{u < 0.0 ? -1.0 : 1.0, c.branch.is_growing(),
                            c.k.growth == BoundGrowth::power, !c.k.modulus.is_constant};
        compliance_ = c.bound.size / c.branch.modulus(c.state.p);
        const double guess = time_to_target(kind.sign);
        double length = 6.0 / (1.0 + start[GROWTH] + std::abs(start[BASE]) + start[LEFT] +
                               start[DECAY] + start[SOFTENING]);  // terms fall
        // To u = 0 it takes 2 log(1 - u) at most, of which a Pade approximant is a bound.
        if (u < 0.0) length = std::min(length, -2.0 * u * (6.0 - u) / (6.0 - 4.0 * u));
        length = std::min(length, 1.2 * guess);
        series_.plain.begin(start, kind, length);
        // What is left out of hundreds of steps adds up, and what a parameter hardly moves has
        // slopes with the larger errors.
        const double share = series_.plain.extend_to(1e-3 * c.k.rtol);
        return with_event({kind, length, share, Leg::none}, guess / length);
    }
    // Nearly: by the strain's first two derivatives.
    double time_to_target(double sign) const {
        const Course<double>& c = plain_;
        const FlowState<double> rates = c.rates();
        const double left = c.target - c.state.strain, u = c.state.u;
        const double by_p = u == 0.0 ? 1.0 + c.k.C * compliance_ : rates.strain / rates.p;
        const double second = rates.u * (sign * by_p * c.unit - std::abs(u) * compliance_);
        const double square = rates.strain * rates.strain + 2.0 * left * second;
        return 2.0 * left / (rates.strain + std::sqrt(std::max(0.0, square)));
    }
    // The same leg or, where an event comes first, up to there.
    Leg with_event(Leg leg, double guess) const {
        using State = FlowState<double>;
        const Course<double>& c = plain_;
        const auto shorten = [&](Leg::Event event, double State::*component, double aim,
                                 double begin) {
            const double found = root_of(
                [&](double share) {
                    const auto [u, rise, stress] = series_.plain.at(share);
                    const double p = c.state.p + rise * c.unit;
                    const auto bound = c.branch.bound(p);
                    const double strain =
                        leg.kind.softens ? c.state.strain + rise * c.unit + compliance_ * stress
                                         : c.strain(u, p, bound);
                    return std::pair{State{u, p, strain}.*component - aim,
                                     leg.length * (c.rates(u, p, bound).*component)};
                },
                begin, leg.share);
            if (found != never) leg.share = found, leg.event = event;
        };
        if (c.state.u < 0.0 || !leg.kind.grows) {
            const auto end = series_.plain.at(leg.share);
            if (c.state.u < 0.0 && end.u >= 0.0) {
                shorten(Leg::at_rest, &State::u, 0.0, leg.share);
            }
            if (!leg.kind.grows && c.state.p + end.p * c.unit >= c.branch.contact()) {
                shorten(Leg::at_contact, &State::p, c.branch.contact(), 0.5 * leg.share);
            }
        }
        shorten(Leg::at_target, &State::strain, c.target, guess);
        return leg;
    }
    // Moves both courses along a leg. The series is that of the leg, or one with slopes to be made.
    template <class SeriesNumber>
    void go(const Leg& leg, FlowSeries<SeriesNumber>& series) {
        Course<Number>& c = course_;
        const FlowStart<Number> start = c.branch.start(c.state.u, c.state.p, c.bound, c.unit);
        if constexpr (!std::is_same_v<Number, double>) {
            series.begin(seeded<SeriesNumber>(start), leg.kind, leg.length);
            while (series.order() < series_.plain.order()) series.extend();
            if constexpr (has_slopes<Number>) series.extend_slopes_to(1e-2 * plain_.k.rtol);
        }
        auto sum = series.at(leg.share);
        if constexpr (has_slopes<Number>) {  // the values have the bits of those alone
            const auto values = series_.plain.at(leg.share);
            sum.u.value = values.u, sum.p.value = values.p, sum.rise.value = values.rise;
        }
        const Number rise = chained(sum.p, start) * c.unit;
        if (leg.kind.softens) {
            c.state.strain +=
                rise + c.bound.size / c.branch.modulus(c.state.p) * chained(sum.rise, start);
        }
        c.state.u = chained(sum.u, start);
        c.state.p += rise;
        c.bound = c.branch.bound(c.state.p);
        if (!leg.kind.softens) c.state.strain = c.strain(c.state.u, c.state.p, c.bound);
        copy_to_plain();
        if (leg.event == Leg::none) return;
        settle(leg.event);
        if (leg.event == Leg::at_contact) {
            c.branch.begin_growth();
            if constexpr (!std::is_same_v<Number, double>) plain_.branch.begin_growth();
            c.bound = c.branch.bound(c.state.p);
        }
        copy_to_plain();
    }
    // Moves the state along the flow by the little that it differs from the event in value, and by
    // what it does so in slopes.
    void settle(Leg::Event event) {
        Course<Number>& c = course_;
        FlowState<Number>& state = c.state;
        const FlowState<double> rates = plain_.rates();
        const Number time = event == Leg::at_rest      ? -state.u / rates.u
                            : event == Leg::at_contact ? (c.branch.contact() - state.p) / rates.p
                                                       : (c.target - state.strain) / rates.strain;
        c.bound = c.branch.moved(c.bound, state.p, rates.p * time);
        state.u = event == Leg::at_rest ? Number(0.0) : state.u + rates.u * time;
        state.p = event == Leg::at_contact ? c.branch.contact() : state.p + rates.p * time;
        state.strain += rates.strain * time;
    }
    void copy_to_plain() {
        if constexpr (std::is_same_v<Number, double>) return;
        const auto& [u, p, strain] = course_.state;
        plain_.state = {value_of(u), value_of(p), value_of(strain)};
        const auto& [centre, centre_slope, R, R_slope, size] = course_.bound;
        plain_.bound = {value_of(centre), value_of(centre_slope), value_of(R), value_of(R_slope),
                        value_of(size)};
    }

    Course<Number>& course_;
    Course<double>& plain_;
    Series& series_;
    double compliance_ = 0.0;  // that of the leg's begin, times the size
};

}  // namespace curvewise::materials
