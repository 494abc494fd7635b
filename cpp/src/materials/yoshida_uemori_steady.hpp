// The steady flow of the Yoshida-Uemori point at large C. One solution for u changes with the
// plastic strain alone. The difference of u from that solution decays as exp(-T / 2). With growth G
// = a' / (C a) and bend B = a'' / (C a'), both small, the solution is
//
//     u = 1 - G (1 - 2 B) + O(G (G + |B|)^2)
//
// So the stress is a closed form of p, and a step of any number of legs is one equation for p. With
// a modulus that decays, the strain has an integral, by parts: p plus the stress over the modulus,
// at the end less at the start, plus the integral of the stress by (-1 / E)'. O(1) a step.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "materials/path.hpp"
#include "materials/quadrature.hpp"
#include "materials/yoshida_uemori_course.hpp"

namespace curvewise::materials {

template <class Number>
class SteadyFlow {
   public:
    enum Event { none, at_contact, at_target };

    // `plain` is the same without slopes, or the same.
    SteadyFlow(Course<Number>& course, Course<double>& plain) : course_(course), plain_(plain) {}

    // Moves the course to its target or to where R begins to grow; or nowhere, where legs do: the
    // flow is not steady, or not far from its end.
    Event follow() {
        const Course<double>& c = plain_;
        const double left = c.target - c.state.strain;
        if (!is_steady() || !is_far(left)) return none;
        const double contact = c.branch.is_growing() ? never : c.branch.contact() - c.state.p;
        if (contact <= left && strain_at(c, c.state.p + contact) < c.target) {
            move_to(course_.branch.contact(), strain_at(course_, course_.branch.contact()));
            return at_contact;
        }
        const double p =
            c.state.p + root_of(
                            [&](double rise) {
                                const double at = c.state.p + rise;
                                return std::pair{strain_at(c, at) - c.target, steepness_at(at)};
                            },
                            left / steepness_at(c.state.p), left);
        if (!is_slow(growth_at(c, c.branch.bound(p), p))) return none;
        const Number fixed(p);
        const Number rest = (course_.target - strain_at(course_, fixed)) / steepness_at(p);
        move_to(fixed + rest, course_.target);
        return at_target;
    }

   private:
    template <class Any>
    struct Growth {
        Any growth, bend;  // G and B

        Any u() const { return 1.0 - growth * (1.0 - 2.0 * bend); }
    };

    template <class Any>
    static Growth<Any> growth_at(const Course<Any>& c, const typename Branch<Any>::Bound& bound,
                                 const Any& p) {
        const FlowStart<Any> start = c.branch.start(c.state.u, p, bound, c.unit);
        return {start[GROWTH], start[BASE] * start[EXPONENT]};
    }
    bool is_slow(const Growth<double>& found) const {
        const double sum = found.growth + std::abs(found.bend);
        return sum <= 0.05 && found.growth * sum * sum <= 1e-3 * plain_.k.rtol;
    }
    bool is_steady() const {
        constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
        const Course<double>& c = plain_;
        const Growth<double> found = growth_at(c, c.bound, c.state.p);
        return is_slow(found) &&
               std::abs(c.state.u - found.u()) <= std::max(1e-3 * c.k.rtol, rounding);
    }
    // Whether the flow would take more legs than the maximum, or legs that rounding spoils: the
    // rate of the stress is the product of C and the remainder of 1 - u.
    bool is_far(double left) const {
        const Course<double>& c = plain_;
        const double most_time = 6e4, largest_rate = 1e9;
        return c.k.C * left > most_time * steepness_at(c.state.p) ||
               c.k.C * c.bound.size > largest_rate * c.branch.modulus(c.state.p);
    }
    // The strain since the flow began.
    template <class Any>
    Any strain_at(const Course<Any>& c, const Any& p) const {
        const auto bound = c.branch.bound(p);
        const Any height = c.height(growth_at(c, bound, p).u(), bound);
        if (c.k.modulus.is_constant) return p + (height - c.begin) / c.k.modulus.initial;
        const Any &from = c.state.p, rise = p - from, E = c.branch.modulus(from);
        const FlowStart<Any> start = c.branch.start(c.state.u, from, c.bound, c.unit);
        const double largest_rate =
            std::max({c.k.modulus.largest_rate(value_of(E)), value_of(c.k.K),
                      std::abs(value_of(start[BASE])) * value_of(c.k.C)});
        const auto by_modulus = [&](const Any& s) {
            const auto there = c.branch.bound(from + s);
            const Any modulus = c.branch.modulus(from + s);
            return c.height(growth_at(c, there, from + s).u(), there) * c.k.modulus.rate *
                   (modulus - c.k.modulus.limit) / (modulus * modulus);
        };
        return c.state.strain + rise + height / c.branch.modulus(p) -
               c.height(c.state.u, c.bound) / E -
               integral_of_decays(rise, largest_rate, by_modulus);
    }
    // Its derivative.
    double steepness_at(double p) const {
        const Course<double>& c = plain_;
        const auto bound = c.branch.bound(p);
        const auto [growth, bend] = growth_at(c, bound, p);
        const double u = 1.0 - growth, by_p = -growth * (bend - growth) * c.k.C;
        return 1.0 + (bound.R_slope * u * u + 2.0 * bound.size * u * by_p + bound.centre_slope) /
                         c.branch.modulus(p);
    }
    void move_to(const Number& p, const Number& strain) {
        course_.bound = course_.branch.bound(p);
        course_.state = {growth_at(course_, course_.bound, p).u(), p, strain};
    }

    Course<Number>& course_;
    Course<double>& plain_;
};

}  // namespace curvewise::materials
