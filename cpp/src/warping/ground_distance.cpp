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

Metric canonical_metric(const GroundDistance& ground, std::ptrdiff_t dim) noexcept {
    if (dim == 1 && ground.metric != Metric::sqeuclidean) return Metric::cityblock;
    if (ground.metric != Metric::minkowski) return ground.metric;
    if (ground.p == 1.0) return Metric::cityblock;
    if (ground.p == 2.0) return Metric::euclidean;
    return std::isinf(ground.p) ? Metric::chebyshev : Metric::minkowski;
}

kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept {
    return {canonical_metric(ground, curves.dim()), curves.squares_are_in_domain()};
}

int degree(Metric metric) noexcept { return metric == Metric::sqeuclidean ? 2 : 1; }

}  // namespace curvewise::warping
