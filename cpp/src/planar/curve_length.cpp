// OF2 of Andrade-Campos et al. (2012): see the header for the formula.
#include "curvewise/curve_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "curves/arc_gradient.hpp"
#include "curves/arc_length.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/gradient.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"

namespace curvewise {
namespace {

using curves::Polyline;
using curves::RangeScale;
using runtime::Poller;

// The arc lengths after dividing each coordinate by the curve's own largest magnitude.
std::vector<double> relative_arc_lengths(const CurveView& curve, Poller& poller) {
    double largest[2] = {0.0, 0.0};
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        poller.poll_in_loop(static_cast<std::size_t>(i));
        largest[0] = std::max(largest[0], std::abs(curve(i, 0)));
        largest[1] = std::max(largest[1], std::abs(curve(i, 1)));
    }
    for (double& value : largest) {
        if (value == 0.0) value = 1e-15;
    }
    Polyline scaled;
    scaled.reserve(static_cast<std::size_t>(curve.size()));
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        poller.poll_in_loop(static_cast<std::size_t>(i));
        scaled.push_back({curve(i, 0) / largest[0], curve(i, 1) / largest[1]});
    }
    return curves::arc_lengths(scaled, poller);
}

// A place on a curve: a segment and a fraction of it.
struct Place {
    std::size_t segment;
    double fraction;
};

// For each point of P, at arc length s, the place on Q at the same fraction of its length.
std::vector<Place> corresponding_places(const std::vector<double>& s, const std::vector<double>& t,
                                        Poller& poller) {
    const double ratio = t.back() / s.back();
    std::vector<Place> places;
    places.reserve(s.size());
    curves::ArcPosition position(t);
    for (std::size_t i = 0; i < s.size(); ++i) {
        poller.poll_in_loop(i);
        position.move_to(i + 1 < s.size() ? s[i] * ratio : t.back());
        places.push_back({position.segment(), position.fraction()});
    }
    return places;
}

// One coordinate of both curves, in a range of its own: a quotient has no units, so nothing needs
// to be scaled back.
struct Coordinate {
    std::vector<double> p;
    std::vector<double> q;
    const char* name;
    RangeScale range = RangeScale(1.0);

    Coordinate(const CurveView& P, const CurveView& Q, std::ptrdiff_t c, Poller& poller)
        : p(values(P, c, poller)), q(values(Q, c, poller)), name(c == 0 ? "x" : "y") {
        const double largest = largest_magnitude(p);
        if (RangeScale(std::max(largest, largest_magnitude(q))).is_identity()) return;
        range = RangeScale::to_unity(largest);
        for (double& value : p) value = range.shrink(value);
        for (double& value : q) value = range.shrink(value);
    }

    static std::vector<double> values(const CurveView& curve, std::ptrdiff_t c, Poller& poller) {
        std::vector<double> result;
        result.reserve(static_cast<std::size_t>(curve.size()));
        for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
            poller.poll_in_loop(result.size());
            result.push_back(curve(i, c));
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
double coordinate_scale(const Coordinate& x, LengthScale scale, const std::string& what,
                        Poller& poller) {
    const auto n = static_cast<double>(x.p.size());
    double low = x.p.front(), high = low, sum = 0.0, sum_abs = 0.0;
    for (std::size_t i = 0; i < x.p.size(); ++i) {
        poller.poll_in_loop(i);
        const double value = x.p[i];
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
                     double* out, Poller& poller) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        poller.poll_in_loop(i);
        const double a = x.q[places[i].segment];
        const double b = x.q[places[i].segment + 1];
        const double at = places[i].fraction == 1.0 ? b : a + places[i].fraction * (b - a);
        const double relative = std::abs((at - x.p[i]) / divisor);
        out[2 * i] =
            std::log1p(std::isnan(relative) ? std::numeric_limits<double>::infinity() : relative);
    }
}

// The first of the points whose coordinate has the largest magnitude.
std::ptrdiff_t largest_of(const CurveView& curve, std::ptrdiff_t c) noexcept {
    std::ptrdiff_t largest = 0;
    for (std::ptrdiff_t i = 1; i < curve.size(); ++i) {
        if (std::abs(curve(i, c)) > std::abs(curve(largest, c))) largest = i;
    }
    return largest;
}

// Adds the derivatives by Q's points that its arc lengths hand on, which are taken after dividing
// by its largest |x| and |y|: these move too.
void add_arc_gradient(const CurveView& Q, const curves::ArcGradient& by_arc, double* gradient) {
    for (std::ptrdiff_t c = 0; c < 2; ++c) {
        const std::ptrdiff_t largest = largest_of(Q, c);
        const double divisor = Q(largest, c);
        if (divisor == 0.0) continue;
        by_arc.for_each_segment([&](std::size_t segment, double length, double by_length) {
            const auto k = static_cast<std::ptrdiff_t>(segment);
            const double step = (Q(k, c) - Q(k - 1, c)) / std::abs(divisor);
            const double slope = by_length * step / length / std::abs(divisor);
            gradient[2 * k + c] += slope;
            gradient[2 * (k - 1) + c] -= slope;
            gradient[2 * largest + c] -= slope * step * std::copysign(1.0, divisor);
        });
    }
}

class CurveLengthMeasure : public pairwise::LinearMeasure {
   public:
    struct Side {
        Side(const curves::CheckedCurve& curve, Poller& poller)
            : checked(curve), arc_lengths(relative_arc_lengths(curve.curve, poller)) {
            curves::check_length(curve.curve, curve.name, CurveLengthOptions::measure, poller);
        }
        curves::CheckedCurve checked;
        std::vector<double> arc_lengths;  // after dividing by its largest |x| and |y|
    };
    using PreparedP = Side;
    using PreparedQ = Side;

    explicit CurveLengthMeasure(const CurveLengthOptions& options) : options_(options) {}
    static curves::Requirements requirements() noexcept {
        return {CurveLengthOptions::measure, 2, true};
    }

    // Throws where there is nothing to divide by.
    void check_p(const PreparedP& P, Poller& poller) const {
        for (std::ptrdiff_t c = 0; c < 2; ++c) {
            const Coordinate x(P.checked.curve, P.checked.curve, c, poller);
            coordinate_scale(x, options_.scale, P.checked.name, poller);
        }
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        std::vector<double> all(2 * P.arc_lengths.size());
        residuals(P, Q, all.data(), call);
        double sum = 0.0;
        call.poller.in_runs(static_cast<std::ptrdiff_t>(all.size()), 1, [&](auto first, auto end) {
            for (auto i = first; i < end; ++i) {
                const double r = all[static_cast<std::size_t>(i)];
                sum += r * r;
            }
        });
        return std::sqrt(sum);
    }

    void residuals(const PreparedP& P, const PreparedQ& Q, double* out,
                   const pairwise::Call<Memory>& call) const {
        const std::vector<Place> places =
            corresponding_places(P.arc_lengths, Q.arc_lengths, call.poller);
        for (std::ptrdiff_t c = 0; c < 2; ++c) {
            const Coordinate x(P.checked.curve, Q.checked.curve, c, call.poller);
            const double scale = coordinate_scale(x, options_.scale, P.checked.name, call.poller);
            write_residuals(x, places, scale, out + c, call.poller);
        }
    }

    // The value, and its derivative by Q.
    double with_gradient(const PreparedP& P, const PreparedQ& Q, double* gradient,
                         const pairwise::Call<Memory>& call) const {
        const double value = (*this)(P, Q, call);
        const CurveView& q = Q.checked.curve;
        std::fill_n(gradient, static_cast<std::size_t>(2 * q.size()), 0.0);
        if (value == 0.0) return value;
        const std::vector<Place> places =
            corresponding_places(P.arc_lengths, Q.arc_lengths, call.poller);
        curves::ArcGradient by_arc(Q.arc_lengths);
        for (std::ptrdiff_t c = 0; c < 2; ++c) {
            const Coordinate x(P.checked.curve, q, c, call.poller);
            const double scale = coordinate_scale(x, options_.scale, P.checked.name, call.poller);
            for (std::size_t i = 0; i < places.size(); ++i) {
                call.poller.poll_in_loop(i);
                const auto [k, fraction] = places[i];
                const double edge = x.q[k + 1] - x.q[k];
                const double relative = (x.q[k] + fraction * edge - x.p[i]) / std::abs(scale);
                const double residual = std::log1p(std::abs(relative));
                const double slope = std::copysign(residual, relative) / value /
                                     (1.0 + std::abs(relative)) / std::abs(scale);
                const std::ptrdiff_t at = 2 * static_cast<std::ptrdiff_t>(k) + c;
                gradient[at] += x.range.shrink((1.0 - fraction) * slope);
                gradient[at + 2] += x.range.shrink(fraction * slope);
                by_arc.add(k, fraction, P.arc_lengths[i] / P.arc_lengths.back(), slope * edge);
            }
        }
        add_arc_gradient(q, by_arc, gradient);
        return value;
    }

   private:
    CurveLengthOptions options_;
};

}  // namespace

double curve_length(const CurveView& P, const CurveView& Q, const CurveLengthOptions& options,
                    Control* control) {
    return pairwise::evaluate(CurveLengthMeasure(options), P, Q, control);
}

void curve_length_residuals(const CurveView& P, const CurveView& Q, double* out,
                            const CurveLengthOptions& options, Control* control) {
    const CurveLengthMeasure measure(options);
    pairwise::with_pair(measure, P, Q, control,
                        [&](const auto& p, const auto& q, const auto& call) {
                            measure.residuals(p, q, out, call);
                        });
}

double value_and_gradient(const CurveLengthOptions& options, const CurveView& P, const CurveView& Q,
                          double* gradient, Control* control) {
    const CurveLengthMeasure measure(options);
    return pairwise::with_pair(measure, P, Q, control,
                               [&](const auto& p, const auto& q, const auto& call) {
                                   return measure.with_gradient(p, q, gradient, call);
                               });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(
    const CurveLengthOptions& options) {
    return std::make_unique<BatchOf<CurveLengthMeasure>>(CurveLengthMeasure(options));
}

}  // namespace curvewise
