// The one anti-diagonal sweep of a strip, for DTW and Fréchet (see strip.hpp for the layout).
// Per SIMD vector of cells: three loads of earlier diagonals, the ground distance, the
// recurrence, one store. Three policies compose it: the recurrence, the ground distance, and what
// is kept besides the bottom row. Included by the kernel of each level, inside its anonymous
// namespace.

#include "ground_distance.inl.hpp"

struct DtwSymmetric1 {
    // min(min(up, left) + d, diagonal + d) is the same: rounding is monotone.
    static Pack cell(const Pack& up, const Pack& left, const Pack& diag, const Pack& d) noexcept {
        return simd::padd(simd::pmin(simd::pmin(up, left), diag), d);
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
        return simd::pmax(simd::pmin(simd::pmin(up, left), diag), d);
    }
    // Predecessors are compared as they are: where d is larger than all, each would do.
    static Pack through_diagonal(const Pack& diag, const Pack&) noexcept { return diag; }
    static Pack through_side(const Pack& side, const Pack&) noexcept { return side; }
};

struct KeepNothing {
    explicit KeepNothing(const Strip&) noexcept {}
    template <class Rule>
    void cells(std::ptrdiff_t, const Pack&, const Pack&, const Pack&, const Pack&) noexcept {}
    void diagonal(const Strip&, std::ptrdiff_t, std::ptrdiff_t, std::ptrdiff_t) noexcept {}
};

// One byte a cell, in the order of the sweep. Codes go through strip.cost's lanes as doubles:
// a diagonal's cost has been read by the time its code is written.
struct KeepCodes {
    double* lanes;

    explicit KeepCodes(const Strip& strip) noexcept : lanes(strip.cost) {}
    template <class Rule>
    void cells(std::ptrdiff_t k, const Pack& up, const Pack& left, const Pack& diag,
               const Pack& d) noexcept {
        const Pack side =
            simd::pselect(simd::pcmp_le(up, left), simd::pset1<Pack>(double{Predecessor::up}),
                          simd::pset1<Pack>(double{Predecessor::left}));
        const Pack by_diagonal = simd::pcmp_le(Rule::through_diagonal(diag, d),
                                               Rule::through_side(simd::pmin(up, left), d));
        store(lanes + k,
              simd::pselect(by_diagonal, simd::pset1<Pack>(double{Predecessor::diagonal}), side));
    }
    void diagonal(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
                  std::ptrdiff_t high) noexcept {
        std::uint8_t* const to = strip.codes + t * strip.code_stride;
        for (std::ptrdiff_t k = low; k <= high; ++k) to[k] = static_cast<std::uint8_t>(lanes[k]);
    }
};

struct KeepTable {
    explicit KeepTable(const Strip&) noexcept {}
    template <class Rule>
    void cells(std::ptrdiff_t, const Pack&, const Pack&, const Pack&, const Pack&) noexcept {}
    void diagonal(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
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
        if (high + 1 < strip.rows && strip.first_column[high + 1] + high + 1 <= t) ++high;
        if (strip.last_column[low] + low < t) ++low;
        double* const before = strip.before;
        double* const before_last = strip.before_last;
        double* const current = strip.current;
        before[0] = strip.boundary[t];  // read, but not used, once lane 0 is past its last column
        cost.prepare(strip, t, low, high, fill);
        for (std::ptrdiff_t k = low; k <= high; k += width) {
            const Pack up = load(before + k);
            const Pack left = load(before + k + 1);
            const Pack diag = load(before_last + k);
            const Pack d = cost.at(t, k);
            keep.template cells<Rule>(k, up, left, diag, d);
            store(current + k + 1, Rule::cell(up, left, diag, d));
        }
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

template <class Rule, class GroundCost>
AdvanceFunction select_output(Output output) noexcept {
    switch (output) {
        case Output::boundary_only:
            return advance<Rule, GroundCost, KeepNothing>;
        case Output::codes:
            return advance<Rule, GroundCost, KeepCodes>;
        case Output::table:
            return advance<Rule, GroundCost, KeepTable>;
    }
    return nullptr;
}

// The ground distances that are worth their own loop are fused; codes and tables are bound by
// what they write, so one buffered form of each is enough.
template <class Rule>
AdvanceFunction select_cost(Cost cost, std::ptrdiff_t dim, Output output) noexcept {
    if (output != Output::boundary_only) return select_output<Rule, BufferedCost>(output);
    if (dim == 1 && cost != Cost::sqeuclidean) return advance<Rule, AbsoluteCost, KeepNothing>;
    if (cost == Cost::sqeuclidean) {
        if (dim == 1) return advance<Rule, SquaredCost<1>, KeepNothing>;
        if (dim == 2) return advance<Rule, SquaredCost<2>, KeepNothing>;
        if (dim == 3) return advance<Rule, SquaredCost<3>, KeepNothing>;
    }
    if (cost == Cost::euclidean_in_domain) {
        if (dim == 2) return advance<Rule, EuclideanCost<2, FastRoot>, KeepNothing>;
        if (dim == 3) return advance<Rule, EuclideanCost<3, FastRoot>, KeepNothing>;
    }
    return advance<Rule, BufferedCost, KeepNothing>;
}

AdvanceFunction select_advance(Recurrence recurrence, Cost cost, std::ptrdiff_t dim,
                               Output output) noexcept {
    switch (recurrence) {
        case Recurrence::dtw_symmetric1:
            return select_cost<DtwSymmetric1>(cost, dim, output);
        case Recurrence::dtw_symmetric2:
            return select_cost<DtwSymmetric2>(cost, dim, output);
        case Recurrence::frechet:
            return select_cost<DiscreteFrechet>(cost, dim, output);
    }
    return nullptr;
}
