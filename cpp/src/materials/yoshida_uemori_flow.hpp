// The flow of the Yoshida-Uemori point in one direction. All quantities are multiplied by its sign;
// p is the plastic strain since it began:
//
//     stress                          s = Y + t + c
//     bounding surface's centre       dc = K (SB - c) dp, closed in p
//     its size over the yield         a = CB + R - Y; R grows from where c leaves the stagnation
//     surface's                       surface, which is closed in p as well
//     yield surface's centre to c's   dt = C (a - sign(t) sqrt(a |t|)) dp
//
// The last equation has a root in it and cannot be solved in closed form. With t = a u |u| and the
// time T in which dp = |u| dT / C, it is smooth while u keeps its sign, and a Taylor series solves
// it (flow_series.hpp). A leg follows one series: to u = 0, to the start of R's growth, to the
// required strain, or as far as the omitted terms are below rtol.
//
// Newton's method finds the time of an event in double precision. At that time the series gives u
// and p with their derivatives by the few initial values; the derivatives by the parameters follow
// from these. The remaining distance to the event is negligible, and moves u and p along the flow.
// O(1) a leg; a step of a metal takes one or two.
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
#include "materials/yoshida_uemori_course.hpp"
#include "materials/yoshida_uemori_steady.hpp"

namespace curvewise::materials {

// A part of the flow along one series: up to a share of its length in T.
struct Leg {
    enum Event { none, at_rest, at_contact, at_target };  // u = 0; R begins to grow; the strain

    FlowKind kind;
    double length, share;
    Event event;
};

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
        constexpr int first_steady = 8;   // transients take eight legs to decay
        for (int i = 0; i < most_legs && std::isfinite(plain_.state.strain); ++i) {
            if (i >= first_steady) {
                const auto event = SteadyFlow<Number>(course_, plain_).follow();
                if (event == SteadyFlow<Number>::at_contact) begin_growth();
                if (event != SteadyFlow<Number>::none) copy_to_plain();
                if (event == SteadyFlow<Number>::at_target) return;
            }
            const Leg leg = next_leg();
            if (leg.length < -1e-6) break;  // rounding has turned the flow round
            if constexpr (std::is_same_v<Number, double>) {
                go(leg, series_.plain);
            } else {
                leg.kind.softens ? go(leg, series_.full) : go(leg, series_.few);
            }
            if (leg.event == Leg::at_target && std::isfinite(plain_.state.strain)) return;
        }
        throw NoStress{"the Yoshida-Uemori equations are too steep to integrate", "C"};
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
        // To u = 0 it takes at most 2 log(1 - u), and a Padé approximant is a bound of this time.
        if (u < 0.0) length = std::min(length, -2.0 * u * (6.0 - u) / (6.0 - 4.0 * u));
        length = std::min(length, 1.2 * guess);
        series_.plain.begin(start, kind, length);
        // Truncation errors of hundreds of steps add up, and they are largest in the derivatives by
        // parameters with little effect.
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
    // Moves both courses along a leg. The series is that of the leg, or a new one with derivatives.
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
        if (leg.event == Leg::at_contact) begin_growth();
        copy_to_plain();
    }
    void begin_growth() {
        course_.branch.begin_growth();
        if constexpr (!std::is_same_v<Number, double>) plain_.branch.begin_growth();
        course_.bound = course_.branch.bound(course_.state.p);
    }
    // Moves the state along the flow by its small remaining differences from the event, in value
    // and in derivatives.
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
    double compliance_ = 0.0;  // compliance at the leg's start, times the size
};

}  // namespace curvewise::materials
