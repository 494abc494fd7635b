// Points of the sphere by their longitude and latitude, and along it. In three coordinates, on the
// sphere of diameter 1 about the origin, the square of their distance is the square of half the
// chord of the unit sphere, and grows with the arc: boxes, bounds and pruning are those of space.
//
// Sines and cosines of degrees are by polynomials of its own (interpolation in the nodes of
// Chebyshev, errors below 2e-17), on what is left within 45 degrees of a multiple of 90, exactly:
// the same bits on every machine and in numpy, 0 and 1 at the poles, and the same point for -180
// and 180 degrees. A coordinate is wrong by 1e-16 at most, a nanometre on the Earth.
#pragma once

#include <array>
#include <string>

#include "curvewise/curve.hpp"

namespace curvewise::curves {

inline constexpr std::ptrdiff_t sphere_dim = 3;

// Of degrees within check_on_sphere().
std::array<double, sphere_dim> on_sphere(double longitude, double latitude) noexcept;

// By longitude and latitude, in degrees, of the point of Q: the derivative of the arc of the unit
// sphere to it from the point of P.
struct SlopeOnSphere {
    double by_longitude;
    double by_latitude;
};
SlopeOnSphere slope_on_sphere(const double* p, const double* q) noexcept;

// Throws std::invalid_argument for a point that is none: latitudes from -90 to 90, longitudes from
// -360 to 360.
void check_on_sphere(const CurveView& curve, const std::string& name);

}  // namespace curvewise::curves
