// The sweep of recurrences with any steps (see recurrence.hpp), compiled once for each
// instruction-set level. O(terms) per cell. User-defined steps are data, read again for every few
// SIMD vectors of lanes. The steps of a named pattern or an edit distance are compiled
// (compiled_steps.inl.hpp). This is a separate file, so that the code of dtw and frechet does not
// change.
#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "curvewise/step_pattern.hpp"
#include "recurrence.hpp"

namespace curvewise::kernels {
namespace {
#include "ground_distance.inl.hpp"

constexpr double infinity = std::numeric_limits<double>::infinity();

// Where the terms of a diagonal are, lane 0 first.
struct Lanes {
    const double* values[max_steps];
    const double* terms[max_terms];
};

const double* offsets_on(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    const std::ptrdiff_t difference = strip.first_offset - t;
    const std::ptrdiff_t odd = difference & 1;
    return strip.offsets[odd] + (difference - odd) / 2;
}

const double* source_on(const RecurrenceStrip& strip, const LaneTerm& term,
                        std::ptrdiff_t t) noexcept {
    switch (term.source) {
        case Source::pair:
            return strip.pairs[term.diagonals_back];
        case Source::row_gap:
            return strip.row_gaps;
        case Source::column_gap:
            return strip.column_gaps + strip.columns - 1 - t;
        case Source::offset:
            return offsets_on(strip, t);
        case Source::row_move:
            return strip.row_moves;
        case Source::column_move:
            break;
    }
    return strip.column_moves;
}

void look_up(const RecurrenceStrip& strip, std::ptrdiff_t t, Lanes& lanes) noexcept {
    std::ptrdiff_t x = 0;
    for (std::ptrdiff_t s = 0; s < strip.step_count; ++s) {
        const LaneStep& step = strip.steps[s];
        lanes.values[s] = strip.values[step.diagonals_back] - step.rows_back;
        for (; x < step.end_term; ++x) {
            lanes.terms[x] = source_on(strip, strip.terms[x], t) - strip.terms[x].rows_back;
        }
    }
}

// Guarded are steps with negative terms. An infinite cost makes them infinite, whatever its weight,
// and so does a sum that overflows in both directions. Sums of numbers that are not negative are
// never nan.
template <int packs, bool with_codes, bool is_guarded>
inline void cells(const RecurrenceStrip& strip, const Lanes& lanes, std::ptrdiff_t k) noexcept {
    Pack best[packs], code[packs];
    [[maybe_unused]] const Pack most = simd::pset1<Pack>(infinity);
    std::ptrdiff_t x = 0;
    for (std::ptrdiff_t s = 0; s < strip.step_count; ++s) {
        const LaneStep& step = strip.steps[s];
        const double* const before = lanes.values[s] + k;
        Pack sum[packs];
        for (int u = 0; u < packs; ++u) sum[u] = load(before + u * width);
        if (step.constant != 0.0) {
            const Pack constant = simd::pset1<Pack>(step.constant);
            for (int u = 0; u < packs; ++u) sum[u] = simd::padd(sum[u], constant);
        }
        for (; x < step.end_term; ++x) {
            const double* const term = lanes.terms[x] + k;
            const Pack weight = simd::pset1<Pack>(strip.terms[x].weight);
            for (int u = 0; u < packs; ++u) {
                const Pack cost = load(term + u * width);
                Pack added = simd::pmul(weight, cost);
                if constexpr (is_guarded) {
                    added = simd::pselect(simd::pcmp_lt(cost, most), added, most);
                }
                sum[u] = simd::padd(sum[u], added);
            }
        }
        if constexpr (is_guarded) {
            for (int u = 0; u < packs; ++u) {  // no comparison holds for nan
                sum[u] = simd::pselect(simd::pcmp_lt(sum[u], most), sum[u], most);
            }
        }
        for (int u = 0; u < packs; ++u) {
            if constexpr (with_codes) {
                const Pack own = simd::pset1<Pack>(static_cast<double>(s));
                code[u] =
                    s == 0 ? own : simd::pselect(simd::pcmp_le(best[u], sum[u]), code[u], own);
            }
            best[u] = s == 0 ? sum[u] : simd::pmin(best[u], sum[u]);
        }
    }
    for (int u = 0; u < packs; ++u) {
        store(strip.values[0] + k + u * width, best[u]);
        if constexpr (with_codes) store(strip.code_lanes + k + u * width, code[u]);
    }
}

template <bool with_codes, bool is_guarded>
void all_cells(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    constexpr int together = 4;
    Lanes lanes;
    look_up(strip, t, lanes);
    std::ptrdiff_t k = strip.low_lane;
    for (; k + together * width <= strip.high_lane + 1; k += together * width) {
        cells<together, with_codes, is_guarded>(strip, lanes, k);
    }
    for (; k <= strip.high_lane; k += width) cells<1, with_codes, is_guarded>(strip, lanes, k);
}

#include "compiled_steps.inl.hpp"

// Makes costs of the distances of a diagonal.
void apply_rule(const RecurrenceStrip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
                std::ptrdiff_t high) noexcept {
    const PairRule rule = strip.rule;  // which a store of costs could change
    if (rule == PairRule::distance) return;
    double* const pairs = strip.pairs[0];
    const Pack zero = simd::pset1<Pack>(0.0), one = simd::pset1<Pack>(1.0);
    const Pack threshold = simd::pset1<Pack>(strip.threshold);
    const double* const weights =
        rule == PairRule::weighted ? offsets_on(strip, t) : strip.pairs[0];
    for (std::ptrdiff_t k = low; k <= high; k += width) {
        const Pack d = load(pairs + k);
        Pack cost = simd::pmul(d, load(weights + k));
        if (rule == PairRule::apart) {
            cost = simd::pselect(simd::pcmp_le(threshold, d), one, zero);
        } else if (rule == PairRule::together) {
            cost = simd::pselect(simd::pcmp_le(d, threshold), simd::psub(zero, one), zero);
        }
        store(pairs + k, cost);
    }
}

// How far a point lies outside of the interval between two others, which are a and b below it.
Pack outside(const Pack& a, const Pack& b) noexcept {
    const Pack zero = simd::pset1<Pack>(0.0);
    const Pack above = simd::pmin(a, b), below = simd::psub(zero, simd::pmax(a, b));
    return simd::pmax(simd::pmax(above, below), zero);
}

void fill_moves(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    const std::ptrdiff_t skipped = strip.lanes - strip.ground.rows;
    const double* const p = strip.ground.p - skipped;
    const double* const q = strip.ground.q + strip.columns - 1 - t;
    const double* const row_steps = strip.row_steps;
    const double* const column_steps = strip.column_steps + strip.columns - 1 - t;
    double* const row_moves = strip.row_moves;
    double* const column_moves = strip.column_moves;
    const std::ptrdiff_t high = strip.high_lane;
    for (std::ptrdiff_t k = strip.low_lane; k <= high; k += width) {
        const Pack x = load(p + k), y = load(q + k);
        store(row_moves + k, outside(load(row_steps + k), simd::psub(x, y)));
        store(column_moves + k, outside(load(column_steps + k), simd::psub(y, x)));
    }
}

// The distances of a diagonal's lanes, and of the lanes next to them that a step may visit.
void fill_pairs(RecurrenceStrip& strip, std::ptrdiff_t t, CostFunction fill) noexcept {
    const std::ptrdiff_t skipped = strip.lanes - strip.ground.rows;
    std::ptrdiff_t low = strip.low_lane - strip.reach, high = strip.high_lane + strip.reach;
    if (low < skipped) low = skipped;
    if (low < t - strip.columns + 1) low = t - strip.columns + 1;
    if (high > t) high = t;
    if (high > strip.lanes - 1) high = strip.lanes - 1;
    if (low > high) return;
    strip.ground.cost = strip.pairs[0] + skipped;
    fill(strip.ground, t - skipped, low - skipped, high - skipped);
    apply_rule(strip, t, low, high);
}

double before_column_zero(const RecurrenceStrip& strip, std::ptrdiff_t lane) noexcept {
    return strip.left_border == nullptr ? infinity : strip.left_border[lane];
}

// The cells of the rows above, before the diagonal is computed, and those next to it, after.
void enter_from_above(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    for (std::ptrdiff_t k = 0; k < strip.reach; ++k) {
        const std::ptrdiff_t column = t - k;
        double value = infinity;
        if (column >= 0 && column < strip.columns) {
            value = strip.boundary[k * strip.boundary_stride + column];
        } else if (column == -1) {
            value = before_column_zero(strip, k);
        }
        strip.values[0][k] = value;
    }
}

void close_sides(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    double* const values = strip.values[0];
    std::ptrdiff_t k = strip.low_lane - strip.reach;
    for (k = k < strip.reach ? strip.reach : k; k < strip.low_lane; ++k) values[k] = infinity;
    for (k = strip.high_lane + 1; k <= strip.high_lane + strip.reach && k < strip.lanes; ++k) {
        values[k] = t - k == -1 ? before_column_zero(strip, k) : infinity;
    }
}

void leave_below(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    const std::ptrdiff_t rows = strip.lanes - strip.reach;
    for (std::ptrdiff_t r = 0; r < strip.reach; ++r) {
        const std::ptrdiff_t k = rows + r, column = t - k;
        if (column < 0 || column >= strip.columns) continue;
        const bool is_known = k < strip.reach || (k >= strip.low_lane && k <= strip.high_lane);
        strip.boundary[r * strip.boundary_stride + column] =
            is_known ? strip.values[0][k] : infinity;
    }
}

void keep(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    for (std::ptrdiff_t k = strip.low_lane; k <= strip.high_lane; ++k) {
        if (strip.codes != nullptr) {
            strip.codes[t * strip.code_stride + k] = static_cast<std::uint8_t>(strip.code_lanes[k]);
        }
        if (strip.table != nullptr) {
            strip.table[k * strip.table_stride + t - k] = strip.values[0][k];
        }
    }
}

// A path begins in a cell unless one that comes from elsewhere is cheaper.
void begin_path(const RecurrenceStrip& strip, std::ptrdiff_t k) noexcept {
    if (!(strip.pairs[0][k] <= strip.values[0][k])) return;
    strip.values[0][k] = strip.pairs[0][k];
    if (strip.codes != nullptr) strip.code_lanes[k] = start_code;
}

void begin_paths(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    const std::ptrdiff_t first = strip.reach;
    if (strip.low_lane == first && t - first < strip.start_columns) begin_path(strip, first);
    const bool is_in_first_column = strip.low_lane <= t && t <= strip.high_lane;
    if (is_in_first_column && t - first < strip.start_rows) begin_path(strip, t);
}

void keep_end(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
    const std::ptrdiff_t k = t - strip.columns + 1;
    if (strip.ends == nullptr || k < strip.reach || k >= strip.lanes) return;
    const bool is_known = k >= strip.low_lane && k <= strip.high_lane;
    strip.ends[k] = is_known ? strip.values[0][k] : infinity;
}

void rotate(double** diagonals, std::ptrdiff_t count) noexcept {
    double* const oldest = diagonals[count - 1];
    for (std::ptrdiff_t i = count - 1; i > 0; --i) diagonals[i] = diagonals[i - 1];
    diagonals[0] = oldest;
}

template <class Steps>
void advance(RecurrenceStrip& strip, std::ptrdiff_t end, CostFunction fill) noexcept {
    for (std::ptrdiff_t t = strip.next_diagonal; t < end; ++t) {
        std::ptrdiff_t& low = strip.low_lane;
        std::ptrdiff_t& high = strip.high_lane;
        // Each of the strip's rows begins and ends later than the one above.
        if (high + 1 < strip.lanes && strip.first_column[high + 1] + high + 1 <= t) ++high;
        if (low <= high && strip.last_column[low] + low < t) ++low;
        rotate(strip.values, strip.value_count);
        rotate(strip.pairs, strip.pair_count);
        enter_from_above(strip, t);
        if (low < strip.lanes) fill_pairs(strip, t, fill);
        if (low <= high) {
            if (strip.row_moves != nullptr) fill_moves(strip, t);
            if (strip.codes != nullptr) {
                all_cells<true, Steps::is_guarded>(strip, t);
            } else {
                Steps::cells(strip, t);
            }
            begin_paths(strip, t);
        }
        close_sides(strip, t);
        keep_end(strip, t);
        if (strip.codes != nullptr || strip.table != nullptr) keep(strip, t);
        leave_below(strip, t);
    }
    strip.next_diagonal = end;
}

template <int which>
AdvanceRecurrence select_compiled(const LaneStep* steps, std::ptrdiff_t step_count,
                                  const LaneTerm* terms) noexcept {
    if constexpr (which < shape_count) {
        if (is_shape(shapes.all[which], steps, step_count, terms)) {
            return advance<CompiledSteps<which>>;
        }
        return select_compiled<which + 1>(steps, step_count, terms);
    } else {
        return advance<AnySteps<false>>;
    }
}

AdvanceRecurrence select_steps(const LaneStep* steps, std::ptrdiff_t step_count,
                               const LaneTerm* terms) noexcept {
    for (int x = 0; x < steps[step_count - 1].end_term; ++x) {
        if (terms[x].weight < 0.0) return advance<AnySteps<true>>;
    }
    for (std::ptrdiff_t s = 0; s < step_count; ++s) {
        if (steps[s].constant < 0.0) return advance<AnySteps<true>>;
    }
    return select_compiled<0>(steps, step_count, terms);
}

template <class GroundCost>
void fill_pairs_with(const Strip& strip, std::ptrdiff_t t, std::ptrdiff_t low,
                     std::ptrdiff_t high) noexcept {
    each_distance(GroundCost(strip), t, low, high,
                  [&](std::ptrdiff_t k, const Pack& d) { store(strip.cost + k, d); });
}

// In few dimensions without a loop over them.
CostFunction select_pairs(Cost cost, std::ptrdiff_t dim, std::ptrdiff_t rows) noexcept {
    if (cost.is_own) return fill_own;
    if (cost.metric == Metric::cityblock && dim == 1) return fill_pairs_with<AbsoluteCost<1>>;
    if (cost.metric == Metric::sqeuclidean) {
        if (dim == 1) return fill_pairs_with<SquaredCost<1>>;
        if (dim == 2) return fill_pairs_with<SquaredCost<2>>;
        if (dim == 3) return fill_pairs_with<SquaredCost<3>>;
    }
    if (cost.metric == Metric::euclidean && cost.squares_in_domain) {
        if (dim == 2 && mixes_roots && rows >= min_rows_of_mixed_roots) {
            return fill_pairs_with<MixedEuclideanCost>;
        }
        if (dim == 2) return fill_pairs_with<EuclideanCost<2, UniformRoot>>;
        if (dim == 3) return fill_pairs_with<EuclideanCost<3, UniformRoot>>;
    }
    return select_fill(cost);
}

}  // namespace

namespace recurrences {
const RecurrenceKernels CURVEWISE_LEVEL = {select_steps, select_pairs};
}  // namespace recurrences

}  // namespace curvewise::kernels
