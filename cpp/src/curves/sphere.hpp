// Points of the sphere by their longitude and latitude, and distances along it. In three
// coordinates, the points are on the sphere of diameter 1 about the origin. The square of their
// distance is then the square of half the chord of the unit sphere, and grows with the arc. So
// boxes, bounds and pruning work as in space.
//
// Sines and cosines of degrees are polynomials (interpolation in the Chebyshev nodes, errors below
// 2e-17). Their argument is the exact remainder within 45 degrees of a multiple of 90. Results are
// bitwise identical on every machine and in numpy. They are 0 and 1 at the poles, and the same
// point for -180 and 180 degrees. The error of a coordinate is at most 1e-16, a nanometre on the
// Earth.
#pragma once

#include <array>
#include <string>

#include "curvewise/curve.hpp"

namespace curvewise::curves {

inline constexpr std::ptrdiff_t sphere_dim = 3;

// The point for degrees within check_on_sphere().
std::array<double, sphere_dim> on_sphere(double longitude, double latitude) noexcept;

// By longitude and latitude, in degrees, of the point of Q: the derivative of the arc of the unit
// sphere to it from the point of P.
struct SlopeOnSphere {
    double by_longitude;
    double by_latitude;
};
SlopeOnSphere slope_on_sphere(const double* p, const double* q) noexcept;

// Throws std::invalid_argument for an invalid point: latitudes must be from -90 to 90, longitudes
// from -360 to 360.
void check_on_sphere(const CurveView& curve, const std::string& name);

}  // namespace curvewise::curves
