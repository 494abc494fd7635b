#include "warping/ground_distance.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace curvewise::warping {

void check_ground_distance(const GroundDistance& ground) {
    if (ground.metric == Metric::minkowski && !(ground.p >= 1.0)) {
        char p[32];
        std::snprintf(p, sizeof p, "%.17g", ground.p);
        throw std::invalid_argument("p is " + std::string(p) + "; minkowski needs 1 <= p <= inf");
    }
}

bool has_box_bounds(Metric metric) noexcept {
    return with_row(metric, [](auto row) { return decltype(row)::is_norm; });
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
    return {canonical_metric(ground, curves.dim()), curves.squares_are_in_domain()};
}

bool put_off_root(kernels::Cost& cost) noexcept {
    const bool is_root = with_row(cost.metric, [](auto row) { return decltype(row)::is_root; });
    if (is_root) cost.metric = Metric::sqeuclidean;
    return is_root;
}

int degree(Metric metric) noexcept {
    return with_row(metric, [](auto row) { return decltype(row)::degree; });
}

RangeScale range_of(const GroundDistance& ground, double largest_magnitude) noexcept {
    return RangeScale(degree(ground.metric) == 0 ? 1.0 : largest_magnitude);
}

}  // namespace curvewise::warping
