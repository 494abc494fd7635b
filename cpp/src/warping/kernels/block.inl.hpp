// Small blocks of the Fréchet table (see block.hpp). Ground distances are computed by the same
// operations as in the sweep. Included by the kernel of each level, inside its anonymous
// namespace.

// Bit k: whether lane k of d is at most lane k of the threshold.
#if defined(EIGEN_VECTORIZE_AVX512)
inline std::uint64_t at_most(const Pack& d, const Pack& threshold) noexcept {
    return _mm512_cmp_pd_mask(d, threshold, _CMP_LE_OQ);
}
#elif defined(EIGEN_VECTORIZE_AVX)
inline std::uint64_t at_most(const Pack& d, const Pack& threshold) noexcept {
    return static_cast<std::uint64_t>(_mm256_movemask_pd(_mm256_cmp_pd(d, threshold, _CMP_LE_OQ)));
}
#elif defined(EIGEN_VECTORIZE_SSE2)
inline std::uint64_t at_most(const Pack& d, const Pack& threshold) noexcept {
    return static_cast<std::uint64_t>(_mm_movemask_pd(_mm_cmple_pd(d, threshold)));
}
#else
inline std::uint64_t at_most(const Pack& d, const Pack& threshold) noexcept {
    double lanes[width], most[width];
    store(lanes, d);
    store(most, threshold);
    std::uint64_t bits = 0;
    for (std::ptrdiff_t k = 0; k < width; ++k) {
        bits |= static_cast<std::uint64_t>(lanes[k] <= most[k]) << k;
    }
    return bits;
}
#endif

// The ground distances of a row of a block: `fixed_dim` is 0 where the dimension is not known
// when this is compiled.
template <class Norm, int fixed_dim>
struct RowDistance {
    const double* across;
    const double* down;
    std::ptrdiff_t across_stride;
    std::ptrdiff_t down_stride;
    std::ptrdiff_t dim;

    Pack at(std::ptrdiff_t i) const noexcept {
        Pack sum = simd::pset1<Pack>(0.0);
        for (std::ptrdiff_t c = 0; c < (fixed_dim > 0 ? fixed_dim : dim); ++c) {
            const Pack delta = simd::psub(load(across + c * across_stride + i),
                                          simd::pset1<Pack>(down[c * down_stride]));
            sum = Norm::add(sum, delta);
        }
        return sum;
    }
};

// A row is a word. From the cells that lead into it, it is flooded along its runs of open cells by
// the carry of an addition.
template <class Norm, int fixed_dim>
void reach(ReachBlock& block) noexcept {
    constexpr std::ptrdiff_t group = 16;  // columns tested together
    const Pack threshold = simd::pset1<Pack>(block.threshold);
    const std::uint64_t all = ~std::uint64_t{0} >> (block_side - block.columns);
    RowDistance<Norm, fixed_dim> distance{block.across, block.down, block.across_stride,
                                          block.down_stride, block.dim};
    std::uint64_t reached = block.above, last_column = 0;
    std::uint64_t corner = block.corner ? 1 : 0;
    block.is_reached = false;
    for (std::ptrdiff_t j = 0; j < block.rows; ++j) {
        const std::uint64_t before = block.beside >> j & 1;
        const std::uint64_t entered = (reached | reached << 1 | corner | before) & all;
        corner = before;
        reached = 0;
        if (entered != 0) {
            std::ptrdiff_t i = 0;
            while ((entered >> i & 0xffff) == 0) i += group;
            std::uint64_t open = 0;
            for (; i < block.columns; i += group) {
                std::uint64_t bits = 0;
                for (std::ptrdiff_t k = 0; k < group; k += width) {
                    if (width < group && i + k >= block.columns) break;
                    bits |= at_most(distance.at(i + k), threshold) << k;
                }
                open |= bits << i;
            }
            open &= all;
            const std::uint64_t seeds = entered & open;
            reached = open & (((open + seeds) ^ open) | seeds);
            block.is_reached |= reached != 0;
        }
        last_column |= (reached >> (block.columns - 1) & 1) << j;
        distance.down += block.down_step;
    }
    block.above = reached;
    block.beside = last_column;
}

// By anti-diagonals, as a strip.
template <class Norm, int fixed_dim>
void values(const ValueBlock& block) noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr std::ptrdiff_t room = block_side + 2 + padding;
    double lanes[3][room];
    for (double* lane : lanes) {
        for (std::ptrdiff_t k = 0; k < room; ++k) lane[k] = infinity;
    }
    double* before = lanes[0];
    double* before_last = lanes[1];
    double* current = lanes[2];
    before_last[0] = block.corner;
    before[1] = block.beside[0];
    for (std::ptrdiff_t t = 0; t < block.rows + block.columns - 1; ++t) {
        const std::ptrdiff_t low = t < block.columns ? 0 : t - block.columns + 1;
        const std::ptrdiff_t high = t < block.rows ? t : block.rows - 1;
        if (t < block.columns) before[0] = block.above[t];
        for (std::ptrdiff_t k = low; k <= high; k += width) {
            Pack sum = simd::pset1<Pack>(0.0);
            for (std::ptrdiff_t c = 0; c < (fixed_dim > 0 ? fixed_dim : block.dim); ++c) {
                const Pack delta = simd::psub(load(block.p + c * block.p_stride + k),
                                              load(block.q + c * block.q_stride - t + k));
                sum = Norm::add(sum, delta);
            }
            store(current + k + 1, DiscreteFrechet::cell(load(before + k), load(before + k + 1),
                                                         load(before_last + k), sum));
        }
        // The next row's left neighbour in its first column.
        if (high + 1 < block.rows) current[high + 2] = block.beside[high + 1];
        if (high + 1 == block.rows) block.above[t + 1 - block.rows] = current[block.rows];
        if (t + 1 - block.columns == low) block.beside[low] = current[low + 1];
        double* const oldest = before_last;
        before_last = before;
        before = current;
        current = oldest;
    }
}

template <class Norm>
ReachFunction select_reach_in(std::ptrdiff_t dim) noexcept {
    if (dim == 1) return reach<Norm, 1>;
    if (dim == 2) return reach<Norm, 2>;
    if (dim == 3) return reach<Norm, 3>;
    return reach<Norm, 0>;
}

// The table of Fréchet holds the distances without their root.
ReachFunction select_reach(Metric metric, std::ptrdiff_t dim) noexcept {
    return with_row<PackArithmetic, DividerRoot>(metric, [=](auto row) -> ReachFunction {
        using Row = decltype(row);
        if constexpr (Row::is_norm && !Row::is_root) {
            return select_reach_in<Row>(dim);
        } else {
            return nullptr;
        }
    });
}

template <class Norm>
ValueFunction select_values_in(std::ptrdiff_t dim) noexcept {
    if (dim == 1) return values<Norm, 1>;
    if (dim == 2) return values<Norm, 2>;
    if (dim == 3) return values<Norm, 3>;
    return values<Norm, 0>;
}

ValueFunction select_values(Metric metric, std::ptrdiff_t dim) noexcept {
    return with_row<PackArithmetic, DividerRoot>(metric, [=](auto row) -> ValueFunction {
        using Row = decltype(row);
        if constexpr (Row::is_norm && !Row::is_root) {
            return select_values_in<Row>(dim);
        } else {
            return nullptr;
        }
    });
}
