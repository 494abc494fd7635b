// The sweep of a strip of at most `resident_rows` rows whose values stay in registers (see
// strip.hpp). sweep.inl.hpp loads two diagonals and stores a third, which takes more time than the
// arithmetic. The kernel of each level includes this file inside its anonymous namespace.
//
// Lane l of register r is row l * registers + r of the strip. So register r needs, for the row
// above it, the unchanged value of register r - 1 on the diagonal before. Lanes move once a
// diagonal, from the last register to the first. The points of Q move in the same way. For each of
// the last diagonals, the points of register 0's rows are held, one lane for each row. Register r
// takes the points that register 0 took r diagonals ago. No load crosses a cache line.
//
// Rows that have not begun hold infinity, since all of their predecessors do. Rows past their last
// column, and rows that a strip lacks, continue with points that are 0; nothing reads their values.

constexpr std::ptrdiff_t registers = resident_rows / width;

// Calls use(r) of each register, r known at compile time: a loop would keep them in memory.
template <std::ptrdiff_t r = 0, class Use>
EIGEN_ALWAYS_INLINE void each_register(const Use& use) noexcept {
    use(std::integral_constant<std::ptrdiff_t, r>{});
    if constexpr (r + 1 < registers) each_register<r + 1>(use);
}

// The ground distance of one coordinate's difference, and of the sum.
struct ResidentSquares {
    static Pack of(const Pack& delta) noexcept { return simd::pmul(delta, delta); }
    template <std::ptrdiff_t r>
    static Pack finish(const Pack& sum) noexcept {
        return sum;
    }
};
struct ResidentAbsolutes : ResidentSquares {
    static Pack of(const Pack& delta) noexcept { return simd::pabs(delta); }
};
// Every second root by multiplications, the others by the divider, which has nothing else to do.
struct ResidentRoots : ResidentSquares {
    template <std::ptrdiff_t r>
    static Pack finish(const Pack& sum) noexcept {
        if constexpr (r % 2 == 0) return DividerRoot::of(sum);
        return FastRoot::of(sum);
    }
};

// What a row keeps for the row below it, in addition to its last value. Most recurrences need only
// the lesser of the cells above and at the diagonal; "symmetric2" needs the cell at the diagonal.
template <class Rule>
struct Kept {
    static Pack of(const Pack& now, const Pack& before) noexcept { return simd::pmin(now, before); }
    static Pack cell(const Pack&, const Pack& left, const Pack& kept, const Pack& d) noexcept {
        return Rule::from_least(simd::pmin(kept, left), d);
    }
};
template <>
struct Kept<DtwSymmetric2> {
    static Pack of(const Pack&, const Pack& before) noexcept { return before; }
    static Pack cell(const Pack& up, const Pack& left, const Pack& kept, const Pack& d) noexcept {
        return DtwSymmetric2::cell(up, left, kept, d);
    }
};

// The points of a strip as its registers take them.
template <int dim>
class ResidentPoints {
   public:
    // Diagonals whose points of Q are held at a time: they stay in the first-level cache.
    static constexpr std::ptrdiff_t together = 64;

    explicit ResidentPoints(const Strip& strip) noexcept
        : q_(strip.q + strip.columns - 1), q_stride_(strip.q_stride), columns_(strip.columns) {
        for (int c = 0; c < dim; ++c) {
            const double* const p = strip.p + c * strip.p_stride;
            for (std::ptrdiff_t k = 0; k < resident_rows; ++k) {
                const std::ptrdiff_t r = k % registers, l = k / registers;
                of_rows_[c][r * width + l] = k < strip.rows ? p[k] : 0.0;
                // The points of the diagonals before the next one.
                of_diagonals_[c][r * width + l] =
                    of_column(c, strip.next_diagonal + r - (l + 1) * registers);
            }
        }
    }
    // Diagonal t, the place-th of those that are held.
    EIGEN_ALWAYS_INLINE void enter(std::ptrdiff_t t, std::ptrdiff_t place) noexcept {
        for (int c = 0; c < dim; ++c) {
            double* const at = of_diagonals_[c] + place * width;
            store(at + resident_rows, moved_up(load(at), of_column(c, t)));
        }
    }
    template <class Distance, std::ptrdiff_t r>
    EIGEN_ALWAYS_INLINE Pack distance(std::ptrdiff_t place) const noexcept {
        Pack sum = Distance::of(difference<r>(0, place));
        for (int c = 1; c < dim; ++c) {
            sum = simd::padd(sum, Distance::of(difference<r>(c, place)));
        }
        return Distance::template finish<r>(sum);
    }
    // `diagonals` diagonals have been entered; the next one starts a new group.
    void turn_over(std::ptrdiff_t diagonals) noexcept {
        for (int c = 0; c < dim; ++c) {
            std::memmove(of_diagonals_[c], of_diagonals_[c] + diagonals * width,
                         sizeof(double) * resident_rows);
        }
    }

   private:
    EIGEN_ALWAYS_INLINE double of_column(int c, std::ptrdiff_t j) const noexcept {
        return j < 0 || j >= columns_ ? 0.0 : q_[c * q_stride_ - j];
    }
    template <std::ptrdiff_t r>
    EIGEN_ALWAYS_INLINE Pack difference(int c, std::ptrdiff_t place) const noexcept {
        return simd::psub(load(of_rows_[c] + r * width),
                          load(of_diagonals_[c] + resident_rows + (place - r) * width));
    }

    const double* q_;  // backwards
    std::ptrdiff_t q_stride_;
    std::ptrdiff_t columns_;
    alignas(64) double of_rows_[dim][resident_rows];
    alignas(64) double of_diagonals_[dim][resident_rows + together * width];
};

// The last values of a strip's rows.
struct ResidentValues {
    Pack last[registers];
    Pack kept[registers];

    // Where a strip holds two diagonals of another kind, its index 0 as there.
    explicit ResidentValues(const Strip& strip) noexcept {
        each_register([&](auto r) {
            last[r] = load(strip.before + 1 + r * width);
            kept[r] = load(strip.before_last + 1 + r * width);
        });
    }
    void put_back(const Strip& strip) const noexcept {
        each_register([&](auto r) {
            store(strip.before + 1 + r * width, last[r]);
            store(strip.before_last + 1 + r * width, kept[r]);
        });
    }
    // The cells of registers r to 0, the last of them first, so that no cell overwrites an input of
    // another. `up` and `kept_above` are of the row above register 0.
    template <class Rule, class Distance, std::ptrdiff_t r, class Points>
    EIGEN_ALWAYS_INLINE void step(const Points& points, std::ptrdiff_t place, const Pack& up,
                                  const Pack& kept_above) noexcept {
        using Keep = Kept<Rule>;
        const Pack d = points.template distance<Distance, r>(place);
        const Pack left = last[r];
        if constexpr (r > 0) {
            last[r] = Keep::cell(last[r - 1], left, kept[r - 1], d);
            kept[r] = Keep::of(last[r], left);
            step<Rule, Distance, r - 1>(points, place, up, kept_above);
        } else {
            last[r] = Keep::cell(up, left, kept_above, d);
            kept[r] = Keep::of(last[r], left);
        }
    }
    // The last value of a row of the strip.
    EIGEN_ALWAYS_INLINE double last_of(std::ptrdiff_t row) const noexcept {
        if (row + 1 == resident_rows) return simd::pfirst(turn(last[registers - 1]));
        double lanes[resident_rows];
        each_register([&](auto r) { store(lanes + r * width, last[r]); });
        return lanes[row % registers * width + row / registers];
    }
};

template <class Rule, class Distance, int dim>
void advance_resident(Strip& strip, std::ptrdiff_t end, CostFunction) noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    using Points = ResidentPoints<dim>;
    Points points(strip);
    ResidentValues values(strip);
    double* const boundary = strip.boundary;
    const std::ptrdiff_t columns = strip.columns, bottom = strip.rows - 1;
    // The value of the row above, in all lanes: with two scalars, a compiler would branch on their
    // order.
    Pack above = simd::pset1<Pack>(strip.before_last[0]);
    for (std::ptrdiff_t t = strip.next_diagonal; t < end;) {
        const std::ptrdiff_t stop = end - t < Points::together ? end : t + Points::together;
        const std::ptrdiff_t diagonals = stop - t;
        for (std::ptrdiff_t place = 0; t < stop; ++t, ++place) {
            points.enter(t, place);
            const Pack above_before = above;
            above = simd::pset1<Pack>(t < columns ? boundary[t] : infinity);
            const Pack up = moved_up(values.last[registers - 1], above);
            const Pack kept_above =
                moved_up(values.kept[registers - 1], Kept<Rule>::of(above, above_before));
            values.template step<Rule, Distance, registers - 1>(points, place, up, kept_above);
            if (t >= bottom) boundary[t - bottom] = values.last_of(bottom);
        }
        points.turn_over(diagonals);
    }
    values.put_back(strip);
    strip.before_last[0] = simd::pfirst(above);
    strip.next_diagonal = end;
}

// The ramps at both ends of a strip are as long as it is tall. All lanes are computed there, and so
// are the rows that the last strip lacks. If the shorter side has fewer points than this, that
// costs more than it saves, by measurement. With roots in the plane, the saved loads matter less.
constexpr std::ptrdiff_t least_side = width > 4 ? 128 : 192;
constexpr std::ptrdiff_t least_side_of_roots(std::ptrdiff_t dim) noexcept {
    return dim == 2 ? 224 : 192;
}

// Null where it would not be faster. That is so for vectors of two lanes, whose registers are too
// few for the values of 32 rows. It is so for roots on a level where multiplications cannot replace
// the divider, because the divider is the limit.
template <class Rule>
AdvanceFunction select_resident_of(Cost cost, std::ptrdiff_t dim,
                                   std::ptrdiff_t shorter_side) noexcept {
    const bool has_roots = cost.metric == Metric::euclidean;
    const std::ptrdiff_t least = has_roots ? least_side_of_roots(dim) : least_side;
    if (cost.is_own || shorter_side < least) return nullptr;
    if constexpr (width > 2) {
        if (cost.metric == Metric::cityblock && dim == 1) {
            return advance_resident<Rule, ResidentAbsolutes, 1>;
        }
        if (cost.metric == Metric::sqeuclidean) {
            if (dim == 1) return advance_resident<Rule, ResidentSquares, 1>;
            if (dim == 2) return advance_resident<Rule, ResidentSquares, 2>;
            if (dim == 3) return advance_resident<Rule, ResidentSquares, 3>;
        }
    }
    if constexpr (multiplies_roots) {
        if (cost.metric == Metric::euclidean && cost.squares_in_domain) {
            if (dim == 2) return advance_resident<Rule, ResidentRoots, 2>;
            if (dim == 3) return advance_resident<Rule, ResidentRoots, 3>;
        }
    }
    return nullptr;
}

AdvanceFunction select_resident(Rule rule, Cost cost, std::ptrdiff_t dim,
                                std::ptrdiff_t shorter_side) noexcept {
    switch (rule) {
        case Rule::dtw_symmetric1:
            return select_resident_of<DtwSymmetric1>(cost, dim, shorter_side);
        case Rule::dtw_symmetric2:
            return select_resident_of<DtwSymmetric2>(cost, dim, shorter_side);
        case Rule::frechet:
            break;
    }
    return select_resident_of<DiscreteFrechet>(cost, dim, shorter_side);
}
