// Products of windows along diagonals (see diagonals.hpp), one diagonal in each lane. The kernel of
// each level includes this file inside its anonymous namespace.

std::ptrdiff_t scan_diagonals(const Diagonals& all, std::ptrdiff_t row,
                              std::ptrdiff_t end) noexcept {
    for (; row < end; ++row) {
        const std::ptrdiff_t j = row + all.offset;
        Pack scores[diagonals_a_lane];
        for (Pack& score : scores) score = simd::pset1<Pack>(0.0);
        for (std::ptrdiff_t c = 0; c < all.dim; ++c) {
            const std::ptrdiff_t at = c * all.stride;
            const Pack half = simd::pset1<Pack>(all.halves[at + row]);
            const Pack sum = simd::pset1<Pack>(all.sums[at + row]);
            const Pack scale = simd::pset1<Pack>(all.scales[at + row]);
            const Pack slack = simd::pset1<Pack>(all.slacks[c]);
            for (std::ptrdiff_t g = 0; g < diagonals_a_lane; ++g) {
                const std::ptrdiff_t k = at + j + g * width;
                double* const place = all.products + (c * diagonals_a_lane + g) * width;
                const Pack change = simd::padd(simd::pmul(half, load(all.sums + k)),
                                               simd::pmul(load(all.halves + k), sum));
                const Pack product = simd::padd(load(place), change);
                store(place, product);
                scores[g] =
                    simd::padd(scores[g], simd::pmul(simd::pmul(simd::padd(product, slack), scale),
                                                     load(all.scales + k)));
            }
        }
        const Pack size = simd::pset1<Pack>(all.sizes[row]);
        const Pack limit = simd::pset1<Pack>(all.limits[row]);
        Pack excess = simd::pset1<Pack>(-1.0);
        for (std::ptrdiff_t g = 0; g < diagonals_a_lane; ++g) {
            const std::ptrdiff_t k = j + g * width;
            const Pack of_row = simd::psub(simd::psub(scores[g], load(all.sizes + k)), limit);
            const Pack of_column = simd::psub(simd::psub(scores[g], size), load(all.limits + k));
            excess = simd::pmax(excess, simd::pmax(of_row, of_column));
        }
        if (simd::predux_max(excess) >= 0.0) return row;
    }
    return end;
}
