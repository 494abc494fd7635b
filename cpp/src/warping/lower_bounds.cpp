// LB_Keogh, LB_Improved and LB_Kim. Rounding is monotone, so no sum over the points of P, in their
// order, exceeds the table's. The boxes are exactly those of the band; those of an index
// (matched_values.hpp) may have a column more, where the curves differ in length.
#include "curvewise/lower_bounds.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "pairwise/evaluate.hpp"
#include "pairwise/measure.hpp"
#include "runtime/scratch.hpp"
#include "warping/band.hpp"
#include "warping/ground_distance.hpp"
#include "warping/packed_curve.hpp"
#include "warping/window.hpp"

namespace curvewise {
namespace {

using runtime::Poller;
using warping::Band;
using warping::PackedCurve;
using Numbers = runtime::ScratchVector<double>;

// The points of a curve, coordinate by coordinate; owned by another.
struct Points {
    explicit Points(const PackedCurve& curve) noexcept
        : data(curve.data()), stride(curve.stride()), size(curve.size()) {}
    Points(const Numbers& numbers, std::ptrdiff_t n) noexcept
        : data(numbers.data()), stride(n), size(n) {}
    double at(std::ptrdiff_t i, std::ptrdiff_t c) const noexcept { return data[c * stride + i]; }
    // The least and the greatest of a coordinate.
    std::pair<double, double> extremes(std::ptrdiff_t c) const noexcept {
        const double* const first = data + c * stride;
        const auto [low, high] = std::minmax_element(first, first + size);
        return {*low, *high};
    }

    const double* data;
    std::ptrdiff_t stride;
    std::ptrdiff_t size;
};

// The smallest box of a row's columns, one coordinate: blocks of 1, 2, 4, ... columns have their
// extremes in turn, and two blocks cover the columns of a row.
void move_into_boxes(const Points& P, const Points& Q, std::ptrdiff_t c, const Band& band,
                     double* to, Poller& poller) {
    const double* const p = P.data + c * P.stride;
    const double* const q = Q.data + c * Q.stride;
    Numbers lows(q, q + Q.size), highs(q, q + Q.size);
    std::ptrdiff_t left = P.size;  // rows
    for (std::ptrdiff_t block = 1; left > 0; block *= 2) {
        for (std::ptrdiff_t i = 0; i < P.size; ++i) {
            poller.poll_in_loop(static_cast<std::size_t>(i));
            const warping::ColumnRange columns = band.columns(i);
            const std::ptrdiff_t length = columns.last - columns.first + 1;
            if (length < block || length >= 2 * block) continue;
            const auto first = static_cast<std::size_t>(columns.first);
            const auto second = static_cast<std::size_t>(columns.last + 1 - block);
            const double low = std::min(lows[first], lows[second]);
            const double high = std::max(highs[first], highs[second]);
            to[i] = std::min(std::max(p[i], low), high);
            --left;
        }
        double* const low = lows.data();
        double* const high = highs.data();
        for (std::ptrdiff_t j = 0; j + 2 * block <= Q.size; ++j) {
            low[j] = std::min(low[j], low[j + block]);
            high[j] = std::max(high[j], high[j + block]);
        }
    }
}

// The points of P, each moved to the nearest of its box around points of Q.
Numbers moved(const Points& P, const Points& Q, std::ptrdiff_t dim, const warping::Window& window,
              Poller& poller) {
    const Band band(P.size, Q.size, window.between(P.size, Q.size));
    Numbers result(static_cast<std::size_t>(P.size * dim));
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        double* const to = result.data() + c * P.size;
        if (band.is_limited()) {
            move_into_boxes(P, Q, c, band, to, poller);
        } else {
            const auto [low, high] = Q.extremes(c);
            for (std::ptrdiff_t i = 0; i < P.size; ++i) {
                to[i] = std::min(std::max(P.at(i, c), low), high);
            }
        }
        poller.throw_if_stopped();
    }
    return result;
}

enum class Bound { keogh, improved, kim };

class LowerBound : public pairwise::LinearMeasure {
   public:
    using PreparedP = pairwise::UnpreparedCurve;
    using PreparedQ = pairwise::UnpreparedCurve;

    LowerBound(const LowerBoundOptions& options, Bound bound, const char* name)
        : window_{options.window, options.window_fraction}, bound_(bound), name_(name) {
        ground_.metric = options.metric;
        if (!warping::with_norm(options.metric, [](auto) { return true; })) {
            throw std::invalid_argument(
                std::string("metric is '") +
                choice_names(options.metric)[static_cast<std::size_t>(options.metric)] +
                "'; lower bounds need euclidean, sqeuclidean, cityblock or chebyshev");
        }
        if (bound != Bound::kim) window_.check();
    }

    curves::Requirements requirements() const noexcept { return {name_, 1, false}; }
    void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const {
        if (bound_ != Bound::kim) window_.check_sizes(n, m);
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        const std::ptrdiff_t dim = P.checked.curve.dim();
        check_dim(dim);
        const curves::RangeScale range =
            warping::range_of(ground_, std::max(P.checked.largest, Q.checked.largest));
        const auto packed = [&](const curves::CheckedCurve& checked) {
            return PackedCurve(checked.curve, range, warping::PointOrder::forward, call.poller);
        };
        const PackedCurve p = packed(P.checked), q = packed(Q.checked);
        const Metric metric = warping::canonical_metric(ground_, dim);
        const double bound = warping::with_norm(metric, [&](auto row) {
            using Row = decltype(row);
            return bound_ == Bound::kim ? kim<Row>(Points(p), Points(q), dim)
                                        : sum<Row>(Points(p), Points(q), dim, call.poller);
        });
        return range.restore(bound, warping::degree(ground_.metric));
    }

   private:
    void check_dim(std::ptrdiff_t dim) const {
        const bool adds_up =
            ground_.metric == Metric::sqeuclidean || ground_.metric == Metric::cityblock;
        if (bound_ != Bound::improved || dim == 1 || adds_up) return;
        throw std::invalid_argument(
            std::string("metric is '") +
            choice_names(ground_.metric)[static_cast<std::size_t>(ground_.metric)] +
            "'; lb_improved of " + std::to_string(dim) +
            " coordinates needs metric='sqeuclidean' or 'cityblock'; lb_keogh has the others");
    }

    template <class Row>
    static double distance(const Points& P, std::ptrdiff_t i, const Points& Q, std::ptrdiff_t j,
                           std::ptrdiff_t dim) noexcept {
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < dim; ++c) sum = Row::add(sum, P.at(i, c) - Q.at(j, c));
        return Row::finish(sum);
    }

    // In the order of the table, in which no partial sum exceeds a path's.
    template <class Row>
    static double outside(const Points& P, const Points& nearest, std::ptrdiff_t dim,
                          Poller& poller) {
        double sum = 0.0;
        for (std::ptrdiff_t i = 0; i < P.size; ++i) {
            poller.poll_in_loop(static_cast<std::size_t>(i));
            sum += distance<Row>(P, i, nearest, i, dim);
        }
        return sum;
    }

    template <class Row>
    double sum(const Points& P, const Points& Q, std::ptrdiff_t dim, Poller& poller) const {
        const Numbers numbers = moved(P, Q, dim, window_, poller);
        const Points nearest(numbers, P.size);
        const double there = outside<Row>(P, nearest, dim, poller);
        if (bound_ == Bound::keogh) return there;
        const Numbers back = moved(Q, nearest, dim, window_, poller);
        const double total = there + outside<Row>(Q, Points(back, Q.size), dim, poller);
        // Two sums in an order that is not the table's.
        const auto roundings = static_cast<double>(P.size + Q.size + dim + 16);
        return total * (1.0 - roundings * 0x1p-52);
    }

    template <class Row>
    static double kim(const Points& P, const Points& Q, std::ptrdiff_t dim) noexcept {
        double largest = std::max(distance<Row>(P, 0, Q, 0, dim),
                                  distance<Row>(P, P.size - 1, Q, Q.size - 1, dim));
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            const auto [p_low, p_high] = P.extremes(c);
            const auto [q_low, q_high] = Q.extremes(c);
            largest = std::max({largest, Row::finish(Row::add(0.0, p_low - q_low)),
                                Row::finish(Row::add(0.0, p_high - q_high))});
        }
        return largest;
    }

    GroundDistance ground_;
    warping::Window window_;
    Bound bound_;
    const char* name_;
};

}  // namespace

double lb_keogh(const CurveView& P, const CurveView& Q, const LowerBoundOptions& options,
                Control* control) {
    return pairwise::evaluate(LowerBound(options, Bound::keogh, "lb_keogh"), P, Q, control);
}

double lb_improved(const CurveView& P, const CurveView& Q, const LowerBoundOptions& options,
                   Control* control) {
    return pairwise::evaluate(LowerBound(options, Bound::improved, "lb_improved"), P, Q, control);
}

double lb_kim(const CurveView& P, const CurveView& Q, const LowerBoundOptions& options,
              Control* control) {
    return pairwise::evaluate(LowerBound(options, Bound::kim, "lb_kim"), P, Q, control);
}

}  // namespace curvewise
