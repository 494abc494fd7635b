// OF2 of Andrade-Campos et al. (2012): see the header for the formula.
#include "curvewise/curve_length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "curves/arc_gradient.hpp"
#include "curves/arc_length.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/gradient.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "runtime/scratch.hpp"

namespace curvewise {
namespace {

using curves::RangeScale;
using runtime::Poller;

using Pair = std::array<double, 2>;  // one number for x and one for y

// Not std::max, which takes references: gcc would then keep the running maximum in memory.
double larger(double a, double b) noexcept { return a < b ? b : a; }

// The largest |x| and |y|.
Pair largest_of_all(const CurveView& curve, Poller& poller) {
    Pair largest{std::abs(curve(0, 0)), std::abs(curve(0, 1))};
    const std::ptrdiff_t odd = curve.size() % 2;  // then the rest is pairs of points
    poller.in_runs(curve.size() / 2, 2, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        auto [x, y] = largest;  // two at a time; only one of them waits for those before
        for (std::ptrdiff_t i = odd + 2 * first; i < odd + 2 * end; i += 2) {
            x = larger(x, larger(std::abs(curve(i, 0)), std::abs(curve(i + 1, 0))));
            y = larger(y, larger(std::abs(curve(i, 1)), std::abs(curve(i + 1, 1))));
        }
        largest = {x, y};
    });
    return largest;
}

// The arc lengths after dividing each coordinate by the curve's own largest magnitude.
runtime::ScratchVector<double> relative_arc_lengths(const CurveView& curve, Pair largest,
                                                    Poller& poller) {
    for (double& value : largest) {
        if (value == 0.0) value = 1e-15;
    }
    using curves::EdgeBlock;
    return curves::summed_edges(curve.size(), poller, [&](std::ptrdiff_t first, EdgeBlock& edges) {
        std::array<double, EdgeBlock::size + 1> x, y;
        for (std::size_t k = 0; k <= edges.count; ++k) {
            const std::ptrdiff_t i = first + static_cast<std::ptrdiff_t>(k);
            x[k] = curve(i, 0);
            y[k] = curve(i, 1);
        }
        for (std::size_t k = 0; k <= edges.count; ++k) x[k] /= largest[0];
        for (std::size_t k = 0; k <= edges.count; ++k) y[k] /= largest[1];
        for (std::size_t k = 0; k < edges.count; ++k) edges.x[k] = x[k + 1] - x[k];
        for (std::size_t k = 0; k < edges.count; ++k) edges.y[k] = y[k + 1] - y[k];
    });
}

// For each point of P, at arc length s, calls visit(i, segment, fraction) for the place on Q at the
// same fraction of its length.
template <class Visit>
void for_each_place(const runtime::ScratchVector<double>& s,
                    const runtime::ScratchVector<double>& t, Poller& poller, Visit visit) {
    const double ratio = t.back() / s.back();
    curves::ArcPosition position(t);
    for (std::size_t i = 0; i < s.size(); ++i) {
        poller.poll_in_loop(i);
        position.move_to(i + 1 < s.size() ? s[i] * ratio : t.back());
        visit(static_cast<std::ptrdiff_t>(i), static_cast<std::ptrdiff_t>(position.segment()),
              position.fraction());
    }
}

// One coordinate of both curves, in its own range. A quotient has no units, so no value must be
// scaled back.
class Coordinate {
   public:
    Coordinate(const CurveView& P, const CurveView& Q, std::ptrdiff_t c, double largest_p,
               double largest_q) noexcept
        : P_(P),
          Q_(Q),
          c_(c),
          range_(RangeScale(std::max(largest_p, largest_q)).is_identity()
                     ? RangeScale(1.0)
                     : RangeScale::to_unity(largest_p)),
          largest_(range_.shrink(largest_p)) {}

    const char* name() const noexcept { return c_ == 0 ? "x" : "y"; }
    std::ptrdiff_t size() const noexcept { return P_.size(); }
    double p(std::ptrdiff_t i) const noexcept { return range_.shrink(P_(i, c_)); }
    double q(std::ptrdiff_t j) const noexcept { return range_.shrink(Q_(j, c_)); }
    // The largest |p|.
    double largest() const noexcept { return largest_; }
    const RangeScale& range() const noexcept { return range_; }

    // From P's point i to the place on segment k of Q.
    double difference(std::ptrdiff_t i, std::ptrdiff_t k, double fraction) const noexcept {
        const double a = q(k), b = q(k + 1);
        return (fraction == 1.0 ? b : a + fraction * (b - a)) - p(i);
    }

   private:
    CurveView P_;
    CurveView Q_;
    std::ptrdiff_t c_;
    RangeScale range_;
    double largest_;
};

// Throws where differences in one coordinate cannot be divided by its scale.
void refuse_nothing_to_divide_by(const Coordinate& x, LengthScale scale, double value,
                                 const std::string& what) {
    const char* const name = x.name();
    if (scale == LengthScale::mean) {
        const double rounding =
            static_cast<double>(x.size()) * std::numeric_limits<double>::epsilon();
        if (std::abs(value) > rounding * x.largest()) return;
        throw std::invalid_argument("the mean of " + what + "'s " + name +
                                    " is 0 to rounding; use scale='mean_abs' or scale='range'");
    }
    if (x.largest() == 0.0) {
        throw std::invalid_argument(
            what + "'s " + name + " is 0 throughout, which leaves nothing to divide by; " +
            "add the same constant to " + name + " of both curves and use scale='mean_abs'");
    }
    if (scale == LengthScale::mean_abs || value > 0.0) return;
    throw std::invalid_argument("the range of " + what + "'s " + name +
                                " is 0; use scale='mean' or scale='mean_abs'");
}

// The sums of value(p) over P's points.
template <class Value>
Pair sums_over(const Coordinate& x, const Coordinate& y, Poller& poller, Value value) {
    Pair sums{};
    poller.in_runs(x.size(), 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        auto [of_x, of_y] = sums;  // in registers, in the loop
        for (std::ptrdiff_t i = first; i < end; ++i) {
            of_x += value(x.p(i));
            of_y += value(y.p(i));
        }
        sums = {of_x, of_y};
    });
    return sums;
}

// The largest p less the least.
double range_of(const Coordinate& x, Poller& poller) {
    double low = x.p(0), high = low;
    for (std::ptrdiff_t i = 0; i < x.size(); ++i) {
        poller.poll_in_loop(static_cast<std::size_t>(i));
        low = std::min(low, x.p(i));
        high = std::max(high, x.p(i));
    }
    return high - low;
}

// What differences in x and in y are divided by; `what` names P.
Pair scales(const Coordinate& x, const Coordinate& y, LengthScale scale, const std::string& what,
            Poller& poller) {
    const auto n = static_cast<double>(x.size());
    Pair values{};
    if (scale == LengthScale::range) {
        values = {range_of(x, poller), range_of(y, poller)};
    } else {
        const auto [of_x, of_y] =
            scale == LengthScale::mean
                ? sums_over(x, y, poller, [](double p) { return p; })
                : sums_over(x, y, poller, [](double p) { return std::abs(p); });
        values = {of_x / n, of_y / n};
    }
    refuse_nothing_to_divide_by(x, scale, values[0], what);
    refuse_nothing_to_divide_by(y, scale, values[1], what);
    return values;
}

// The first of the points whose coordinate has the largest magnitude.
std::ptrdiff_t largest_of(const CurveView& curve, std::ptrdiff_t c) noexcept {
    std::ptrdiff_t largest = 0;
    for (std::ptrdiff_t i = 1; i < curve.size(); ++i) {
        if (std::abs(curve(i, c)) > std::abs(curve(largest, c))) largest = i;
    }
    return largest;
}

// Adds the derivatives by a curve's points that its arc lengths hand on, which are taken after
// dividing by its largest |x| and |y|: these move too.
void add_arc_gradient(const CurveView& curve, const curves::ArcGradient& by_arc, double* gradient) {
    for (std::ptrdiff_t c = 0; c < 2; ++c) {
        const std::ptrdiff_t largest = largest_of(curve, c);
        const double divisor = curve(largest, c);
        if (divisor == 0.0) continue;
        by_arc.for_each_segment([&](std::size_t segment, double length, double by_length) {
            const auto k = static_cast<std::ptrdiff_t>(segment);
            const double step = (curve(k, c) - curve(k - 1, c)) / std::abs(divisor);
            const double slope = by_length * step / length / std::abs(divisor);
            gradient[2 * k + c] += slope;
            gradient[2 * (k - 1) + c] -= slope;
            gradient[2 * largest + c] -= slope * step * std::copysign(1.0, divisor);
        });
    }
}

// Adds the derivatives by P's coordinate that its scale (see coordinate_scale) hands on.
void add_scale_gradient(const Coordinate& x, LengthScale scale, double by_scale, double* gradient) {
    const double share = by_scale / static_cast<double>(x.size());
    std::ptrdiff_t low = 0, high = 0;
    for (std::ptrdiff_t i = 0; i < x.size(); ++i) {
        if (x.p(i) < x.p(low)) low = i;
        if (x.p(i) > x.p(high)) high = i;
        if (scale == LengthScale::range) continue;
        const bool falls = scale == LengthScale::mean_abs && x.p(i) < 0.0;
        gradient[2 * i] += x.range().shrink(falls ? -share : share);
    }
    if (scale != LengthScale::range) return;
    gradient[2 * high] += x.range().shrink(by_scale);
    gradient[2 * low] -= x.range().shrink(by_scale);
}

// Differences that are divided side by side: two quotients take little longer than one.
struct DifferenceBlock {
    static constexpr std::size_t size = 16;

    std::array<double, size> x, y;
    std::size_t count = 0;

    void add(double in_x, double in_y) noexcept {
        x[count] = in_x;
        y[count++] = in_y;
    }
    void divide_by(const Pair& scales) noexcept {
        for (std::size_t k = 0; k < count; ++k) x[k] /= scales[0];
        for (std::size_t k = 0; k < count; ++k) y[k] /= scales[1];
    }
};

class CurveLengthMeasure : public pairwise::LinearMeasure {
   public:
    struct Side {
        Side(const curves::CheckedCurve& curve, Poller& poller)
            : checked(curve),
              largest(largest_of_all(curve.curve, poller)),
              arc_lengths(relative_arc_lengths(curve.curve, largest, poller)) {
            curves::check_length(curve.curve, curve.name, CurveLengthOptions::measure, poller);
        }
        curves::CheckedCurve checked;
        Pair largest;                                // |x| and |y|
        runtime::ScratchVector<double> arc_lengths;  // after dividing by its largest |x| and |y|
    };
    using PreparedP = Side;
    using PreparedQ = Side;

    explicit CurveLengthMeasure(const CurveLengthOptions& options) : options_(options) {}
    static curves::Requirements requirements() noexcept {
        return {CurveLengthOptions::measure, 2, true};
    }

    // Throws where there is nothing to divide by.
    static constexpr bool checks_p = true;
    void check_p(const PreparedP& P, Poller& poller) const { scales_of(P, P, poller); }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        double sum = 0.0;
        for_each_residual(P, Q, call.poller, [&](double x, double y) {
            sum += x * x;
            sum += y * y;
        });
        return std::sqrt(sum);
    }

    void residuals(const PreparedP& P, const PreparedQ& Q, double* out,
                   const pairwise::Call<Memory>& call) const {
        for_each_residual(P, Q, call.poller, [&](double x, double y) {
            *out++ = x;
            *out++ = y;
        });
    }

    // The value, and the requested derivatives.
    double with_gradients(const PreparedP& P, const PreparedQ& Q, const Gradients& out,
                          const pairwise::Call<Memory>& call) const {
        const double value = (*this)(P, Q, call);
        if (out.by_p != nullptr) std::fill_n(out.by_p, 2 * P.checked.curve.size(), 0.0);
        if (out.by_q != nullptr) std::fill_n(out.by_q, 2 * Q.checked.curve.size(), 0.0);
        if (value != 0.0) add_gradients(P, Q, value, out, call);
        return value;
    }

   private:
    void add_gradients(const PreparedP& P, const PreparedQ& Q, double value, const Gradients& out,
                       const pairwise::Call<Memory>& call) const {
        const double length = P.arc_lengths.back();
        std::optional<curves::ArcGradient> by_arc, by_own_arc;
        if (out.by_q != nullptr) by_arc.emplace(Q.arc_lengths);
        if (out.by_p != nullptr) by_own_arc.emplace(P.arc_lengths);
        const Pair by = scales_of(P, Q, call.poller);
        for (std::ptrdiff_t c = 0; c < 2; ++c) {
            const Coordinate x = coordinate(P, Q, c);
            const double scale = by[static_cast<std::size_t>(c)];
            double by_scale = 0.0;
            const auto add = [&](std::ptrdiff_t i, std::ptrdiff_t k, double fraction) {
                const double edge = x.q(k + 1) - x.q(k);
                const double relative = (x.q(k) + fraction * edge - x.p(i)) / std::abs(scale);
                const double residual = std::log1p(std::abs(relative));
                const double slope = std::copysign(residual, relative) / value /
                                     (1.0 + std::abs(relative)) / std::abs(scale);
                const double share = P.arc_lengths[static_cast<std::size_t>(i)] / length;
                if (by_arc) {
                    out.by_q[2 * k + c] += x.range().shrink((1.0 - fraction) * slope);
                    out.by_q[2 * k + c + 2] += x.range().shrink(fraction * slope);
                    by_arc->add(static_cast<std::size_t>(k), fraction, share, slope * edge);
                }
                if (by_own_arc) {
                    out.by_p[2 * i + c] -= x.range().shrink(slope);
                    by_scale -= slope * relative * std::copysign(1.0, scale);
                    by_own_arc->add_share(static_cast<std::size_t>(i), share,
                                          slope * edge * places_per_share(Q.arc_lengths, k));
                }
            };
            for_each_place(P.arc_lengths, Q.arc_lengths, call.poller, add);
            if (by_own_arc) add_scale_gradient(x, options_.scale, by_scale, out.by_p + c);
        }
        if (by_arc) add_arc_gradient(Q.checked.curve, *by_arc, out.by_q);
        if (by_own_arc) add_arc_gradient(P.checked.curve, *by_own_arc, out.by_p);
    }

    // How fast a place moves along segment k as its share of the length grows.
    static double places_per_share(const runtime::ScratchVector<double>& arc_lengths,
                                   std::ptrdiff_t segment) noexcept {
        const auto k = static_cast<std::size_t>(segment);
        const double length = arc_lengths[k + 1] - arc_lengths[k];
        return length > 0.0 ? arc_lengths.back() / length : 0.0;
    }

    static Coordinate coordinate(const Side& P, const Side& Q, std::ptrdiff_t c) noexcept {
        const auto at = static_cast<std::size_t>(c);
        return {P.checked.curve, Q.checked.curve, c, P.largest[at], Q.largest[at]};
    }

    Pair scales_of(const Side& P, const Side& Q, Poller& poller) const {
        return scales(coordinate(P, Q, 0), coordinate(P, Q, 1), options_.scale, P.checked.name,
                      poller);
    }

    // Calls visit(x, y) for one point of P after the other.
    template <class Visit>
    void for_each_residual(const PreparedP& P, const PreparedQ& Q, Poller& poller,
                           Visit visit) const {
        const Coordinate x = coordinate(P, Q, 0), y = coordinate(P, Q, 1);
        const Pair by = scales_of(P, Q, poller);
        DifferenceBlock differences;
        const auto visit_all = [&] {
            differences.divide_by(by);
            for (std::size_t k = 0; k < differences.count; ++k) {
                visit(residual(differences.x[k]), residual(differences.y[k]));
            }
            differences.count = 0;
        };
        for_each_place(P.arc_lengths, Q.arc_lengths, poller,
                       [&](std::ptrdiff_t i, std::ptrdiff_t k, double fraction) {
                           differences.add(x.difference(i, k, fraction),
                                           y.difference(i, k, fraction));
                           if (differences.count == DifferenceBlock::size) visit_all();
                       });
        visit_all();
    }

    // inf - inf is infinitely far, too.
    static double residual(double relative) noexcept {
        return std::log1p(std::isnan(relative) ? std::numeric_limits<double>::infinity()
                                               : std::abs(relative));
    }

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

double value_and_gradients(const CurveLengthOptions& options, const CurveView& P,
                           const CurveView& Q, const Gradients& out, Control* control) {
    const CurveLengthMeasure measure(options);
    return pairwise::with_pair(measure, P, Q, control,
                               [&](const auto& p, const auto& q, const auto& call) {
                                   return measure.with_gradients(p, q, out, call);
                               });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(
    const CurveLengthOptions& options) {
    return std::make_unique<BatchOf<CurveLengthMeasure>>(CurveLengthMeasure(options));
}

}  // namespace curvewise
