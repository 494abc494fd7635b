#include "curves/sphere.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace curvewise::curves {
namespace {

struct SineAndCosine {
    double sine;
    double cosine;
};

template <std::size_t count>
double polynomial(const double (&coefficients)[count], double x) noexcept {
    double sum = coefficients[count - 1];
    for (std::size_t k = count - 1; k > 0; --k) sum = sum * x + coefficients[k - 1];
    return sum;
}

SineAndCosine of_degrees(double degrees) noexcept {
    constexpr double per_degree = 0.017453292519943295;
    constexpr double sine_terms[] = {-8.860961557012979e-07,  1.3496016231628688e-11,
                                     -9.788384859392164e-17,  4.141266948173571e-22,
                                     -1.1467754740637925e-27, 2.219718014334642e-33};
    constexpr double cosine_terms[] = {-0.0001523087098933543,  3.86632385156299e-09,
                                       -3.9258319857408015e-14, 2.1354943029153012e-19,
                                       -7.227874204324564e-25,  1.667912805508616e-30,
                                       -2.766732424324131e-36};
    const double quarters = std::nearbyint(degrees / 90.0);
    const double rest = degrees - 90.0 * quarters;
    const double square = rest * rest;
    const double sine = rest * per_degree + rest * (square * polynomial(sine_terms, square));
    const double cosine = 1.0 + square * polynomial(cosine_terms, square);
    switch (static_cast<int>(quarters) & 3) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

[[noreturn]] void refuse(const std::string& name, std::ptrdiff_t i, std::ptrdiff_t c, double value,
                         const char* need) {
    char number[32];
    std::snprintf(number, sizeof number, "%.10g", value);
    throw std::invalid_argument(name + "[" + std::to_string(i) + ", " + std::to_string(c) +
                                "] is " + number + "; metric='haversine' takes longitude, " +
                                "latitude: " + need);
}

}  // namespace

std::array<double, sphere_dim> on_sphere(double longitude, double latitude) noexcept {
    const SineAndCosine along = of_degrees(longitude), up = of_degrees(latitude);
    const double half = 0.5 * up.cosine;
    return {half * along.cosine, half * along.sine, 0.5 * up.sine};
}

// The derivative of h = sin^2(dlat / 2) + cos(lat_p) cos(lat_q) sin^2(dlon / 2), whose arc is 2
// asin(sqrt(h)).
SlopeOnSphere slope_on_sphere(const double* p, const double* q) noexcept {
    constexpr double per_degree = 0.017453292519943295;
    const SineAndCosine lat_p = of_degrees(p[1]), lat_q = of_degrees(q[1]);
    const SineAndCosine half_lon = of_degrees((q[0] - p[0]) / 2.0);
    const SineAndCosine half_lat = of_degrees((q[1] - p[1]) / 2.0);
    const double across = half_lon.sine * half_lon.sine;
    const double h = half_lat.sine * half_lat.sine + lat_p.cosine * lat_q.cosine * across;
    if (!(h * (1.0 - h) > 0.0)) return {0.0, 0.0};  // the same point, or the one opposite
    const double slope = per_degree / std::sqrt(h * (1.0 - h));
    return {slope * lat_p.cosine * lat_q.cosine * half_lon.sine * half_lon.cosine,
            slope * (half_lat.sine * half_lat.cosine - lat_p.cosine * lat_q.sine * across)};
}

void check_on_sphere(const CurveView& curve, const std::string& name) {
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        if (!(std::abs(curve(i, 0)) <= 360.0)) {
            refuse(name, i, 0, curve(i, 0), "longitudes are from -360 to 360 degrees");
        }
        if (!(std::abs(curve(i, 1)) <= 90.0)) {
            refuse(name, i, 1, curve(i, 1), "latitudes are from -90 to 90 degrees");
        }
    }
}

}  // namespace curvewise::curves
