// The flow of the Yoshida-Uemori point as a Taylor series. a is the size of the bounding surface
// over the yield surface, and a u |u| the distance of their centres. In the time T, the plastic
// strain rises by |u| / C. All are in units of C:
//
//     du = ((1 - u) - growth u |u|) / 2 dT         growth: a' / a, which decays by
//     dgrowth = growth (bend - growth) |u| dT      bend: a'' / a'
//
// For a modulus that decays with the strain, there is also the rise of the stress over the modulus.
// All are products of known series, so each term follows from those before it (Jorba & Zou, "A
// software package for the numerical integration of ODEs by means of high-order Taylor methods",
// Experimental Mathematics 14, 2005). N terms take O(N^2) multiplications and no exponential. u
// keeps its sign.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "materials/dual.hpp"

namespace curvewise::materials {

// What the flow begins with, and all that its derivatives at a given time need.
enum : std::size_t {
    START,      // u
    GROWTH,     // a' / (C a)
    BASE,       // of a power law 1 / (C (C1 + p)), otherwise bend
    EXPONENT,   // bend over base
    LEFT,       // slope of the bounding surface's centre, over C a: from here on for a modulus
    DECAY,      // that decays; K / C
    SOFTENING,  // xi / C
    LIMIT,      // Ea over the modulus
    flow_numbers
};
template <class Number>
using FlowStart = std::array<Number, flow_numbers>;

struct FlowKind {
    double sign;  // of u
    bool grows, is_power, softens;
};

template <class Number>
class FlowSeries {
   public:
    // The series in the time over `length`.
    void begin(const FlowStart<Number>& start, const FlowKind& kind, double length) {
        start_ = start, kind_ = kind, length_ = length, order_ = 0;
        u_[0] = start[START];
        p_[0] = Number(0.0);
        if (kind.grows) {
            growth_[0] = start[GROWTH];
            base_[0] = start[BASE];
        }
        if (kind.softens) {
            size_[0] = compliance_[0] = Number(1.0);
            left_[0] = start[LEFT];
            rise_[0] = Number(0.0);
        }
    }
    // One term more.
    void extend() {
        const std::size_t k = order_++;
        const double weight = length_ / static_cast<double>(k + 1),
                     signed_weight = kind_.sign * weight;
        u_[k + 1] = (k == 0 ? 1.0 : 0.0) - u_[k];
        if (kind_.grows) grow(k, signed_weight);
        u_[k + 1] = (0.5 * weight) * u_[k + 1];
        p_[k + 1] = signed_weight * u_[k];
        if (kind_.softens) soften(k, signed_weight);
    }
    std::size_t order() const noexcept { return order_; }
    // Adds terms until the last two are below a tolerance; returns up to which share of `length`
    // they are.
    double extend_to(double tolerance) {
        double last = 0.0;
        do {
            extend();
            last = last_terms();
        } while (order_ < 2 || (!(last <= tolerance) && order_ < most_terms));
        return last <= tolerance
                   ? 1.0
                   : 0.9 * std::pow(tolerance / last, 1.0 / static_cast<double>(order_ - 1));
    }
    // Adds terms until the last two of every derivative are below a tolerance, relative to the
    // largest. If u is constant, almost no new terms of u remain. The derivatives still need the
    // same number of terms until they decay: truncated early, they grow with each leg.
    void extend_slopes_to(double tolerance) {
        while (!(are_small(u_, tolerance) && (!kind_.softens || are_small(rise_, tolerance))) &&
               order_ < most_terms) {
            extend();
        }
    }
    // At a share of `length`: u, and the plastic strain since the start, times C. If the modulus
    // decays, also the rise of the stress over a at the start; each part of it is weighted by the
    // compliance relative to that at the start.
    struct Sum {
        Number u, p, rise;
    };
    Sum at(double share) const {
        Sum sum{u_[order_], p_[order_], kind_.softens ? rise_[order_] : Number(0.0)};
        for (std::size_t k = order_; k-- > 0;) {
            sum.u = sum.u * share + u_[k];
            sum.p = sum.p * share + p_[k];
            if (kind_.softens) sum.rise = sum.rise * share + rise_[k];
        }
        return sum;
    }

   private:
    static constexpr std::size_t most_terms = 24;
    using Terms = std::array<Number, most_terms + 1>;

    double last_terms() const noexcept {
        const auto both = [&](const Terms& terms) {
            return std::abs(value_of(terms[order_])) + std::abs(value_of(terms[order_ - 1]));
        };
        return kind_.softens ? std::max(both(u_), both(rise_)) : both(u_);
    }
    bool are_small(const Terms& terms, double tolerance) const noexcept {
        for (std::size_t i = 0; i < terms[0].slopes.size(); ++i) {
            double largest = 0.0;
            for (std::size_t k = 0; k <= order_; ++k) {
                largest = std::max(largest, std::abs(terms[k].slopes[i]));
            }
            const double last = std::abs(terms[order_].slopes[i]);
            const double before = std::abs(terms[order_ - 1].slopes[i]);
            if (!(last + before <= tolerance * largest)) return false;
        }
        return true;
    }
    void grow(std::size_t k, double signed_weight) {
        speed_[k] = product(u_, growth_, k);
        bend_[k] = -growth_[k];
        if (kind_.is_power || k == 0) bend_[k] += start_[EXPONENT] * base_[k];
        Number pull = speed_[0] * u_[k], rate = speed_[0] * bend_[k];
        for (std::size_t i = 1; i <= k; ++i) {
            pull += speed_[i] * u_[k - i];
            rate += speed_[i] * bend_[k - i];
        }
        u_[k + 1] += -kind_.sign * pull;
        growth_[k + 1] = signed_weight * rate;
        if (!kind_.is_power) return;
        scaled_[k] = product(u_, base_, k);
        base_[k + 1] = -signed_weight * product(scaled_, base_, k);
    }
    void soften(std::size_t k, double signed_weight) {
        relative_[k] = product(u_, compliance_, k);
        excess_[k] = (k == 0 ? 1.0 : 0.0) - start_[LIMIT] * compliance_[k];
        slope_[k] = size_[k] - product(size_, u_, k) + left_[k];
        compliance_[k + 1] = signed_weight * (start_[SOFTENING] * product(relative_, excess_, k));
        size_[k + 1] = kind_.grows ? signed_weight * product(speed_, size_, k) : Number(0.0);
        left_[k + 1] = -signed_weight * (start_[DECAY] * product(u_, left_, k));
        rise_[k + 1] = signed_weight * product(relative_, slope_, k);
    }
    static Number product(const Terms& a, const Terms& b, std::size_t k) {
        Number sum = a[0] * b[k];
        for (std::size_t i = 1; i <= k; ++i) sum += a[i] * b[k - i];
        return sum;
    }
    FlowStart<Number> start_{};
    FlowKind kind_{};
    double length_ = 0.0;
    std::size_t order_ = 0;
    Terms u_, p_, growth_, base_, speed_, bend_, scaled_;
    Terms size_, left_, compliance_, rise_, relative_, excess_, slope_;
};

// The number type of a series for each number type of the flow. While the modulus is constant,
// derivatives by the parameters follow from those by the first four initial values.
template <class Number>
struct ForSlopes {
    using Few = Number;
};
template <std::size_t N>
struct ForSlopes<Dual<N>> {
    using Few = Dual<LEFT>;
};
template <class SeriesNumber, class Number>
FlowStart<SeriesNumber> seeded(const FlowStart<Number>& start) {
    if constexpr (std::is_same_v<SeriesNumber, Number>) {
        return start;
    } else {
        FlowStart<SeriesNumber> seeds;
        for (std::size_t j = 0; j < LEFT; ++j) {
            seeds[j] = SeriesNumber(value_of(start[j]));
            seeds[j].slopes[j] = 1.0;
        }
        return seeds;
    }
}
template <class Number>
Number chained(const Number& found, const FlowStart<Number>& /*start*/) {
    return found;
}
template <std::size_t N>
Dual<N> chained(const Dual<LEFT>& found, const FlowStart<Dual<N>>& start) {
    Dual<N> result(found.value);
    for (std::size_t j = 0; j < LEFT; ++j) {
        for (std::size_t i = 0; i < N; ++i)
            result.slopes[i] += found.slopes[j] * start[j].slopes[i];
    }
    return result;
}

}  // namespace curvewise::materials
