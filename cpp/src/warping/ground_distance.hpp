// What the sweep must know of a ground distance.
#pragma once

#include "curvewise/ground_distance.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

// Throws std::invalid_argument for an order of minkowski outside [1, inf].
void check_ground_distance(const GroundDistance& ground);

// What to compute: orders 1, 2 and inf of minkowski by their own names, and everything except
// sqeuclidean as |difference| in one dimension.
Metric canonical_metric(const GroundDistance& ground, std::ptrdiff_t dim) noexcept;
kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept;

// By which power of a factor the distance grows when both curves do.
int degree(Metric metric) noexcept;

}  // namespace curvewise::warping
