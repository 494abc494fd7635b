// OF2 of Andrade-Campos et al. (2012): see the header for the formula.
#include "curvewise/curve_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "checks.hpp"
#include "pair_measures.hpp"
#include "planar.hpp"

namespace curvewise {
namespace {

using detail::Polyline;
using detail::RangeScale;
using detail::Watch;

// The arc lengths after dividing each coordinate by the curve's own largest magnitude.
std::vector<double> relative_arc_lengths(const CurveView& curve) {
    double largest[2] = {0.0, 0.0};
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        largest[0] = std::max(largest[0], std::abs(curve(i, 0)));
        largest[1] = std::max(largest[1], std::abs(curve(i, 1)));
    }
    for (double& value : largest) {
        if (value == 0.0) value = 1e-15;
    }
    Polyline scaled(static_cast<std::size_t>(curve.size()));
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        scaled[static_cast<std::size_t>(i)] = {curve(i, 0) / largest[0], curve(i, 1) / largest[1]};
    }
    return detail::arc_lengths(scaled);
}

// A place on a curve: a segment and a fraction of it.
struct Place {
    std::size_t segment;
    double fraction;
};

// For each point of P, at arc length s, the place on Q at the same fraction of its length.
std::vector<Place> corresponding_places(const std::vector<double>& s, const std::vector<double>& t,
                                        Watch& watch) {
    const double ratio = t.back() / s.back();
    std::vector<Place> places(s.size());
    std::size_t k = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        watch.turn(i);
        const double at = i + 1 < s.size() ? std::min(s[i] * ratio, t.back()) : t.back();
        while (k + 2 < t.size() && t[k + 1] <= at) ++k;
        const double length = t[k + 1] - t[k];
        places[i] = {k, length > 0.0 ? (at - t[k]) / length : 1.0};
    }
    return places;
}

// One coordinate of both curves, in a range of its own: a quotient has no units, so nothing needs
// to be scaled back.
struct Coordinate {
    std::vector<double> p;
    std::vector<double> q;
    const char* name;

    Coordinate(const CurveView& P, const CurveView& Q, std::ptrdiff_t c)
        : p(values(P, c)), q(values(Q, c)), name(c == 0 ? "x" : "y") {
        const double largest = largest_magnitude(p);
        if (RangeScale(std::max(largest, largest_magnitude(q))).is_identity()) return;
        const RangeScale range = RangeScale::to_unity(largest);
        for (double& value : p) value = range.shrink(value);
        for (double& value : q) value = range.shrink(value);
    }

    static std::vector<double> values(const CurveView& curve, std::ptrdiff_t c) {
        std::vector<double> result(static_cast<std::size_t>(curve.size()));
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = curve(static_cast<std::ptrdiff_t>(i), c);
        }
        return result;
    }
    static double largest_magnitude(const std::vector<double>& values) noexcept {
        double largest = 0.0;
        for (const double value : values) largest = std::max(largest, std::abs(value));
        return largest;
    }
};

// What differences in one coordinate are divided by.
double coordinate_scale(const Coordinate& x, LengthScale scale, const std::string& what) {
    const auto n = static_cast<double>(x.p.size());
    double low = x.p.front(), high = low, sum = 0.0, sum_abs = 0.0;
    for (const double value : x.p) {
        low = std::min(low, value);
        high = std::max(high, value);
        sum += value;
        sum_abs += std::abs(value);
    }
    const double largest = std::max(std::abs(low), std::abs(high));
    const std::string name = x.name;
    if (scale == LengthScale::mean) {
        const double mean = sum / n;
        if (std::abs(mean) > n * std::numeric_limits<double>::epsilon() * largest) return mean;
        throw std::invalid_argument("the mean of " + what + "'s " + name +
                                    " is 0 to rounding; use scale='mean_abs' or scale='range'");
    }
    if (largest == 0.0) {
        throw std::invalid_argument(
            what + "'s " + name + " is 0 throughout, which leaves nothing to divide by; " +
            "add the same constant to " + name + " of both curves and use scale='mean_abs'");
    }
    if (scale == LengthScale::mean_abs) return sum_abs / n;
    if (high > low) return high - low;
    throw std::invalid_argument("the range of " + what + "'s " + name +
                                " is 0; use scale='mean' or scale='mean_abs'");
}

// Writes the residuals of one coordinate to out[0], out[2], out[4], ...
void write_residuals(const Coordinate& x, const std::vector<Place>& places, double divisor,
                     double* out, Watch& watch) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        watch.turn(i);
        const double a = x.q[places[i].segment];
        const double b = x.q[places[i].segment + 1];
        const double at = places[i].fraction == 1.0 ? b : a + places[i].fraction * (b - a);
        const double relative = std::abs((at - x.p[i]) / divisor);
        out[2 * i] =
            std::log1p(std::isnan(relative) ? std::numeric_limits<double>::infinity() : relative);
    }
}

using Side = detail::CurveLengthMeasure::Side;

void write_residuals(const Side& P, const Side& Q, LengthScale scale, double* out, Watch& watch) {
    const std::vector<Place> places = corresponding_places(P.arc_lengths, Q.arc_lengths, watch);
    for (std::ptrdiff_t c = 0; c < 2; ++c) {
        const Coordinate x(P.checked.curve, Q.checked.curve, c);
        write_residuals(x, places, coordinate_scale(x, scale, P.checked.name), out + c, watch);
    }
}

double norm_of_residuals(const Side& P, const Side& Q, LengthScale scale, Watch& watch) {
    std::vector<double> residuals(2 * P.arc_lengths.size());
    write_residuals(P, Q, scale, residuals.data(), watch);
    double sum = 0.0;
    for (const double r : residuals) sum += r * r;
    return std::sqrt(sum);
}

// Both curves, checked.
std::pair<Side, Side> sides_of(const CurveView& P, const CurveView& Q, Watch& watch) {
    detail::check_pair(P, Q, {"curve_length", 2, true});
    watch.begin(P.size() + Q.size());
    Side p({P, 0.0, "P"});
    watch.turn(0);
    Side q({Q, 0.0, "Q"});
    watch.turn(0);
    return {std::move(p), std::move(q)};
}

}  // namespace

detail::CurveLengthMeasure::Side::Side(const CheckedCurve& curve)
    : checked(curve), arc_lengths(relative_arc_lengths(curve.curve)) {
    check_length(arc_lengths.back(), curve.name.c_str(), "curve_length");
}

void detail::CurveLengthMeasure::check_reference(const Reference& P) const {
    for (std::ptrdiff_t c = 0; c < 2; ++c) {
        const Coordinate x(P.checked.curve, P.checked.curve, c);
        coordinate_scale(x, options_.scale, P.checked.name);
    }
}

double detail::CurveLengthMeasure::operator()(const Reference& P, const Other& Q,
                                              const PairCall& call) const {
    return norm_of_residuals(P, Q, options_.scale, call.watch);
}

void curve_length_residuals(const CurveView& P, const CurveView& Q, double* out,
                            const CurveLengthOptions& options, Control* control) {
    Watch watch(control);
    const auto [p, q] = sides_of(P, Q, watch);
    write_residuals(p, q, options.scale, out, watch);
    watch.finish();
}

double curve_length(const CurveView& P, const CurveView& Q, const CurveLengthOptions& options,
                    Control* control) {
    Watch watch(control);
    const auto [p, q] = sides_of(P, Q, watch);
    const double value = norm_of_residuals(p, q, options.scale, watch);
    watch.finish();
    return value;
}

}  // namespace curvewise
