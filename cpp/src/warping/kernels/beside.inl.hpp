// One curve with several others, each in a lane (see beside.hpp): the table is swept row by row, so
// that a band costs its own cells alone. Lanes of an anti-diagonal, as sweep.inl.hpp has them, are
// mostly empty where a band, or a curve, has few cells. The operations of a cell are the same. The
// kernel of each level includes this file inside its anonymous namespace.

#include "sweep.inl.hpp"

// The ground distance from a row's point to a column's points, with coordinate c of a pack at
// q + c * stride.
template <int dim>
struct SquaresBeside {
    Pack point[dim];

    SquaresBeside(const Beside& beside, std::ptrdiff_t row) noexcept {
        for (int c = 0; c < dim; ++c) {
            point[c] = simd::pset1<Pack>(beside.p[c * beside.p_stride + row]);
        }
    }
    Pack of(const double* q, std::ptrdiff_t stride) const noexcept {
        Pack sum = square(q, 0);
        for (int c = 1; c < dim; ++c) sum = simd::padd(sum, square(q + c * stride, c));
        return sum;
    }
    Pack difference(const double* q, int c) const noexcept { return simd::psub(point[c], load(q)); }

   private:
    Pack square(const double* q, int c) const noexcept {
        const Pack delta = difference(q, c);
        return simd::pmul(delta, delta);
    }
};

struct AbsolutesBeside : SquaresBeside<1> {
    using SquaresBeside<1>::SquaresBeside;
    Pack of(const double* q, std::ptrdiff_t) const noexcept { return simd::pabs(difference(q, 0)); }
};

template <int dim>
struct RootsBeside : SquaresBeside<dim> {
    using SquaresBeside<dim>::SquaresBeside;
    Pack of(const double* q, std::ptrdiff_t stride) const noexcept {
        return UniformRoot::of(SquaresBeside<dim>::of(q, stride));
    }
};

// The last cells of a row, and those above them, pack by pack.
template <class Rule, int packs>
struct CellsBeside {
    Pack left[packs];
    Pack diagonal[packs];

    template <class GroundCost, class Above>
    void step(const GroundCost& cost, const double* q, std::ptrdiff_t stride, double* to,
              const Above& above) noexcept {
        for (int k = 0; k < packs; ++k) {
            const Pack up = above(to + k * width);
            left[k] = Rule::cell(up, left[k], diagonal[k], cost.of(q + k * width, stride));
            diagonal[k] = up;
            store(to + k * width, left[k]);
        }
    }
};

template <class Rule, class GroundCost, int dim, int packs>
void sweep_beside(const Beside& beside) noexcept {
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
        const GroundCost cost(beside, i);
        const std::ptrdiff_t last_below = last_above < last ? last_above : last;
        const double* q = beside.q + first * dim * stride;
        double* to = beside.row + first * stride;
        std::ptrdiff_t j = first;
        for (; j <= last_below; ++j, q += dim * stride, to += stride) {
            cells.step(cost, q, stride, to, load);
        }
        for (; j <= last; ++j, q += dim * stride, to += stride) {
            cells.step(cost, q, stride, to, nothing);
        }
        first_above = first;
        last_above = last;
    }
}

template <class Rule, class GroundCost, int dim>
void sweep_packs_beside(const Beside& beside) noexcept {
    switch (beside.packs) {
        case 1:
            return sweep_beside<Rule, GroundCost, dim, 1>(beside);
        case 2:
            return sweep_beside<Rule, GroundCost, dim, 2>(beside);
        case 3:
            return sweep_beside<Rule, GroundCost, dim, 3>(beside);
        default:
            return sweep_beside<Rule, GroundCost, dim, 4>(beside);
    }
}

// Null for other ground distances and dimensions.
template <class Rule>
BesideFunction select_beside_of(Cost cost, std::ptrdiff_t dim) noexcept {
    if (cost.is_own) return nullptr;
    if (cost.metric == Metric::cityblock && dim == 1) {
        return sweep_packs_beside<Rule, AbsolutesBeside, 1>;
    }
    if (cost.metric == Metric::sqeuclidean) {
        if (dim == 1) return sweep_packs_beside<Rule, SquaresBeside<1>, 1>;
        if (dim == 2) return sweep_packs_beside<Rule, SquaresBeside<2>, 2>;
    }
    if (cost.metric == Metric::euclidean && cost.squares_in_domain && dim == 2) {
        return sweep_packs_beside<Rule, RootsBeside<2>, 2>;
    }
    return nullptr;
}

BesideFunction select_beside(Recurrence recurrence, Cost cost, std::ptrdiff_t dim) noexcept {
    switch (recurrence) {
        case Recurrence::dtw_symmetric1:
            return select_beside_of<DtwSymmetric1>(cost, dim);
        case Recurrence::dtw_symmetric2:
            return select_beside_of<DtwSymmetric2>(cost, dim);
        case Recurrence::frechet:
            break;
    }
    return select_beside_of<DiscreteFrechet>(cost, dim);
}
