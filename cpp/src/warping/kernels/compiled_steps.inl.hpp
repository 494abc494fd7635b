// Compiled steps: those of every named pattern, and those of the edit distances. For the latter,
// only the weights that are not 1 and the costs of a step are read at run time. The last term that
// several steps add in common is added once, to the least of them. Rounding never reverses an
// order, so cells are bitwise identical, and "typeIVc" adds 3 costs instead of 18.
// recurrence_set.cpp includes this file inside its anonymous namespace.

// What of a table of steps decides which code it runs.
struct Shape {
    struct Term {
        Source source;
        int diagonals_back;
        int rows_back;
        bool is_plain;  // of weight 1
    };
    struct OneStep {
        int diagonals_back;
        int rows_back;
        bool has_constant;
        int end_term;
    };
    OneStep steps[16] = {};
    Term terms[32] = {};
    int step_count = 0;
    int term_count = 0;

    constexpr int first_term(int s) const noexcept { return s == 0 ? 0 : steps[s - 1].end_term; }

    // Weights that are not 1 are known only when it runs.
    constexpr bool has_same_term(int s, int other, int depth) const noexcept {
        const int x = steps[s].end_term - 1 - depth, y = steps[other].end_term - 1 - depth;
        if (x < first_term(s) || y < first_term(other)) return false;
        return terms[x].is_plain && terms[y].is_plain && terms[x].source == terms[y].source &&
               terms[x].diagonals_back == terms[y].diagonals_back &&
               terms[x].rows_back == terms[y].rows_back;
    }
    constexpr int pair_diagonals() const noexcept {
        int most = 1;
        for (int x = 0; x < term_count; ++x) {
            const int count = terms[x].diagonals_back + 1;
            if (terms[x].source == Source::pair && count > most) most = count;
        }
        return most;
    }
    constexpr void begin_step(int rows, int columns, bool has_constant) noexcept {
        steps[step_count++] = {rows + columns, rows, has_constant, term_count};
    }
    constexpr void add(Source source, int rows, int columns, bool is_plain) noexcept {
        terms[term_count++] = {source, rows + columns, rows, is_plain};
        steps[step_count - 1].end_term = term_count;
    }
};

constexpr Shape shape_of(const StepSet& set, bool has_penalty) noexcept {
    const ParsedSteps rows = parsed(set);
    Shape shape;
    for (int i = 0; i < rows.count; ++i) {
        const StepRow& row = rows.rows[i];
        if (row.weight == -1.0) {
            shape.begin_step(row.rows, row.columns, has_penalty && row.rows != row.columns);
        } else if (row.weight != 0.0) {
            shape.add(Source::pair, row.rows, row.columns, row.weight == 1.0);
        }
    }
    return shape;
}

// The steps of matched points, with the cost of the pair, and of deleted points.
constexpr Shape edit_shape(bool has_constant, int gaps, Source row, Source column) noexcept {
    Shape shape;
    shape.begin_step(1, 1, false);
    shape.add(Source::pair, 0, 0, true);
    shape.begin_step(1, 0, has_constant);
    if (gaps > 0) shape.add(row, 0, 0, true);
    shape.begin_step(0, 1, has_constant);
    if (gaps > 0) shape.add(column, 0, 0, true);
    return shape;
}

constexpr Shape time_warp_shape() noexcept {
    Shape shape;
    shape.begin_step(1, 1, false);
    shape.add(Source::pair, 0, 0, true);
    shape.add(Source::pair, 1, 1, true);
    shape.add(Source::offset, 0, 0, false);
    shape.begin_step(1, 0, true);
    shape.add(Source::row_gap, 0, 0, true);
    shape.begin_step(0, 1, true);
    shape.add(Source::column_gap, 0, 0, true);
    return shape;
}

constexpr int pattern_count = sizeof(step_patterns) / sizeof(StepSet);
constexpr int shape_count = pattern_count + 7;

struct Shapes {
    Shape all[shape_count] = {};

    constexpr Shapes() noexcept {
        for (int i = 0; i < pattern_count; ++i) all[i] = shape_of(step_patterns[i], false);
        Shape* next = all + pattern_count;
        *next++ = shape_of(step_patterns[static_cast<int>(StepPattern::symmetric1)], true);
        *next++ = shape_of(step_patterns[static_cast<int>(StepPattern::symmetric2)], true);
        *next++ = edit_shape(false, 1, Source::row_gap, Source::column_gap);
        *next++ = edit_shape(true, 0, Source::pair, Source::pair);
        *next++ = edit_shape(false, 0, Source::pair, Source::pair);
        *next++ = edit_shape(true, 1, Source::row_move, Source::column_move);
        *next++ = time_warp_shape();
    }
};
constexpr Shapes shapes;

bool is_shape(const Shape& shape, const LaneStep* steps, std::ptrdiff_t step_count,
              const LaneTerm* terms) noexcept {
    if (step_count != shape.step_count) return false;
    for (int s = 0; s < shape.step_count; ++s) {
        const Shape::OneStep& step = shape.steps[s];
        if (step.diagonals_back != steps[s].diagonals_back ||
            step.rows_back != steps[s].rows_back || step.end_term != steps[s].end_term ||
            step.has_constant != (steps[s].constant != 0.0)) {
            return false;
        }
    }
    for (int x = 0; x < shape.term_count; ++x) {
        const Shape::Term& term = shape.terms[x];
        if (term.source != terms[x].source || term.diagonals_back != terms[x].diagonals_back ||
            term.rows_back != terms[x].rows_back || term.is_plain != (terms[x].weight == 1.0)) {
            return false;
        }
    }
    return true;
}

template <int which>
struct CompiledSteps {
    static constexpr Shape shape = shapes.all[which];
    static constexpr bool is_guarded = false;

    // The pointers that a diagonal reads, in a separate object: a store of values could change any
    // other.
    struct Sources {
        const double* values[shape.step_count];
        const double* terms[shape.term_count];
        const double* pairs[shape.pair_diagonals()];
        Pack constants[shape.step_count];
        Pack weights[shape.term_count];

        Sources(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
            for (int s = 0; s < shape.step_count; ++s) {
                values[s] = strip.values[shape.steps[s].diagonals_back] - shape.steps[s].rows_back;
                constants[s] = simd::pset1<Pack>(strip.steps[s].constant);
            }
            for (int x = 0; x < shape.term_count; ++x) {
                if (shape.terms[x].source != Source::pair) {
                    terms[x] = source_on(strip, strip.terms[x], t) - shape.terms[x].rows_back;
                }
                weights[x] = simd::pset1<Pack>(strip.terms[x].weight);
            }
            for (int b = 0; b < shape.pair_diagonals(); ++b) pairs[b] = strip.pairs[b];
        }
    };

    // A set of steps is a word of bits.
    using Set = std::uint32_t;

    static constexpr int first_of(Set steps) noexcept {
        int s = 0;
        while ((steps >> s & 1) == 0) ++s;
        return s;
    }

    // The steps whose term `depth` before their last one is equal to that of step s.
    static constexpr Set sharing(Set steps, int s, int depth) noexcept {
        Set found = Set{1} << s;
        for (int other = s + 1; other < shape.step_count; ++other) {
            if ((steps >> other & 1) != 0 && shape.has_same_term(s, other, depth)) {
                found |= Set{1} << other;
            }
        }
        return found;
    }

    template <int x>
    static Pack cost(const Sources& from, std::ptrdiff_t k) noexcept {
        constexpr Shape::Term term = shape.terms[x];
        Pack cost;
        if constexpr (term.source == Source::pair) {
            cost = load(from.pairs[term.diagonals_back] + k - term.rows_back);
        } else {
            cost = load(from.terms[x] + k);
        }
        if constexpr (!term.is_plain) {
            cost = simd::pmul(from.weights[x], cost);
        }
        return cost;
    }

    // The least over steps that have their last `depth` terms in common, before these are added.
    template <Set steps, int depth>
    static Pack least(const Sources& from, std::ptrdiff_t k) noexcept {
        constexpr int s = first_of(steps);
        constexpr int x = shape.steps[s].end_term - 1 - depth;
        constexpr Set group = x < shape.first_term(s) ? Set{1} << s : sharing(steps, s, depth);
        Pack sum;
        if constexpr (x < shape.first_term(s)) {
            sum = load(from.values[s] + k);
            if constexpr (shape.steps[s].has_constant) {
                sum = simd::padd(sum, from.constants[s]);
            }
        } else {
            sum = simd::padd(least<group, depth + 1>(from, k), cost<x>(from, k));
        }
        if constexpr (steps != group) {
            return simd::pmin(sum, least<(steps & ~group), depth>(from, k));
        } else {
            return sum;
        }
    }

    static void cells(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
        constexpr Set all_steps = (Set{1} << shape.step_count) - 1;
        const Sources from(strip, t);
        double* const values = strip.values[0];
        const std::ptrdiff_t high = strip.high_lane;
        for (std::ptrdiff_t k = strip.low_lane; k <= high; k += width) {
            store(values + k, least<all_steps, 0>(from, k));
        }
    }
};

template <bool guarded>
struct AnySteps {
    static constexpr bool is_guarded = guarded;

    static void cells(const RecurrenceStrip& strip, std::ptrdiff_t t) noexcept {
        all_cells<false, guarded>(strip, t);
    }
};
