// Rows of a table with few active cells (see narrow.hpp). The values that a diagonal passes to the
// next stay in registers. A diagonal has so little work that its stores would not be complete when
// the next one loads. Per diagonal: a ground distance, the recurrence, two bits a cell. The kernel
// of each level includes this file inside its anonymous namespace.

std::ptrdiff_t narrow(NarrowRows& rows) noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Pack x = load(rows.p), y = load(rows.p + rows.p_stride);
    const Pack most = simd::pset1<Pack>(rows.most);
    Pack cells = simd::pset1<Pack>(infinity);
    Pack diagonal = moved_up(cells, rows.corner);
    // Read once: codes are written as bytes, and for a compiler bytes may alias anything.
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
    // At least one more, unless a single lane has met the last column.
    if (width > 1 || codes < end) {
        do {
            step(infinity);
        } while (codes < end && (at_most(cells, most) | at_most(diagonal, most)) != 0);
    }
    const std::ptrdiff_t count = (codes - rows.codes) / code_bytes(width);
    rows.last = first + count - width;
    return count;
}
