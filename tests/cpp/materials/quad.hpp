// Numbers of quadruple precision (113 bits) with the operations that a point of material asks of a
// Number. gcc on x86-64 and its libquadmath alone.
#pragma once

#include <quadmath.h>

namespace curvewise::materials {

struct Quad {
    __float128 value = 0;

    Quad() = default;
    Quad(double number) noexcept : value(number) {}  // NOLINT(google-explicit-constructor)
    static Quad of(__float128 number) noexcept {
        Quad result;
        result.value = number;
        return result;
    }
    Quad operator-() const noexcept { return of(-value); }
    Quad& operator+=(const Quad& other) noexcept { return *this = *this + other; }
    friend Quad operator+(const Quad& a, const Quad& b) noexcept { return of(a.value + b.value); }
    friend Quad operator-(const Quad& a, const Quad& b) noexcept { return of(a.value - b.value); }
    friend Quad operator*(const Quad& a, const Quad& b) noexcept { return of(a.value * b.value); }
    friend Quad operator/(const Quad& a, const Quad& b) noexcept { return of(a.value / b.value); }
};

inline double value_of(const Quad& number) noexcept { return static_cast<double>(number.value); }
inline Quad exp(const Quad& x) noexcept { return Quad::of(expq(x.value)); }
inline Quad log(const Quad& x) noexcept { return Quad::of(logq(x.value)); }
inline Quad pow(const Quad& x, const Quad& y) noexcept { return Quad::of(powq(x.value, y.value)); }
inline Quad saturation(const Quad& z, double /*fall*/) noexcept {
    return z.value == 0 ? Quad(1.0) : Quad::of(-expm1q(-z.value) / z.value);
}

}  // namespace curvewise::materials
