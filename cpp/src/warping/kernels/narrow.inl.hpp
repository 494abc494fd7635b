// Rows of a table of which few cells are live (see narrow.hpp). What a diagonal hands to the next
// stays in registers: there is too little to do on one for its stores to be done when the next one
// loads. Per diagonal: a ground distance, the recurrence, two bits a cell. Included by the kernel
// of each level, inside its anonymous namespace.

// The lanes of a vector, each moved to the next, behind `first`.
#if defined(__AVX512F__)
inline Pack moved_up(const Pack& pack, double first) noexcept {
    const __m512i before = _mm512_castpd_si512(_mm512_set1_pd(first));
    return _mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(pack), before, 7));
}
#elif defined(__AVX__)
// By an insertion and a shuffle within halves, which take less than half as long as a permutation
// of all lanes does.
inline Pack moved_up(const Pack& pack, double first) noexcept {
    const __m256d halves =
        _mm256_insertf128_pd(_mm256_set1_pd(first), _mm256_castpd256_pd128(pack), 1);
    return _mm256_shuffle_pd(halves, pack, 0b0101);
}
#elif defined(__SSE2__)
inline Pack moved_up(const Pack& pack, double first) noexcept {
    return _mm_unpacklo_pd(_mm_set1_pd(first), pack);
}
#else
inline Pack moved_up(const Pack& pack, double first) noexcept {
    double lanes[width + 1];
    lanes[0] = first;
    store(lanes + 1, pack);
    return load(lanes);
}
#endif

std::ptrdiff_t narrow(NarrowRows& rows) noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Pack x = load(rows.p), y = load(rows.p + rows.p_stride);
    const Pack most = simd::pset1<Pack>(rows.most);
    Pack cells = simd::pset1<Pack>(infinity);
    Pack diagonal = moved_up(cells, rows.corner);
    // Read once: codes are written as bytes, of which a compiler thinks that they may lie anywhere.
    const std::ptrdiff_t first = rows.first, last = rows.last, q_stride = rows.q_stride;
    const double* const boundary = rows.boundary;
    const double* q = rows.q - first;
    double* to = rows.boundary + first - (width - 1);
    std::uint8_t* codes = rows.codes;
    const auto step = [&](double above) {
        const Pack d = simd::padd(simd::pabs(simd::psub(x, load(q))),
                                  simd::pabs(simd::psub(y, load(q + q_stride))));
        const Pack up = moved_up(cells, above);
        const Pack side = simd::pmin(up, cells);
        const std::uint64_t is_up = at_most(up, cells);
        const std::uint64_t is_diagonal = at_most(simd::padd(diagonal, d), simd::padd(side, d));
        if constexpr (width > 4) {
            *codes++ = static_cast<std::uint8_t>((is_up & 15U) | (is_diagonal & 15U) << 4U);
            *codes++ = static_cast<std::uint8_t>(is_up >> 4U | (is_diagonal & ~15U));
        } else {
            *codes++ = static_cast<std::uint8_t>(is_up | is_diagonal << 4U);
        }
        // In the order in which the three come to be known.
        cells = simd::padd(simd::pmin(up, simd::pmin(cells, diagonal)), d);
        diagonal = up;
        *to++ = simd::pfirst(simd::preverse(cells));
        --q;
    };
    for (std::ptrdiff_t t = first; t <= last; ++t) step(boundary[t]);
    const std::uint8_t* const end =
        rows.codes + (rows.columns + width - 1 - first) * code_bytes(width);
    do {
        step(infinity);
    } while (codes < end && (at_most(cells, most) | at_most(diagonal, most)) != 0);
    const std::ptrdiff_t count = (codes - rows.codes) / code_bytes(width);
    rows.last = first + count - width;
    return count;
}
