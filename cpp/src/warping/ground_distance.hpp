// What the library asks of a ground distance: the rows of kernels/metrics.inl.hpp, for doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "curves/checks.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/ground_distance.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

struct DoubleArithmetic {
    using Number = double;
    static double sum(double a, double b) noexcept { return a + b; }
    static double product(double a, double b) noexcept { return a * b; }
    static double difference(double a, double b) noexcept { return a - b; }
    static double larger(double a, double b) noexcept { return std::max(a, b); }
    static double smaller(double a, double b) noexcept { return std::min(a, b); }
    static double number(double x) noexcept { return x; }
    static double where_at_most(double a, double b, double yes, double no) noexcept {
        return a <= b ? yes : no;
    }
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

// What is kept of a caller's own distances at a time, or one row of the table: 16 MB.
inline constexpr std::ptrdiff_t max_own_distances = std::ptrdiff_t{1} << 21;

// The metric whose distances of boxes bound those of points: itself, or of an arc what is under it;
// then the kernels' arcs() make bounds of them.
Metric metric_of_boxes(Metric metric) noexcept;

// Whether with_norm() calls, of metric_of_boxes().
bool has_box_bounds(Metric metric) noexcept;

// Throws std::invalid_argument for an order of minkowski outside [1, inf].
void check_ground_distance(const GroundDistance& ground);

// Throws std::invalid_argument for a function of one's own, for what cannot compute with one.
void refuse_own_distances(const GroundDistance& ground);

// Orders 1, 2 and inf of minkowski by their own names.
Metric named_metric(const GroundDistance& ground) noexcept;

// What to compute: |difference|, where it comes to that in one dimension, as cityblock.
Metric canonical_metric(const GroundDistance& ground, std::ptrdiff_t dim) noexcept;
kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept;

// The root that is taken at the end, of a table of largest distances, which it leaves as they are;
// or none. Inline, since a call of few points takes most of its time for what is asked once.
class PutOffRoot {
   public:
    PutOffRoot() noexcept = default;
    PutOffRoot(Metric metric, double radius) noexcept : metric_(metric), radius_(radius) {}
    explicit operator bool() const noexcept { return metric_ != Metric::sqeuclidean; }
    double operator()(double value) const noexcept {
        if (!*this) return value;
        return metric_ == Metric::haversine ? arc(value) : std::sqrt(value);
    }
    // Of many, in place.
    void take(double* values, std::ptrdiff_t count) const noexcept;
    // A little more than what is under the root of a value, so that the rounding of squares and
    // roots gives nothing up.
    double most_under(double value) const noexcept;

   private:
    double arc(double square) const noexcept;

    Metric metric_ = Metric::sqeuclidean;  // its own root
    double radius_ = 0.0;
};

// Makes of a distance that is a root the one under it.
inline PutOffRoot put_off_root(kernels::Cost& cost, const GroundDistance& ground) noexcept {
    if (!with_row(cost.metric, [](auto row) { return decltype(row)::is_root; })) return {};
    const PutOffRoot root(cost.metric, ground.radius);
    cost.metric = Metric::sqeuclidean;
    return root;
}

// Coordinate c, as it is packed, of the point whose longitude and latitude both are x.
double coordinate_on_sphere(double x, std::ptrdiff_t c) noexcept;

// Of every curve of such a measure.
inline curves::Requirements requirements(const char* measure,
                                         const GroundDistance& ground) noexcept {
    return {measure, 1, false, ground.metric == Metric::haversine};
}

// By which power of a factor the distance grows when both curves do.
int degree(Metric metric) noexcept;

// The range in which curves of this largest magnitude are compared.
RangeScale range_of(const GroundDistance& ground, double largest_magnitude) noexcept;

// The cutoff of a sum for one of its quotient: a little more than the product, so that the rounding
// of the quotient gives nothing up: of one near 0, too, which is by the smallest double.
inline double undivided(double cutoff, double divisor) noexcept {
    if (divisor == 1.0) return cutoff;
    return (cutoff + std::numeric_limits<double>::denorm_min()) * (divisor * (1.0 + 1e-15));
}

}  // namespace curvewise::warping
