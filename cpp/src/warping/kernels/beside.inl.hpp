// Several pairs, each in a lane (see beside.hpp): the table is swept row by row, so that a band
// costs its own cells alone. Lanes of an anti-diagonal, as sweep.inl.hpp has them, are mostly empty
// where a band, or a curve, has few cells. The operations of a cell are the same. The kernel of
// each level includes this file inside its anonymous namespace.

#include "sweep.inl.hpp"

// Of the curves in P's place, as in Beside.
struct Points {
    const double* data;
    std::ptrdiff_t stride;
    int dim;
};

// What a column's points are compared with: a row's point, the same in all lanes; a point in each
// lane; or the nearest point of a box. The difference in coordinate c of pack number k.
// Coordinates are counted while the program is compiled or, for a `fixed_dim` of 0, runs.
template <int fixed_dim>
struct OnePoint {
    static constexpr int dim = fixed_dim;
    Pack point[dim];

    OnePoint(const Points& p, std::ptrdiff_t row) noexcept {
        for (int c = 0; c < dim; ++c) point[c] = simd::pset1<Pack>(p.data[c * p.stride + row]);
    }
    Pack difference(const Pack& q, int c, int) const noexcept { return simd::psub(point[c], q); }
};

template <>
struct OnePoint<0> {
    const double* point;
    std::ptrdiff_t stride;
    int dim;

    OnePoint(const Points& p, std::ptrdiff_t row) noexcept
        : point(p.data + row), stride(p.stride), dim(p.dim) {}
    Pack difference(const Pack& q, int c, int) const noexcept {
        return simd::psub(simd::pset1<Pack>(point[c * stride]), q);
    }
};

// The number of coordinates.
template <int fixed_dim>
struct Dim {
    static constexpr int dim = fixed_dim;
    explicit Dim(int) noexcept {}
};
template <>
struct Dim<0> {
    int dim;
    explicit Dim(int given) noexcept : dim(given) {}
};

template <int fixed_dim>
struct PointOfEach : Dim<fixed_dim> {
    const double* points;
    std::ptrdiff_t stride;

    PointOfEach(const Points& p, std::ptrdiff_t row) noexcept
        : Dim<fixed_dim>(p.dim), points(p.data + row * this->dim * p.stride), stride(p.stride) {}
    Pack difference(const Pack& q, int c, int k) const noexcept {
        return simd::psub(load(points + c * stride + k * width), q);
    }
};

template <int fixed_dim>
struct NearestInBox {
    static constexpr int dim = fixed_dim;
    Pack low[dim];
    Pack high[dim];

    NearestInBox(const BoundsBeside& beside, std::ptrdiff_t column) noexcept {
        for (int c = 0; c < dim; ++c) {
            low[c] = simd::pset1<Pack>(beside.low[c][-column]);
            high[c] = simd::pset1<Pack>(beside.high[c][-column]);
        }
    }
    Pack difference(const Pack& q, int c, int) const noexcept {
        return simd::psub(simd::pmax(simd::pmin(q, high[c]), low[c]), q);
    }
};

template <>
struct NearestInBox<0> {
    const BoundsBeside& beside;
    std::ptrdiff_t column;
    int dim;

    NearestInBox(const BoundsBeside& all, std::ptrdiff_t its_column) noexcept
        : beside(all), column(its_column), dim(all.dim) {}
    Pack difference(const Pack& q, int c, int) const noexcept {
        const Pack low = simd::pset1<Pack>(beside.low[c][-column]);
        const Pack high = simd::pset1<Pack>(beside.high[c][-column]);
        return simd::psub(simd::pmax(simd::pmin(q, high), low), q);
    }
};

// The ground distance to a column's points, with coordinate c of a pack at q + c * stride.
struct SquaresBeside {
    template <class Points>
    static Pack of(const Points& points, const double* q, std::ptrdiff_t stride, int k) noexcept {
        Pack sum = square(points, q, 0, k);
        for (int c = 1; c < points.dim; ++c) {
            sum = simd::padd(sum, square(points, q + c * stride, c, k));
        }
        return sum;
    }

   private:
    template <class Points>
    static Pack square(const Points& points, const double* q, int c, int k) noexcept {
        const Pack delta = points.difference(load(q), c, k);
        return simd::pmul(delta, delta);
    }
};

struct AbsolutesBeside {
    template <class Points>
    static Pack of(const Points& points, const double* q, std::ptrdiff_t, int k) noexcept {
        return simd::pabs(points.difference(load(q), 0, k));
    }
};

struct RootsBeside {
    template <class Points>
    static Pack of(const Points& points, const double* q, std::ptrdiff_t stride, int k) noexcept {
        return UniformRoot::of(SquaresBeside::of(points, q, stride, k));
    }
};

// The last cells of a row, and those above them, pack by pack.
template <class Rule, int packs>
struct CellsBeside {
    Pack left[packs];
    Pack diagonal[packs];

    template <class GroundCost, class Points, class Above>
    void step(const Points& points, const double* q, std::ptrdiff_t stride, double* to,
              const Above& above) noexcept {
        for (int k = 0; k < packs; ++k) {
            const Pack up = above(to + k * width);
            const Pack d = GroundCost::of(points, q + k * width, stride, k);
            left[k] = Rule::cell(up, left[k], diagonal[k], d);
            diagonal[k] = up;
            store(to + k * width, left[k]);
        }
    }
};

template <class Rule, class GroundCost, class At, int packs>
void sweep_beside(const Beside& beside) noexcept {
    const Points all{beside.p, beside.p_stride, beside.dim};
    const std::ptrdiff_t dim = At(all, 0).dim;
    const Pack infinite = simd::pset1<Pack>(std::numeric_limits<double>::infinity());
    const auto nothing = [&](const double*) { return infinite; };
    const std::ptrdiff_t stride = beside.stride;
    std::ptrdiff_t first_above = 0, last_above = -1;
    for (std::ptrdiff_t i = 0; i < beside.rows; ++i) {
        const std::ptrdiff_t first = beside.first_column[i], last = beside.last_column[i];
        const bool has_diagonal = first > first_above && first - 1 <= last_above;
        CellsBeside<Rule, packs> cells;
        for (int k = 0; k < packs; ++k) {
            // The 0 that starts every path is no diagonal predecessor: a step into the table has
            // the weight of one to the side.
            cells.left[k] = i == 0 ? simd::pset1<Pack>(0.0) : infinite;
            cells.diagonal[k] =
                has_diagonal ? load(beside.row + (first - 1) * stride + k * width) : infinite;
        }
        const At points(all, i);
        const std::ptrdiff_t last_below = last_above < last ? last_above : last;
        const double* q = beside.q + first * dim * stride;
        double* to = beside.row + first * stride;
        std::ptrdiff_t j = first;
        for (; j <= last_below; ++j, q += dim * stride, to += stride) {
            cells.template step<GroundCost>(points, q, stride, to, load);
        }
        for (; j <= last; ++j, q += dim * stride, to += stride) {
            cells.template step<GroundCost>(points, q, stride, to, nothing);
        }
        first_above = first;
        last_above = last;
    }
}

template <class Rule, class GroundCost, int dim>
void sweep_packs_beside(const Beside& beside) noexcept {
    using At = OnePoint<dim>;
    switch (beside.packs) {
        case 1:
            return sweep_beside<Rule, GroundCost, At, 1>(beside);
        case 2:
            return sweep_beside<Rule, GroundCost, At, 2>(beside);
        case 3:
            return sweep_beside<Rule, GroundCost, At, 3>(beside);
        default:
            return sweep_beside<Rule, GroundCost, At, 4>(beside);
    }
}

// Distances are added up or, for Fréchet, the largest counts. The sum of DTW in either form is at
// least that of the columns' least distances, each paid for once.
template <bool is_largest, class GroundCost, int fixed_dim>
void bounds_beside(const BoundsBeside& beside) noexcept {
    constexpr std::ptrdiff_t columns_between_tests = 8;
    const std::ptrdiff_t stride = beside.stride;
    const std::ptrdiff_t end = beside.has_last ? beside.columns - 1 : beside.columns;
    const auto with = [](const Pack& total, const Pack& d) {
        return is_largest ? simd::pmax(total, d) : simd::padd(total, d);
    };
    const Points all{beside.p, beside.p_stride, beside.dim};
    const OnePoint<fixed_dim> first(all, 0), last(all, beside.rows - 1);
    const std::ptrdiff_t dim = first.dim;
    for (std::ptrdiff_t k = 0; k < beside.packs; ++k) {
        const double* const q = beside.q + k * width;
        Pack total = GroundCost::of(first, q, stride, 0);
        if (beside.has_last) {
            total = with(total, GroundCost::of(last, q + end * dim * stride, stride, 0));
        }
        for (std::ptrdiff_t j = 1; j < end;) {
            if (simd::predux_min(total) > beside.most) break;
            const std::ptrdiff_t stop =
                end - j < columns_between_tests ? end : j + columns_between_tests;
            for (; j < stop; ++j) {
                const NearestInBox<fixed_dim> box(beside, j);
                total = with(total, GroundCost::of(box, q + j * dim * stride, stride, 0));
            }
        }
        store(beside.bounds + k * width, total);
    }
}

template <class Rule, class GroundCost, int dim>
constexpr BesideKernels beside_kernels() noexcept {
    return {sweep_packs_beside<Rule, GroundCost, dim>,
            sweep_beside<Rule, GroundCost, PointOfEach<dim>, most_packs_beside>,
            bounds_beside<std::is_same_v<Rule, DiscreteFrechet>, GroundCost, dim>};
}

// None for other ground distances and dimensions.
template <class Rule>
BesideKernels select_beside_of(Cost cost, std::ptrdiff_t dim) noexcept {
    if (cost.is_own || dim > most_dim_beside) return {};
    if (cost.metric == Metric::cityblock && dim == 1) {
        return beside_kernels<Rule, AbsolutesBeside, 1>();
    }
    if (cost.metric == Metric::sqeuclidean) {
        if (dim == 1) return beside_kernels<Rule, SquaresBeside, 1>();
        if (dim == 2) return beside_kernels<Rule, SquaresBeside, 2>();
        return beside_kernels<Rule, SquaresBeside, 0>();
    }
    if (cost.metric == Metric::euclidean && cost.squares_in_domain) {
        if (dim == 2) return beside_kernels<Rule, RootsBeside, 2>();
        if (dim > 2) return beside_kernels<Rule, RootsBeside, 0>();
    }
    return {};
}

BesideKernels select_beside(Rule rule, Cost cost, std::ptrdiff_t dim) noexcept {
    switch (rule) {
        case Rule::dtw_symmetric1:
            return select_beside_of<DtwSymmetric1>(cost, dim);
        case Rule::dtw_symmetric2:
            return select_beside_of<DtwSymmetric2>(cost, dim);
        case Rule::frechet:
            break;
    }
    return select_beside_of<DiscreteFrechet>(cost, dim);
}
