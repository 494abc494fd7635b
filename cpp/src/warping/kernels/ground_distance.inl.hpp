// Ground distances of one diagonal, a SIMD vector of lanes at a time. Differences are squared and
// added in coordinate order, never fused, and sqrt is correctly rounded, so that the numpy
// reference gives the same bits. Included by the kernel of each level, inside its
// anonymous namespace.

#include "square_root.inl.hpp"

struct PackArithmetic {
    using Number = Pack;
    static Pack sum(const Pack& a, const Pack& b) noexcept { return simd::padd(a, b); }
    static Pack product(const Pack& a, const Pack& b) noexcept { return simd::pmul(a, b); }
    static Pack difference(const Pack& a, const Pack& b) noexcept { return simd::psub(a, b); }
    static Pack larger(const Pack& a, const Pack& b) noexcept { return simd::pmax(a, b); }
    static Pack smaller(const Pack& a, const Pack& b) noexcept { return simd::pmin(a, b); }
    static Pack absolute(const Pack& a) noexcept { return simd::pabs(a); }
    static Pack number(double x) noexcept { return simd::pset1<Pack>(x); }
    static Pack where_at_most(const Pack& a, const Pack& b, const Pack& yes,
                              const Pack& no) noexcept {
        return simd::pselect(simd::pcmp_le(a, b), yes, no);
    }
};

#include "metrics.inl.hpp"

// Sum of squared differences in a number of dimensions known at compile time.
template <int dim>
struct SquaredCost {
    const double* p[dim];
    const double* q[dim];

    explicit SquaredCost(const Strip& strip) noexcept {
        for (int c = 0; c < dim; ++c) {
            p[c] = strip.p + c * strip.p_stride;
            q[c] = strip.q + c * strip.q_stride + strip.columns - 1;
        }
    }
    void prepare(const Strip&, std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t,
                 CostFunction) const noexcept {}
    Pack at(std::ptrdiff_t t, std::ptrdiff_t k) const noexcept {
        Pack sum = square(t, k, 0);
        for (int c = 1; c < dim; ++c) sum = simd::padd(sum, square(t, k, c));
        return sum;
    }

    Pack difference(std::ptrdiff_t t, std::ptrdiff_t k, int c) const noexcept {
        return simd::psub(load(p[c] + k), load(q[c] - t + k));
    }

   private:
    Pack square(std::ptrdiff_t t, std::ptrdiff_t k, int c) const noexcept {
        const Pack delta = difference(t, k, c);
        return simd::pmul(delta, delta);
    }
};

template <int dim, class Root>
struct EuclideanCost : SquaredCost<dim> {
    using SquaredCost<dim>::SquaredCost;
    Pack at(std::ptrdiff_t t, std::ptrdiff_t k) const noexcept {
        return Root::of(SquaredCost<dim>::at(t, k));
    }
};

// Uses both kinds of root (see each_mixed_root) in the plane. In space, loads are the limit, and
// mixed roots lose more than they gain. With fewer rows than this, the gain is at most a few per
// cent. If the fast root is as good as the divider, the gain starts with fewer rows.
constexpr std::ptrdiff_t min_rows_of_mixed_roots = multiplies_roots ? 32 : 112;

struct MixedEuclideanCost : SquaredCost<2> {
    using SquaredCost<2>::SquaredCost;
};

// Calls use(k, distances) of the vectors of lanes low to high of diagonal t, in any order.
template <class GroundCost, class Use>
void each_distance(const GroundCost& cost, std::ptrdiff_t t, std::ptrdiff_t low,
                   std::ptrdiff_t high, const Use& use) noexcept {
    for (std::ptrdiff_t k = low; k <= high; k += width) use(k, cost.at(t, k));
}
template <class Use>
void each_distance(const MixedEuclideanCost& cost, std::ptrdiff_t t, std::ptrdiff_t low,
                   std::ptrdiff_t high, const Use& use) noexcept {
    each_mixed_root(
        low, high, [&](std::ptrdiff_t k) { return cost.at(t, k); }, use);
}

// Sum of |difference|: every metric except sqeuclidean equals this in one dimension.
template <int dim>
struct AbsoluteCost : SquaredCost<dim> {
    using SquaredCost<dim>::SquaredCost;
    Pack at(std::ptrdiff_t t, std::ptrdiff_t k) const noexcept {
        Pack sum = simd::pabs(this->difference(t, k, 0));
        for (int c = 1; c < dim; ++c) sum = simd::padd(sum, simd::pabs(this->difference(t, k, c)));
        return sum;
    }
};

// Any other metric and dimension: a diagonal is written to strip.cost first.
struct BufferedCost {
    const double* cost;

    explicit BufferedCost(const Strip& strip) noexcept : cost(strip.cost) {}
    void prepare(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low, std::ptrdiff_t high,
                 CostFunction fill) const noexcept {
        fill(strip, t, low, high);
    }
    Pack at(std::ptrdiff_t, std::ptrdiff_t k) const noexcept { return load(cost + k); }
};

template <class Norm, int fixed_dim>
void fill_cost_in(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
                  std::ptrdiff_t high) noexcept {
    const std::ptrdiff_t dim = fixed_dim > 0 ? fixed_dim : strip.dim;
    const std::ptrdiff_t p_stride = strip.p_stride, q_stride = strip.q_stride;
    const double* const p = strip.p;
    const double* const q = strip.q + strip.columns - 1 - t;
    double* const cost = strip.cost;
    for (std::ptrdiff_t k = low; k <= high; k += width) {
        Pack sum = simd::pset1<Pack>(0.0);
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            sum =
                Norm::add(sum, simd::psub(load(p + c * p_stride + k), load(q + c * q_stride + k)));
        }
        store(cost + k, Norm::finish(sum));
    }
}

template <class Norm>
void fill_cost(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
               std::ptrdiff_t high) noexcept {
    if (strip.dim == 2) return fill_cost_in<Norm, 2>(strip, t, low, high);
    fill_cost_in<Norm, 0>(strip, t, low, high);
}

using Arc = Haversine<PackArithmetic, DividerRoot>;

void fill_arcs(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
               std::ptrdiff_t high) noexcept {
    const SquaredCost<3> squares(strip);
    const Pack radius = simd::pset1<Pack>(strip.metric_parameter);
    for (std::ptrdiff_t k = low; k <= high; k += width) {
        store(strip.cost + k, Arc::finish(squares.at(t, k), radius));
    }
}

// For distances that are not norms, a pair of points at a time.
template <class Row>
void fill_one_by_one(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
                     std::ptrdiff_t high) noexcept {
    const double* const q = strip.q + strip.columns - 1 - t;
    for (std::ptrdiff_t k = low; k <= high; ++k) {
        strip.cost[k] =
            Row::distance([&](std::ptrdiff_t c) { return strip.p[c * strip.p_stride + k]; },
                          [&](std::ptrdiff_t c) { return q[c * strip.q_stride + k]; }, strip.dim,
                          strip.metric_parameter);
    }
}

void fill_own(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
              std::ptrdiff_t high) noexcept {
    for (std::ptrdiff_t k = low; k <= high; ++k) {
        strip.cost[k] = strip.own[k * strip.own_stride + t - k];
    }
}

template <class Root>
CostFunction select_fill_with(Metric metric) noexcept {
    return with_row<PackArithmetic, Root>(metric, [](auto row) -> CostFunction {
        using Row = decltype(row);
        if constexpr (Row::is_norm) {
            return fill_cost<Row>;
        } else if constexpr (Row::is_root) {
            return fill_arcs;
        } else {
            return fill_one_by_one<Row>;
        }
    });
}

CostFunction select_fill(Cost cost) noexcept {
    if (cost.is_own) return fill_own;
    return cost.squares_in_domain ? select_fill_with<UniformRoot>(cost.metric)
                                  : select_fill_with<DividerRoot>(cost.metric);
}
