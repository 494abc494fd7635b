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

// Calls use(norm) if distances of boxes bound those of points. Otherwise returns an empty result: a
// bound of 0, which always holds, or no value.
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

// The number of a caller's own distances to keep at a time, 16 MB, or one row of the table.
inline constexpr std::ptrdiff_t max_own_distances = std::ptrdiff_t{1} << 21;

// The metric whose distances of boxes bound those of points: the metric itself, or for an arc the
// metric inside the arc function. The kernels' arcs() then turn these into bounds.
Metric metric_of_boxes(Metric metric) noexcept;

// Whether points are longitudes and latitudes.
inline bool takes_degrees(Metric metric) noexcept {
    return with_row(metric, [](auto row) { return decltype(row)::takes_degrees; });
}

// Whether with_norm() calls, of metric_of_boxes().
bool has_box_bounds(Metric metric) noexcept;

// Throws std::invalid_argument for an order of minkowski outside [1, inf].
void check_ground_distance(const GroundDistance& ground);

// Throws std::invalid_argument for a custom function, in computations that do not take one.
void refuse_own_distances(const GroundDistance& ground);

// Orders 1, 2 and inf of minkowski by their own names.
Metric named_metric(const GroundDistance& ground) noexcept;

// What to compute: |difference|, where it comes to that in one dimension, as cityblock.
Metric canonical_metric(const GroundDistance& ground, std::ptrdiff_t dim) noexcept;
kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept;

// The root that is taken once at the end of a table of largest distances, if the metric has one.
// Inline, because a call of few points spends most of its time on such single checks.
class PutOffRoot {
   public:
    PutOffRoot() noexcept = default;
    PutOffRoot(Metric metric, double radius) noexcept : metric_(metric), radius_(radius) {}
    explicit operator bool() const noexcept { return metric_ != Metric::sqeuclidean; }
    double operator()(double value) const noexcept {
        if (!*this) return value;
        return metric_ == Metric::haversine ? arc(value) : std::sqrt(value);
    }
    // Applies the root to many values, in place.
    void take(double* values, std::ptrdiff_t count) const noexcept;
    // A little more than the radicand of a value, so that the rounding of squares and roots loses
    // nothing.
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

// Packed coordinate c of the point whose longitude and latitude both are x.
double coordinate_on_sphere(double x, std::ptrdiff_t c) noexcept;

// The requirements on every curve of such a measure.
inline curves::Requirements requirements(const char* measure,
                                         const GroundDistance& ground) noexcept {
    return {measure, 1, false, takes_degrees(ground.metric)};
}

// If both curves are multiplied by a factor, the distance is multiplied by this power of the
// factor.
int degree(Metric metric) noexcept;

// The range in which curves of this largest magnitude are compared.
RangeScale range_of(const GroundDistance& ground, double largest_magnitude) noexcept;

// The cutoff of a sum for a cutoff of its quotient. It is a little more than the product, so that
// the rounding of the quotient loses nothing. For quotients near 0, it is larger by the smallest
// double.
inline double undivided(double cutoff, double divisor) noexcept {
    if (divisor == 1.0) return cutoff;
    return (cutoff + std::numeric_limits<double>::denorm_min()) * (divisor * (1.0 + 1e-15));
}

}  // namespace curvewise::warping
