// Scaling by a power of two, so that squares neither overflow nor vanish.
#pragma once

#include <cmath>

namespace curvewise::curves {

// The exponent k of the power of two that divides both curves before anything is squared (0: not at
// all), and its inverse. Exact, except for values that leave the range of a double.
class RangeScale {
   public:
    explicit RangeScale(double largest_magnitude) noexcept;
    // The scale that brings any `magnitude`, if not 0, between 1/2 and 1.
    static RangeScale to_unity(double magnitude) noexcept;
    // This scale, limited so that a constant among results of that degree is not enlarged beyond
    // 2^1000. Curves that are very small compared with a constant then keep fewer bits, and sums
    // stay finite.
    RangeScale beside(double constant, int degree) const noexcept;
    // This scale, except that another coordinate comes to at most 2^500.
    RangeScale with_coordinate(double coordinate) const noexcept;
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

}  // namespace curvewise::curves
