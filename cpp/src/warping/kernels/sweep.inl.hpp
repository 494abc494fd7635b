// The one anti-diagonal sweep of a strip, for DTW and Fréchet (see strip.hpp for the layout). Per
// SIMD vector of cells: three loads of earlier diagonals, the ground distance, the recurrence, one
// store. It is composed of three policies: the recurrence, the ground distance, and the output
// besides the bottom row. The kernel of each level includes this file inside its anonymous
// namespace.

#include "ground_distance.inl.hpp"

struct DtwSymmetric1 {
    // min(min(up, left) + d, diagonal + d) is the same: rounding is monotone.
    static Pack cell(const Pack& up, const Pack& left, const Pack& diag, const Pack& d) noexcept {
        return from_least(simd::pmin(simd::pmin(up, left), diag), d);
    }
    static Pack from_least(const Pack& least, const Pack& d) noexcept {
        return simd::padd(least, d);
    }
    static Pack through_diagonal(const Pack& diag, const Pack& d) noexcept {
        return simd::padd(diag, d);
    }
    static Pack through_side(const Pack& side, const Pack& d) noexcept {
        return simd::padd(side, d);
    }
};

struct DtwSymmetric2 {
    static Pack cell(const Pack& up, const Pack& left, const Pack& diag, const Pack& d) noexcept {
        return simd::pmin(through_side(simd::pmin(up, left), d), through_diagonal(diag, d));
    }
    static Pack through_diagonal(const Pack& diag, const Pack& d) noexcept {
        return simd::padd(diag, simd::padd(d, d));
    }
    static Pack through_side(const Pack& side, const Pack& d) noexcept {
        return simd::padd(side, d);
    }
};

struct DiscreteFrechet {
    static Pack cell(const Pack& up, const Pack& left, const Pack& diag, const Pack& d) noexcept {
        return from_least(simd::pmin(simd::pmin(up, left), diag), d);
    }
    static Pack from_least(const Pack& least, const Pack& d) noexcept {
        return simd::pmax(least, d);
    }
    // Predecessors are compared directly: if d is larger than all, any of them is right.
    static Pack through_diagonal(const Pack& diag, const Pack&) noexcept { return diag; }
    static Pack through_side(const Pack& side, const Pack&) noexcept { return side; }
};

// The output for a cell besides its value. Before a diagonal, begin(); per vector, cells(); after
// it, diagonal().
struct KeepNothing {
    explicit KeepNothing(const Strip&) noexcept {}
    void begin(Strip&, std::ptrdiff_t) noexcept {}
    template <class Rule>
    void cells(std::ptrdiff_t, const Pack&, const Pack&, const Pack&, const Pack&) noexcept {}
    void diagonal(Strip&, std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t) noexcept {}
};

// One of three packs by the predecessor that the path takes: the diagonal, then up, then left.
template <class Rule>
Pack by_predecessor(const Pack& up, const Pack& left, const Pack& diag, const Pack& d,
                    const Pack& if_diagonal, const Pack& if_up, const Pack& if_left) noexcept {
    const Pack side = simd::pselect(simd::pcmp_le(up, left), if_up, if_left);
    const Pack by_diagonal =
        simd::pcmp_le(Rule::through_diagonal(diag, d), Rule::through_side(simd::pmin(up, left), d));
    return simd::pselect(by_diagonal, if_diagonal, side);
}

// The column at which a cell's path leaves the row above the region.
struct KeepOrigins {
    const double* before = nullptr;
    const double* before_last = nullptr;
    double* current = nullptr;

    explicit KeepOrigins(const Strip&) noexcept {}
    void begin(Strip& strip, std::ptrdiff_t t) noexcept {
        strip.origin_before[0] = strip.origin_boundary[t];
        before = strip.origin_before;
        before_last = strip.origin_before_last;
        current = strip.origin_current;
    }
    template <class Rule>
    void cells(std::ptrdiff_t k, const Pack& up, const Pack& left, const Pack& diag,
               const Pack& d) noexcept {
        store(current + k + 1, by_predecessor<Rule>(up, left, diag, d, load(before_last + k),
                                                    load(before + k), load(before + k + 1)));
    }
    void diagonal(Strip& strip, std::ptrdiff_t t, std::ptrdiff_t, std::ptrdiff_t high) noexcept {
        if (high + 1 == strip.rows) {
            strip.origin_boundary[t + 1 - strip.rows] = current[strip.rows];
        }
        double* const oldest = strip.origin_before_last;
        strip.origin_before_last = strip.origin_before;
        strip.origin_before = strip.origin_current;
        strip.origin_current = oldest;
    }
};

// One byte a cell, in the order of the sweep. Codes go through strip.cost's lanes as doubles:
// a diagonal's cost has been read by the time its code is written.
struct KeepCodes {
    double* lanes;

    explicit KeepCodes(const Strip& strip) noexcept : lanes(strip.cost) {}
    void begin(Strip&, std::ptrdiff_t) noexcept {}
    template <class Rule>
    void cells(std::ptrdiff_t k, const Pack& up, const Pack& left, const Pack& diag,
               const Pack& d) noexcept {
        store(lanes + k, by_predecessor<Rule>(up, left, diag, d, code(Predecessor::diagonal),
                                              code(Predecessor::up), code(Predecessor::left)));
    }
    void diagonal(Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
                  std::ptrdiff_t high) noexcept {
        std::uint8_t* const to = strip.codes + t * strip.code_stride;
        for (std::ptrdiff_t k = low; k <= high; ++k) to[k] = static_cast<std::uint8_t>(lanes[k]);
    }

   private:
    static Pack code(Predecessor predecessor) noexcept {
        return simd::pset1<Pack>(static_cast<double>(predecessor));
    }
};

// The same for few active lanes, for which a second loop would take longer than the cells. The
// codes of a SIMD vector are the bytes of one number, the sum of its lanes. It is written past the
// last active lane, too.
struct KeepFewCodes {
    using Word = std::conditional_t<width == 4, std::uint32_t,
                                    std::conditional_t<width == 2, std::uint16_t, std::uint8_t>>;
    Pack if_up;
    Pack if_left;
    std::uint8_t* to = nullptr;

    explicit KeepFewCodes(const Strip&) noexcept
        : if_up(words(Predecessor::up)), if_left(words(Predecessor::left)) {}
    void begin(Strip& strip, std::ptrdiff_t t) noexcept {
        to = strip.codes + t * strip.code_stride;
    }
    template <class Rule>
    void cells(std::ptrdiff_t k, const Pack& up, const Pack& left, const Pack& diag,
               const Pack& d) noexcept {
        static_assert(Predecessor::diagonal == 0);
        const Pack none = simd::pset1<Pack>(0.0);
        const Pack codes = by_predecessor<Rule>(up, left, diag, d, none, if_up, if_left);
        const auto word = static_cast<Word>(static_cast<std::int64_t>(simd::predux(codes)));
        std::memcpy(to + k, &word, sizeof word);
    }
    void diagonal(Strip&, std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t) noexcept {}

   private:
    // In lane l, the word whose byte l is the code.
    static Pack words(Predecessor predecessor) noexcept {
        double lanes[width];
        for (std::ptrdiff_t l = 0; l < width; ++l) {
            std::uint8_t bytes[width] = {};
            bytes[l] = predecessor;
            Word word = 0;
            std::memcpy(&word, bytes, sizeof word);
            lanes[l] = static_cast<double>(word);
        }
        return load(lanes);
    }
};

// A double does not hold the bytes of eight cells.
using KeepNarrowCodes = std::conditional_t<(width > 4), KeepCodes, KeepFewCodes>;

struct KeepTable {
    explicit KeepTable(const Strip&) noexcept {}
    void begin(Strip&, std::ptrdiff_t) noexcept {}
    template <class Rule>
    void cells(std::ptrdiff_t, const Pack&, const Pack&, const Pack&, const Pack&) noexcept {}
    void diagonal(Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
                  std::ptrdiff_t high) noexcept {
        for (std::ptrdiff_t k = low; k <= high; ++k) {
            strip.table[k * strip.table_stride + t - k] = strip.current[k + 1];
        }
    }
};

template <class Rule, class GroundCost, class Keep>
void advance(Strip& strip, std::ptrdiff_t end, CostFunction fill) noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    GroundCost cost(strip);
    Keep keep(strip);
    std::ptrdiff_t low = strip.low_lane;
    std::ptrdiff_t high = strip.high_lane;
    for (std::ptrdiff_t t = strip.next_diagonal; t < end; ++t) {
        // first_column[k] + k and last_column[k] + k rise strictly, so each end moves by one.
        if (high + 1 < strip.rows && strip.first_column[high + 1] + high + 1 <= t) {
            ++high;
            // The row below looks one column further left than this one, the last, begins.
            if (high + 1 == strip.rows && t >= strip.rows)
                strip.boundary[t - strip.rows] = infinity;
        }
        if (strip.last_column[low] + low < t) ++low;
        double* const before = strip.before;
        double* const before_last = strip.before_last;
        double* const current = strip.current;
        before[0] = strip.boundary[t];  // read, but not used, once lane 0 is past its last column
        keep.begin(strip, t);
        cost.prepare(strip, t, low, high, fill);
        each_distance(cost, t, low, high, [&](std::ptrdiff_t k, const Pack& d) {
            const Pack up = load(before + k);
            const Pack left = load(before + k + 1);
            const Pack diag = load(before_last + k);
            keep.template cells<Rule>(k, up, left, diag, d);
            store(current + k + 1, Rule::cell(up, left, diag, d));
        });
        // The neighbours of the active lanes: the next two diagonals read no further.
        current[low] = infinity;
        current[high + 2] = infinity;
        keep.diagonal(strip, t, low, high);
        if (high + 1 == strip.rows) strip.boundary[t + 1 - strip.rows] = current[strip.rows];
        strip.before_last = before;
        strip.before = current;
        strip.current = before_last;
    }
    strip.low_lane = low;
    strip.high_lane = high;
    strip.next_diagonal = end;
}

template <class Rule, class Keep>
void advance_in_plane(Strip& strip, std::ptrdiff_t end, CostFunction fill) noexcept {
    if constexpr (mixes_roots) {
        if (strip.rows >= min_rows_of_mixed_roots) {
            return advance<Rule, MixedEuclideanCost, Keep>(strip, end, fill);
        }
    }
    advance<Rule, EuclideanCost<2, UniformRoot>, Keep>(strip, end, fill);
}

// The ground distances that are worth their own loop are fused.
template <class Rule, class Keep>
AdvanceFunction select_cost(Cost cost, std::ptrdiff_t dim) noexcept {
    if (cost.is_own) return advance<Rule, BufferedCost, Keep>;
    if (cost.metric == Metric::cityblock && dim == 1) return advance<Rule, AbsoluteCost<1>, Keep>;
    if (cost.metric == Metric::sqeuclidean) {
        if (dim == 1) return advance<Rule, SquaredCost<1>, Keep>;
        if (dim == 2) return advance<Rule, SquaredCost<2>, Keep>;
        if (dim == 3) return advance<Rule, SquaredCost<3>, Keep>;
    }
    if (cost.metric == Metric::euclidean && cost.squares_in_domain) {
        if (dim == 2) return advance_in_plane<Rule, Keep>;
        if (dim == 3) return advance<Rule, EuclideanCost<3, UniformRoot>, Keep>;
    }
    return advance<Rule, BufferedCost, Keep>;
}

template <class Rule>
AdvanceFunction select_output(Cost cost, std::ptrdiff_t dim, Output output) noexcept {
    switch (output) {
        case Output::boundary_only:
            return select_cost<Rule, KeepNothing>(cost, dim);
        case Output::origins:
            return select_cost<Rule, KeepOrigins>(cost, dim);
        case Output::codes:  // the writes are the limit, so one form suffices
            return advance<Rule, BufferedCost, KeepCodes>;
        case Output::narrow_codes:
            if (cost.metric == Metric::cityblock && dim == 2 && !cost.is_own) {
                return advance<Rule, AbsoluteCost<2>, KeepNarrowCodes>;
            }
            return advance<Rule, BufferedCost, KeepNarrowCodes>;
        case Output::table:
            break;
    }
    return advance<Rule, BufferedCost, KeepTable>;
}

AdvanceFunction select_advance(Rule rule, Cost cost, std::ptrdiff_t dim, Output output) noexcept {
    switch (rule) {
        case Rule::dtw_symmetric1:
            return select_output<DtwSymmetric1>(cost, dim, output);
        case Rule::dtw_symmetric2:
            return select_output<DtwSymmetric2>(cost, dim, output);
        case Rule::frechet:
            break;
    }
    return select_output<DiscreteFrechet>(cost, dim, output);
}
