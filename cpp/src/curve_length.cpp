// OF2 of Andrade-Campos et al. (2012): see the header for the formula.
#include "curvewise/curve_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "checks.hpp"
#include "planar.hpp"

namespace curvewise {
namespace {

using detail::Point;
using detail::Polyline;

// The arc lengths after dividing each coordinate by the curve's own largest magnitude.
std::vector<double> relative_arc_lengths(const Polyline& curve) {
    Point largest{0.0, 0.0};
    for (const Point& point : curve) {
        largest.x = std::max(largest.x, std::abs(point.x));
        largest.y = std::max(largest.y, std::abs(point.y));
    }
    if (largest.x == 0.0) largest.x = 1e-15;
    if (largest.y == 0.0) largest.y = 1e-15;
    Polyline scaled(curve.size());
    std::transform(curve.begin(), curve.end(), scaled.begin(), [&](const Point& point) -> Point {
        return {point.x / largest.x, point.y / largest.y};
    });
    return detail::arc_lengths(scaled);
}

[[noreturn]] void throw_zero_scale(const char* what, const char* axis, const char* others) {
    throw std::invalid_argument(std::string("the ") + what + " of P's " + axis + " is 0" + others);
}

// What differences in one coordinate are divided by.
double coordinate_scale(const Polyline& P, double Point::*coordinate, LengthScale scale) {
    const char* const axis = coordinate == &Point::x ? "x" : "y";
    const auto n = static_cast<double>(P.size());
    double low = P.front().*coordinate, high = low, sum = 0.0, sum_abs = 0.0;
    for (const Point& point : P) {
        const double value = point.*coordinate;
        low = std::min(low, value);
        high = std::max(high, value);
        sum += value / n;
        sum_abs += std::abs(value) / n;
    }
    if (scale == LengthScale::range) {
        if (high > low) return high - low;
        throw_zero_scale("range", axis, "; use scale='mean' or scale='mean_abs'");
    }
    if (scale == LengthScale::mean_abs) {
        if (sum_abs > 0.0) return sum_abs;
        throw_zero_scale("mean absolute value", axis,
                         " throughout; curve_length needs another x or y");
    }
    const double largest = std::max(std::abs(low), std::abs(high));
    if (std::abs(sum) > n * std::numeric_limits<double>::epsilon() * largest) return sum;
    throw_zero_scale("mean", axis, " to rounding; use scale='mean_abs' or scale='range'");
}

// Which point of Q corresponds to each point of P: the one at the same fraction of its length.
class Correspondence {
   public:
    Correspondence(const Polyline& P, const Polyline& Q)
        : Q_(Q), s_(relative_arc_lengths(P)), t_(relative_arc_lengths(Q)) {
        detail::check_length(s_.back(), "P", "curve_length");
        detail::check_length(t_.back(), "Q", "curve_length");
    }

    // Calls visit(i, point of Q) for every point i of P.
    template <class Visit>
    void for_each(Visit visit) const {
        const double ratio = t_.back() / s_.back();
        std::size_t k = 0;
        for (std::size_t i = 0; i < s_.size(); ++i) {
            const double at = i + 1 < s_.size() ? std::min(s_[i] * ratio, t_.back()) : t_.back();
            while (k + 2 < Q_.size() && t_[k + 1] <= at) ++k;
            const double length = t_[k + 1] - t_[k];
            visit(i, interpolate(Q_[k], Q_[k + 1], length > 0.0 ? (at - t_[k]) / length : 1.0));
        }
    }

   private:
    const Polyline& Q_;
    std::vector<double> s_;
    std::vector<double> t_;
};

}  // namespace

void curve_length_residuals(const CurveView& P, const CurveView& Q, double* out,
                            const CurveLengthOptions& options) {
    const detail::RangeScale range = detail::check_pair(P, Q, {"curve_length", 2, true});
    const Polyline p = polyline(P, range);
    const Polyline q = polyline(Q, range);
    const Correspondence correspondence(p, q);
    const double scale_x = coordinate_scale(p, &Point::x, options.scale);
    const double scale_y = coordinate_scale(p, &Point::y, options.scale);
    const auto residual = [](double delta, double scale) {
        return std::log1p(std::abs(delta / scale));
    };
    correspondence.for_each([&](std::size_t i, const Point& point) {
        const Point delta = point - p[i];
        out[2 * i] = residual(delta.x, scale_x);
        out[2 * i + 1] = residual(delta.y, scale_y);
    });
}

double curve_length(const CurveView& P, const CurveView& Q, const CurveLengthOptions& options) {
    std::vector<double> residuals(
        static_cast<std::size_t>(2 * std::max<std::ptrdiff_t>(P.size(), 0)));
    curve_length_residuals(P, Q, residuals.data(), options);
    double sum = 0.0;
    for (const double r : residuals) sum += r * r;
    return std::sqrt(sum);
}

}  // namespace curvewise
