// What the library asks of a ground distance: the rows of kernels/metrics.inl.hpp, for doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "curves/range_scale.hpp"
#include "curvewise/ground_distance.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

struct DoubleArithmetic {
    using Number = double;
    static double sum(double a, double b) noexcept { return a + b; }
    static double product(double a, double b) noexcept { return a * b; }
    static double larger(double a, double b) noexcept { return std::max(a, b); }
    static double absolute(double a) noexcept { return std::abs(a); }
};

struct DoubleRoot {
    static double of(double x) noexcept { return std::sqrt(x); }
};

#include "warping/kernels/metrics.inl.hpp"

template <class Use>
auto with_row(Metric metric, Use use) {
    return with_row<DoubleArithmetic, DoubleRoot>(metric, use);
}

// Calls use(norm) where distances of boxes bound those of points. Elsewhere returns an empty
// result: a bound of 0, which always holds, or no value.
template <class Use>
auto with_norm(Metric metric, Use use) {
    return with_row(metric, [&](auto row) {
        if constexpr (decltype(row)::is_norm) {
            return use(row);
        } else {
            return decltype(use(Cityblock<DoubleArithmetic>{}))();
        }
    });
}

// Whether with_norm() calls.
bool has_box_bounds(Metric metric) noexcept;

// Throws std::invalid_argument for an order of minkowski outside [1, inf].
void check_ground_distance(const GroundDistance& ground);

// Orders 1, 2 and inf of minkowski by their own names.
Metric named_metric(const GroundDistance& ground) noexcept;

// What to compute: |difference|, where it comes to that in one dimension, as cityblock.
Metric canonical_metric(const GroundDistance& ground, std::ptrdiff_t dim) noexcept;
kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept;

// Makes of a distance that is a root the one under it, for a table of largest distances, which a
// root at the end leaves as they are. Whether it is one.
bool put_off_root(kernels::Cost& cost) noexcept;

// By which power of a factor the distance grows when both curves do.
int degree(Metric metric) noexcept;

// The range in which curves of this largest magnitude are compared.
RangeScale range_of(const GroundDistance& ground, double largest_magnitude) noexcept;

}  // namespace curvewise::warping
