#include "warping/ground_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include "curves/sphere.hpp"

namespace curvewise::warping {
namespace {

[[noreturn]] void refuse(const char* option, double given, const char* need) {
    char number[32];
    std::snprintf(number, sizeof number, "%.17g", given);
    throw std::invalid_argument(std::string(option) + " is " + number + "; " + need);
}

}  // namespace

void check_ground_distance(const GroundDistance& ground) {
    if (ground.metric == Metric::minkowski && !(ground.p >= 1.0)) {
        refuse("p", ground.p, "minkowski needs 1 <= p <= inf");
    }
    if (ground.metric == Metric::haversine &&
        !(ground.radius > 0.0 && std::isfinite(ground.radius))) {
        refuse("radius", ground.radius, "give a finite number > 0");
    }
}

void refuse_own_distances(const GroundDistance& ground) {
    if (ground.own == nullptr) return;
    throw std::invalid_argument(
        "a ground distance of one's own is for dtw and frechet of one pair of curves, their paths, "
        "tables and infos; nothing else computes with it, or has bounds of it: choose a metric");
}

Metric metric_of_boxes(Metric metric) noexcept {
    const bool is_of_root = with_row(metric, [](auto row) {
        using Row = decltype(row);
        return Row::is_root && !Row::is_norm;
    });
    return is_of_root ? Metric::sqeuclidean : metric;
}

bool has_box_bounds(Metric metric) noexcept {
    return with_row(metric,
                    [](auto row) { return decltype(row)::is_norm || decltype(row)::is_root; });
}

Metric named_metric(const GroundDistance& ground) noexcept {
    if (ground.metric != Metric::minkowski) return ground.metric;
    if (ground.p == 1.0) return Metric::cityblock;
    if (ground.p == 2.0) return Metric::euclidean;
    return std::isinf(ground.p) ? Metric::chebyshev : Metric::minkowski;
}

Metric canonical_metric(const GroundDistance& ground, std::ptrdiff_t dim) noexcept {
    const bool is_absolute = dim == 1 && with_row(ground.metric, [](auto row) {
                                 return decltype(row)::is_absolute_in_one_dimension;
                             });
    return is_absolute ? Metric::cityblock : named_metric(ground);
}

kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept {
    return {canonical_metric(ground, curves.dim()), curves.squares_are_in_domain(),
            ground.own != nullptr};
}

double PutOffRoot::arc(double square) const noexcept {
    return Haversine<DoubleArithmetic, DoubleRoot>::finish(square, radius_);
}

void PutOffRoot::take(double* values, std::ptrdiff_t count) const noexcept {
    if (metric_ == Metric::haversine) {
        std::transform(values, values + count, values, [=](double x) { return arc(x); });
    } else if (*this) {
        std::transform(values, values + count, values, [](double x) { return std::sqrt(x); });
    }
}

double PutOffRoot::most_under(double value) const noexcept {
    constexpr double quarter_turn = 1.5707963267948966;
    if (!*this) return value;
    if (metric_ != Metric::haversine) return value * value * (1.0 + 1e-15);
    const double half = value / radius_ / 2.0;
    const double sine = std::sin(std::min(half, quarter_turn));
    return half < quarter_turn ? sine * sine * (1.0 + 1e-14)
                               : std::numeric_limits<double>::infinity();
}

double coordinate_on_sphere(double x, std::ptrdiff_t c) noexcept {
    return curves::on_sphere(x, x)[static_cast<std::size_t>(c)];
}

int degree(Metric metric) noexcept {
    return with_row(metric, [](auto row) { return decltype(row)::degree; });
}

RangeScale range_of(const GroundDistance& ground, double largest_magnitude) noexcept {
    const bool is_as_it_is = ground.own != nullptr || degree(ground.metric) == 0;
    return RangeScale(is_as_it_is ? 1.0 : largest_magnitude);
}

}  // namespace curvewise::warping
