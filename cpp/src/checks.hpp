// What every measure requires of its two curves, checked before any work, in one order and with
// one wording: std::invalid_argument says what is wrong, where, and what is needed.
#pragma once

#include <cmath>
#include <cstddef>

#include "curvewise/curve.hpp"

namespace curvewise::detail {

struct Requirements {
    const char* measure;
    std::ptrdiff_t min_points;
    bool planar;  // exactly two coordinates, x and y
};

// The exponent k of the power of two by which both curves are divided before anything is squared
// (0: not at all), and its undoing. Exact but for values that leave the range of a double.
class RangeScale {
   public:
    explicit RangeScale(double largest_magnitude) noexcept;
    // To where `magnitude`, if not 0, comes to lie between 1/2 and 1, whatever it is.
    static RangeScale to_unity(double magnitude) noexcept;
    bool is_identity() const noexcept { return exponent_ == 0; }
    double shrink(double coordinate) const noexcept {
        return is_identity() ? coordinate : std::ldexp(coordinate, -exponent_);
    }
    // A result that is homogeneous of the given degree in the coordinates.
    double restore(double value, int degree) const noexcept {
        return is_identity() ? value : std::ldexp(value, exponent_ * degree);
    }

   private:
    RangeScale() noexcept = default;
    int exponent_ = 0;
};

// Checks both curves and returns the scaling their magnitude asks for.
RangeScale check_pair(const CurveView& P, const CurveView& Q, const Requirements& needs);

// Throws for the first entry, in row-major order, that is not finite; returns the largest |entry|.
double check_finite(const CurveView& curve, const char* name);

// A curve by itself: its columns, its number of points.
void check_shape(const CurveView& curve, const char* name, const Requirements& needs);

void check_equal_shapes(const CurveView& P, const CurveView& Q, const char* measure);
void check_same_dim(const CurveView& P, const char* p_name, const CurveView& Q, const char* q_name);
void check_points(const CurveView& curve, const char* name, const Requirements& needs);

}  // namespace curvewise::detail
