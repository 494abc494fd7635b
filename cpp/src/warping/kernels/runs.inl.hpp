// All runs of a curve against boxes (see runs.hpp), some SIMD vectors of runs at a time, one run in
// each lane: O(count length d). Each step reads adjacent numbers. The mean and the deviation are
// those of the run's own numbers, in two passes. The kernel of each level includes this file inside
// its anonymous namespace.

constexpr std::ptrdiff_t run_packs = 4;  // additions that do not wait for each other
static_assert(runs_at_once % (run_packs * width) == 0);

// Finds the scales of `run_packs` vectors of runs from k on, in one coordinate.
inline void find_scales(const RunsAndBoxes& runs, std::ptrdiff_t k) noexcept {
    const Pack length = simd::pset1<Pack>(static_cast<double>(runs.length));
    Pack sums[run_packs], means[run_packs];
    for (Pack& sum : sums) sum = simd::pset1<Pack>(0.0);
    for (const double *x = runs.points + k, *end = x + runs.length; x < end; ++x) {
        for (std::ptrdiff_t g = 0; g < run_packs; ++g) {
            sums[g] = simd::padd(sums[g], load(x + g * width));
        }
    }
    for (std::ptrdiff_t g = 0; g < run_packs; ++g) {
        means[g] = simd::pdiv(sums[g], length);
        sums[g] = simd::pset1<Pack>(0.0);
    }
    for (const double *x = runs.points + k, *end = x + runs.length; x < end; ++x) {
        for (std::ptrdiff_t g = 0; g < run_packs; ++g) {
            const Pack delta = simd::psub(load(x + g * width), means[g]);
            sums[g] = simd::padd(sums[g], simd::pmul(delta, delta));
        }
    }
    for (std::ptrdiff_t g = 0; g < run_packs; ++g) {
        const Pack deviation = simd::psqrt(simd::pdiv(sums[g], length));
        store(runs.means + k + g * width, means[g]);
        store(runs.scales + k + g * width, simd::pdiv(simd::pset1<Pack>(1.0), deviation));
    }
}

template <class Norm, int fixed_dim, bool of_largest>
void run_totals(const RunsAndBoxes& runs) noexcept {
    const std::ptrdiff_t dim = fixed_dim > 0 ? fixed_dim : runs.dim;
    for (std::ptrdiff_t k = 0; k < runs.count; k += run_packs * width) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) find_scales(runs, c * runs.stride + k);
        Pack totals[run_packs];
        for (Pack& total : totals) total = simd::pset1<Pack>(0.0);
        for (std::ptrdiff_t i = 0; i < runs.length; ++i) {
            const double* const low = runs.boxes + i * 2 * dim;
            const double* const high = low + dim;
            for (std::ptrdiff_t g = 0; g < run_packs; ++g) {
                Pack sum = simd::pset1<Pack>(0.0);
                for (std::ptrdiff_t c = 0; c < dim; ++c) {
                    const std::ptrdiff_t at = c * runs.stride + k + g * width;
                    const Pack x =
                        simd::pmul(simd::psub(load(runs.points + at + i), load(runs.means + at)),
                                   load(runs.scales + at));
                    const Pack inside = simd::pmax(simd::pmin(x, simd::pset1<Pack>(high[c])),
                                                   simd::pset1<Pack>(low[c]));
                    sum = Norm::add(sum, simd::psub(x, inside));
                }
                const Pack distance = Norm::finish(sum);
                totals[g] =
                    of_largest ? simd::pmax(totals[g], distance) : simd::padd(totals[g], distance);
            }
        }
        for (std::ptrdiff_t g = 0; g < run_packs; ++g) {
            store(runs.totals + k + g * width, totals[g]);
        }
    }
}

template <class Norm, bool of_largest>
RunFunction select_runs_in(std::ptrdiff_t dim) noexcept {
    if (dim == 1) return run_totals<Norm, 1, of_largest>;
    if (dim == 2) return run_totals<Norm, 2, of_largest>;
    if (dim == 3) return run_totals<Norm, 3, of_largest>;
    return run_totals<Norm, 0, of_largest>;
}

RunFunction select_runs(Metric metric, std::ptrdiff_t dim, bool of_largest) noexcept {
    return with_row<PackArithmetic, DividerRoot>(metric, [=](auto row) -> RunFunction {
        using Row = decltype(row);
        if constexpr (Row::is_norm) {
            return of_largest ? select_runs_in<Row, true>(dim) : select_runs_in<Row, false>(dim);
        } else {
            return nullptr;
        }
    });
}
