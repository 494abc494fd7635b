// Material points in textbook form: rate equations, integrated by small steps of the classical
// Runge-Kutta method in the strain. Shares no code with the library. A step that begins elastic is
// cut at the yield point. Near the root in the Yoshida-Uemori equation, steps shrink with the
// distance from it. If the bounding surface's centre leaves the stagnation surface in a step,
// bisection cuts the step there. With 10^5 increments along a loop, the error is about 1e-9 of the
// stress.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "curvewise/materials.hpp"

namespace textbook {

// E after the plastic strain p; the first one or three parameters.
struct Modulus {
    double E, Ea, xi;
    Modulus(const double* parameters, curvewise::Modulus kind)
        : E(parameters[0]),
          Ea(kind == curvewise::Modulus::constant ? E : parameters[1]),
          xi(kind == curvewise::Modulus::constant ? 0.0 : parameters[2]) {}
    double after(double p) const { return E - (E - Ea) * (1.0 - std::exp(-xi * p)); }
};

using State = std::vector<double>;

inline State moved(const State& state, const State& rate, double length) {
    State result = state;
    for (std::size_t i = 0; i < state.size(); ++i) result[i] += length * rate[i];
    return result;
}

template <class Rates>
State runge_kutta_4(const State& y, double h, Rates rates) {
    const State a = rates(y), b = rates(moved(y, a, h / 2)), c = rates(moved(y, b, h / 2)),
                d = rates(moved(y, c, h));
    State result = y;
    for (std::size_t i = 0; i < y.size(); ++i) {
        result[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }
    return result;
}

// State: plastic strain p, R, X1, X2, ...
class ChabocheVoce {
   public:
    ChabocheVoce(const curvewise::ChabocheVoce& material, const double* parameters)
        : modulus(parameters, material.modulus),
          own_(parameters + (material.modulus == curvewise::Modulus::constant ? 1 : 3)),
          state(static_cast<std::size_t>(2 + material.backstresses), 0.0) {}

    double centre() const {
        double sum = 0.0;
        for (std::size_t k = 2; k < state.size(); ++k) sum += state[k];
        return sum;
    }
    double radius() const { return own_[0] + state[1]; }
    // The derivatives by strain in the direction n of flow.
    State rates(const State& y, double n) const {
        State by_p(y.size());
        by_p[0] = 1.0;
        by_p[1] = own_[2] * (own_[1] - y[1]);
        double hardening = by_p[1];
        for (std::size_t k = 2; k < y.size(); ++k) {
            by_p[k] = own_[2 * k - 1] * n - own_[2 * k] * y[k];
            hardening += n * by_p[k];
        }
        const double p_by_strain = 1.0 / (1.0 + hardening / modulus.after(y[0]));
        for (double& rate : by_p) rate *= p_by_strain;
        return by_p;
    }
    // Continues by a strain of this size, at most `left`; returns the size.
    double flow(double n, double left) {
        state = runge_kutta_4(state, left, [&](const State& y) { return rates(y, n); });
        return left;
    }

    Modulus modulus;

   private:
    const double* own_;

   public:
    State state;
};

// State: plastic strain p, R, theta (the yield surface's centre from the bounding surface's), beta
// (the bounding surface's), q and r (centre and size of the stagnation surface).
class YoshidaUemori {
   public:
    YoshidaUemori(const curvewise::YoshidaUemori& material, const double* parameters)
        : modulus(parameters, material.modulus),
          own_(parameters + (material.modulus == curvewise::Modulus::constant ? 1 : 3)),
          is_power_(material.growth == curvewise::BoundGrowth::power),
          state(6, 0.0) {}

    double centre() const { return state[2] + state[3]; }
    double radius() const { return own_[1]; }
    State rates(const State& y, double n, bool grows) const {
        const double CB = own_[0], Y = own_[1], C = own_[2], K = own_[3], RSAT = own_[4],
                     SB = own_[5], H = own_[6];
        const double a = CB + y[1] - Y;
        State by_p(6, 0.0);
        by_p[0] = 1.0;
        by_p[2] = C * (n * a - std::copysign(std::sqrt(a * std::abs(y[2])), y[2]));
        by_p[3] = K * (n * SB - y[3]);
        if (grows) {
            by_p[1] = is_power_ ? RSAT * own_[8] * std::pow(own_[7] + y[0], own_[8] - 1.0)
                                : K * (RSAT - y[1]);
            by_p[4] = (1.0 - H) * by_p[3];
            by_p[5] = H * std::abs(by_p[3]);
        }
        const double p_by_strain = 1.0 / (1.0 + n * (by_p[2] + by_p[3]) / modulus.after(y[0]));
        for (double& rate : by_p) rate *= p_by_strain;
        return by_p;
    }
    double flow(double n, double left) {
        if (n != direction_) grows_ = false;
        direction_ = n;
        // Whether the bounding surface's centre is at the stagnation surface's end, going out.
        const auto outside = [&](const State& y) { return n * (y[3] - y[4]) - y[5]; };
        if (outside(state) >= 0.0) grows_ = true;
        const double steepness = std::abs(rates(state, n, grows_)[2]);
        double h = std::min(left, std::max(0.1 * std::abs(state[2]) / steepness, 1e-13));
        const auto stepped = [&](double length) {
            return runge_kutta_4(state, length,
                                 [&](const State& y) { return rates(y, n, grows_); });
        };
        State next = stepped(h);
        if (!grows_ && outside(next) > 0.0) {
            double low = 0.0;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + h);
                (outside(stepped(middle)) > 0.0 ? h : low) = middle;
            }
            next = stepped(h);
            grows_ = true;
        }
        state = next;
        return h;
    }

    Modulus modulus;

   private:
    const double* own_;
    bool is_power_;
    bool grows_ = false;
    double direction_ = 0.0;

   public:
    State state;
};

// The stress at each strain, in about `increments` steps.
template <class Point, class Material>
std::vector<double> stress(const Material& material, const double* parameters,
                           const std::vector<double>& strain, int increments) {
    double length = 0.0, last = 0.0;
    for (const double value : strain) length += std::abs(value - last), last = value;
    const double longest = length / increments;
    Point point(material, parameters);
    double s = 0.0;
    last = 0.0;
    std::vector<double> found;
    for (const double value : strain) {
        const int parts = static_cast<int>(std::ceil(std::abs(value - last) / longest)) + 1;
        const double part = (value - last) / parts;
        for (int i = 0; i < parts; ++i) {
            const double E = point.modulus.after(point.state[0]), n = std::copysign(1.0, part);
            const double to_yield =
                std::max(0.0, (point.centre() + n * point.radius() - s) / (n * E));
            double left = std::abs(part) - to_yield;
            if (left <= 0.0) {
                s += E * part;
                continue;
            }
            while (left > 0.0) left -= point.flow(n, left);
            s = point.centre() + n * point.radius();
        }
        last = value;
        found.push_back(s);
    }
    return found;
}

}  // namespace textbook
