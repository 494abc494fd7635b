// The Ohno-Wang material, version II. Plastic flow keeps its direction n; p is the plastic strain
// since it began. With x = n X / r of a back stress and t = zeta p,
//
//     dx / dt = 1 - <x>^q,    q = m + 1,    <x> = max(x, 0)
//
// so that t is the integral of 1 / (1 - <x>^q): x itself below 0, a series up to 1/2, and from
// there on, with x = 1 - exp(-v), the integral of a smooth function g(v)^-1, whose scale is 1 for
// any q. Newton's method inverts it. Then n s = yield + R + sum of n X is known for every p, and a
// step solves
//
//     p + rise of n s / E = the strain behind the yield point
//
// whose left side rises. The derivatives are those of the implicit functions. Exact to rounding for
// steps of any length.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/law.inl.hpp"
#include "materials/quadrature.hpp"

namespace curvewise::materials {
namespace {

// Places of the parameters.
struct At {
    enum : std::size_t { YIELD = 1, Q, B, BACK };
};

// The course of x for one q.
class Recall {
   public:
    explicit Recall(double q) noexcept : q_(q) {}

    // 1 - <x>^q, which is dx / dt.
    double rate(double x) const {
        if (x >= 1.0) return 0.0;
        return x > 0.0 ? -std::expm1(q_ * std::log(x)) : 1.0;
    }
    // x after the time t.
    double after(double x, double t) const {
        if (x < 0.0) {
            if (t <= -x) return x + t;
            t += x;
            x = 0.0;
        }
        if (x < half) {
            const double begin = series(x), left = series(half) - begin;
            if (t <= left) return below_half(x, begin + t);
            t -= left;
            x = half;
        }
        return x < 1.0 ? above_half(x, t) : x;
    }
    // The derivative by q of the time from one x to a later one.
    double time_by_q(double from, double to) const {
        double sum = 0.0;
        const double first = std::max(from, 0.0), last = std::min(to, half);
        if (first < last) sum += series_by_q(last) - series_by_q(first);
        if (to > half) {
            const double begin = std::max(from, half);
            sum += integral(height(begin), height(to), [this](double v) {
                const double logarithm = std::log1p(-std::exp(-v));
                return std::exp(q_ * logarithm + v) * logarithm / (speed(v) * speed(v));
            });
        }
        return sum;
    }

   private:
    static constexpr double half = 0.5;
    static constexpr double saturated = 40.0;  // of v: x is 1 to rounding

    static double height(double x) { return x < 1.0 ? -std::log1p(-x) : saturated; }
    // dv / dt, from 1 to q.
    double speed(double v) const {
        return -std::expm1(q_ * std::log1p(-std::exp(-v))) * std::exp(v);
    }
    // The time from 0 to x, up to 1/2: the sum of x^(k q + 1) / (k q + 1).
    double series(double x) const {
        const double factor = std::pow(x, q_);
        double sum = 0.0, power = x;
        for (int k = 0; power > 1e-18; ++k) {
            sum += power / (k * q_ + 1.0);
            power *= factor;
        }
        return sum;
    }
    double series_by_q(double x) const {
        if (x == 0.0) return 0.0;
        const double factor = std::pow(x, q_), logarithm = std::log(x);
        double sum = 0.0, power = x * factor;
        for (int k = 1; power > 1e-18; ++k) {
            const double divisor = k * q_ + 1.0;
            sum += k * power * (logarithm / divisor - 1.0 / (divisor * divisor));
            power *= factor;
        }
        return sum;
    }
    // Convex: the first iterate is beyond the root, and the others come back to it.
    double below_half(double x, double time) const {
        double y = std::min(half, x + rate(x) * (time - series(x)));
        for (int iteration = 0; iteration < 60; ++iteration) {
            const double step = (series(y) - time) * rate(y);
            y -= step;
            if (!(step > 1e-16)) break;
        }
        return std::max(x, y);
    }
    // Concave: all iterates are before the root.
    double above_half(double x, double t) const {
        double v = height(x);
        while (v < saturated) {
            const double step = speed(v) * t;
            if (!(step * std::exp(-v) > 1e-16)) return -std::expm1(-v - std::max(step, 0.0));
            const double next = std::min(v + step, saturated);
            t -= integral(v, next, [this](double w) { return 1.0 / speed(w); });
            v = next;
        }
        return 1.0;
    }
    template <class Function>
    static double integral(double from, double to, Function function) {
        double sum = 0.0;
        while (from < to) {
            const double width = std::min(1.0, to - from);
            sum += integral_of_decays(width, 1.0, [&](double s) { return function(from + s); });
            from = width < 1.0 ? to : from + 1.0;
        }
        return sum;
    }

    double q_;
};

template <class Number>
struct BackStress {
    Number zeta, r, q;
    Number X{0.0};
};

template <class Number>
class OhnoWangPoint {
   public:
    OhnoWangPoint(const OhnoWang& /*material*/, const Number* parameters, std::size_t count)
        : E_(parameters[0]),
          yield_(parameters[At::YIELD]),
          Q_(parameters[At::Q]),
          b_(parameters[At::B]) {
        for (std::size_t i = At::BACK; i < count; i += 3) {
            backs_.push_back({parameters[i], parameters[i + 1], parameters[i + 2] + 1.0});
        }
    }

    // The stress after a further increment of strain.
    template <class Increment>
    Number advance(const Increment& increment) {
        const Number trial = stress_ + E_ * increment;
        Number centre(0.0);
        for (const BackStress<Number>& back : backs_) centre += back.X;
        const double n = value_of(trial) < value_of(centre) ? -1.0 : 1.0;
        const Number excess = n * (trial - centre) - (yield_ + R_);
        if (value_of(excess) <= 0.0) return stress_ = trial;
        return stress_ = flow(n, excess / E_);
    }

   private:
    // n X over r at the start of the flow.
    static Number relative(const BackStress<Number>& back, double n) { return n * back.X / back.r; }
    double fall_of_R(double p) const {
        return (value_of(R_) - value_of(Q_)) * -std::expm1(-value_of(b_) * p);
    }

    // The stress after plastic flow in the direction n, by `strain` behind the yield point.
    Number flow(double n, const Number& strain) {
        reached_.clear();
        for (const BackStress<Number>& back : backs_) {
            reached_.push_back(value_of(relative(back, n)));
        }
        const double p = plastic_strain(n, value_of(strain));
        const Number decay = exp(-(b_ * p)), R = Q_ - (Q_ - R_) * decay;
        Number risen = R - R_;
        double steepness = value_of(b_ * (Q_ - R_) * decay);
        for (std::size_t k = 0; k < backs_.size(); ++k) {
            const Number before = relative(backs_[k], n);
            const Number after = course(backs_[k], before, p, reached_[k]);
            risen += backs_[k].r * (after - before);
            steepness += slope(backs_[k], reached_[k]);
            backs_[k].X = n * backs_[k].r * after;
        }
        // The last step to the root, whose derivatives are those of the implicit function.
        const Number rest = (strain - (p + risen / E_)) / (1.0 + steepness / value_of(E_));
        R_ = R + value_of(b_ * (Q_ - R_) * decay) * rest;
        Number stress = n * (yield_ + R_);
        for (std::size_t k = 0; k < backs_.size(); ++k) {
            backs_[k].X += n * slope(backs_[k], reached_[k]) * rest;
            stress += backs_[k].X;
        }
        return stress;
    }
    // r dx / dp.
    static double slope(const BackStress<Number>& back, double x) {
        return value_of(back.zeta) * value_of(back.r) * Recall(value_of(back.q)).rate(x);
    }
    // x after the plastic strain p, whose value is known, with its derivatives: the time from
    // `before` to x is zeta p.
    static Number course(const BackStress<Number>& back, const Number& before, double p, double x) {
        if constexpr (has_slopes<Number>) {
            const Recall recall(value_of(back.q));
            const double first = recall.rate(value_of(before)), last = recall.rate(x);
            Number time = back.zeta * p;
            time -= value_of(time);
            if (first > 0.0) {
                time += (before - value_of(before)) / first;
                time -= recall.time_by_q(value_of(before), x) * (back.q - value_of(back.q));
            }
            return x + last * time;
        } else {
            return x;
        }
    }

    // The root, so nearly that the next iterate is it to rounding. Leaves x of each back stress in
    // reached_.
    double plastic_strain(double n, double target) {
        const double E = value_of(E_);
        double low = 0.0, high = target + std::max(0.0, value_of(R_) - value_of(Q_)) / E, p = 0.0;
        constexpr int most_iterations = 200;
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            double risen = -fall_of_R(p);
            double steepness = value_of(b_) * (value_of(Q_) - value_of(R_) - risen);
            for (std::size_t k = 0; k < backs_.size(); ++k) {
                risen += value_of(backs_[k].r) * (reached_[k] - value_of(relative(backs_[k], n)));
                steepness += slope(backs_[k], reached_[k]);
            }
            const double excess = p + risen / E - target;
            (excess > 0.0 ? high : low) = p;
            double next = p - excess / (1.0 + steepness / E);
            if (std::abs(next - p) <= 1e-10 * p) break;
            if (!(next > low && next < high)) next = 0.5 * (low + high);
            move(n, p, next);
            p = next;
        }
        return p;
    }
    // From one plastic strain to another: from the start of the flow if it is less.
    void move(double n, double p, double next) {
        for (std::size_t k = 0; k < backs_.size(); ++k) {
            const BackStress<Number>& back = backs_[k];
            const double zeta = value_of(back.zeta);
            const Recall recall(value_of(back.q));
            reached_[k] = next >= p ? recall.after(reached_[k], zeta * (next - p))
                                    : recall.after(value_of(relative(back, n)), zeta * next);
        }
    }

    Number E_, yield_, Q_, b_;
    std::vector<BackStress<Number>> backs_;
    std::vector<double> reached_;
    Number R_{}, stress_{};
};

}  // namespace

template <>
struct Law<OhnoWang> {
    template <class Number>
    using Point = OhnoWangPoint<Number>;

    static std::vector<MaterialParameter> parameters(const OhnoWang& material) {
        if (material.backstresses < 0 || material.backstresses > 99) {
            throw std::invalid_argument("backstresses is " + std::to_string(material.backstresses) +
                                        "; give a whole number from 0 to 99");
        }
        std::vector<MaterialParameter> found{
            {"E", "stress", "Young's modulus"},
            {"yield", "stress", "initial yield stress"},
            {"Q", "stress", "final increase of the yield stress; negative: softening"},
            {"b", "-", "rate of this increase with the plastic strain"}};
        for (int k = 1; k <= material.backstresses; ++k) {
            const std::string number = std::to_string(k);
            found.push_back({"zeta" + number, "-", "rate of back stress " + number});
            found.push_back({"r" + number, "stress", "limit of back stress " + number});
            found.push_back(
                {"m" + number, "-", "exponent of its recall: the larger, the less ratcheting"});
        }
        return found;
    }
    static void check(const OhnoWang& /*material*/, const Parameters& given) {
        given.above_zero(0);
        given.above_zero(At::YIELD);
        given.at_least_zero(At::B);
        for (std::size_t i = At::BACK; i < given.count(); i += 3) {
            given.at_least_zero(i);
            given.above_zero(i + 1);
            given.at_least_zero(i + 2);
        }
        if (given[At::YIELD] + given[At::Q] <= 0.0) {
            given.refuse(At::Q, "a yield stress of " + text_of(given[At::YIELD]) +
                                    " would soften to nothing; give Q > -yield");
        }
        if (-given[At::Q] * given[At::B] >= given[0]) {
            given.refuse(At::B, "the yield stress would fall faster than E; give b < -E / Q");
        }
    }
    static double largest_stress(const OhnoWang& /*material*/, const Parameters& checked,
                                 const StrainPath& /*path*/) {
        double most = checked[At::YIELD] + std::max(0.0, checked[At::Q]);
        for (std::size_t i = At::BACK; i < checked.count(); i += 3) most += checked[i + 1];
        return with_rounding(most, 1e-9);
    }
};

template struct ByStrain<OhnoWang>;
template struct ByStress<OhnoWang>;

}  // namespace curvewise::materials
