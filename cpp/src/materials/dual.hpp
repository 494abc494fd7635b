// Dual numbers: a value with its derivatives in N directions, carried through every operation
// (forward differentiation; Griewank & Walther, "Evaluating Derivatives", 2008, chapter 3). Code
// that is written for a Number computes with double or with Dual; the values are the same bits.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace curvewise::materials {

template <std::size_t N>
struct Dual {
    double value = 0.0;
    std::array<double, N> slopes{};

    Dual() = default;
    Dual(double number) noexcept : value(number) {}  // NOLINT(google-explicit-constructor)

    // f(x), where f' is known at x.
    Dual mapped(double f, double derivative) const noexcept {
        Dual result(f);
        for (std::size_t i = 0; i < N; ++i) result.slopes[i] = derivative * slopes[i];
        return result;
    }

    Dual operator-() const noexcept { return mapped(-value, -1.0); }
    Dual& operator+=(const Dual& other) noexcept {
        value += other.value;
        for (std::size_t i = 0; i < N; ++i) slopes[i] += other.slopes[i];
        return *this;
    }
    Dual& operator-=(const Dual& other) noexcept {
        value -= other.value;
        for (std::size_t i = 0; i < N; ++i) slopes[i] -= other.slopes[i];
        return *this;
    }
    friend Dual operator+(Dual a, const Dual& b) noexcept { return a += b; }
    friend Dual operator-(Dual a, const Dual& b) noexcept { return a -= b; }
    friend Dual operator+(Dual a, double b) noexcept {
        a.value += b;
        return a;
    }
    friend Dual operator+(double a, const Dual& b) noexcept { return b + a; }
    friend Dual operator-(Dual a, double b) noexcept {
        a.value -= b;
        return a;
    }
    friend Dual operator-(double a, const Dual& b) noexcept { return b.mapped(a - b.value, -1.0); }
    friend Dual operator*(const Dual& a, double b) noexcept { return a.mapped(a.value * b, b); }
    friend Dual operator*(double a, const Dual& b) noexcept { return b.mapped(a * b.value, a); }
    friend Dual operator*(const Dual& a, const Dual& b) noexcept {
        Dual result(a.value * b.value);
        for (std::size_t i = 0; i < N; ++i) {
            result.slopes[i] = a.slopes[i] * b.value + b.slopes[i] * a.value;
        }
        return result;
    }
    friend Dual operator/(const Dual& a, double b) noexcept {
        return a.mapped(a.value / b, 1.0 / b);
    }
    friend Dual operator/(const Dual& a, const Dual& b) noexcept {
        const double quotient = a.value / b.value, inverse = 1.0 / b.value;
        Dual result(quotient);
        for (std::size_t i = 0; i < N; ++i) {
            result.slopes[i] = (a.slopes[i] - quotient * b.slopes[i]) * inverse;
        }
        return result;
    }
};

template <class Number>
inline constexpr bool has_slopes = false;
template <std::size_t N>
inline constexpr bool has_slopes<Dual<N>> = true;

inline double value_of(double number) noexcept { return number; }
template <std::size_t N>
double value_of(const Dual<N>& number) noexcept {
    return number.value;
}

using std::exp;
using std::log;
using std::pow;

template <std::size_t N>
Dual<N> exp(const Dual<N>& x) noexcept {
    const double f = std::exp(x.value);
    return x.mapped(f, f);
}
template <std::size_t N>
Dual<N> log(const Dual<N>& x) noexcept {
    return x.mapped(std::log(x.value), 1.0 / x.value);
}
// x^y for x >= 0. If x is 0, the part of the derivative by x is right for y >= 1.
template <std::size_t N>
Dual<N> pow(const Dual<N>& x, const Dual<N>& y) noexcept {
    const double f = std::pow(x.value, y.value);
    const double by_x = y.value * std::pow(x.value, y.value - 1.0);
    const double by_y = x.value > 0.0 ? f * std::log(x.value) : 0.0;
    Dual<N> result(f);
    for (std::size_t i = 0; i < N; ++i) result.slopes[i] = by_x * x.slopes[i] + by_y * y.slopes[i];
    return result;
}

// (1 - exp(-z)) / z, which is 1 at 0; z >= 0. `fall` is exp(-z) - 1.
inline double saturation(double z, double fall) noexcept { return z == 0.0 ? 1.0 : -fall / z; }
template <std::size_t N>
Dual<N> saturation(const Dual<N>& z, double fall) noexcept {
    const double x = z.value, f = saturation(x, fall);
    // (exp(-x) - f) / x cancels near 0: there the series, the sum of -k (-x)^(k-1) / (k+1)!.
    if (x > 0.3) return z.mapped(f, (1.0 + fall - f) / x);
    double derivative = 0.0, factorial = 6227020800.0;  // 13!
    for (int k = 12; k >= 1; factorial /= k + 1, --k) derivative = derivative * -x - k / factorial;
    return z.mapped(f, derivative);
}

}  // namespace curvewise::materials
