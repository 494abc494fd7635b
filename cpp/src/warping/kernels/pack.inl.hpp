// The SIMD vector of doubles of the level that a kernel is compiled for: Eigen's packet, so that
// the same source serves SSE2, AVX2, AVX-512 and NEON. Included inside the anonymous namespace of
// the kernel of each level, before the other .inl.hpp files.

namespace simd = Eigen::internal;
using Pack = simd::packet_traits<double>::type;
constexpr std::ptrdiff_t width = simd::unpacket_traits<Pack>::size;
static_assert(width <= padding);

inline Pack load(const double* from) noexcept { return simd::ploadu<Pack>(from); }
inline void store(double* to, const Pack& pack) noexcept { simd::pstoreu(to, pack); }

// The lanes one further, the last one first; and `lanes` with the first lane of `other`.
#if defined(__AVX512F__)
inline Pack turn(const Pack& lanes) noexcept {
    const __m512i bits = _mm512_castpd_si512(lanes);
    return _mm512_castsi512_pd(_mm512_alignr_epi64(bits, bits, 7));
}
inline Pack with_first_of(const Pack& other, const Pack& lanes) noexcept {
    return _mm512_mask_blend_pd(1, lanes, other);
}
#elif defined(__AVX__)
inline Pack turn(const Pack& lanes) noexcept {
    return _mm256_shuffle_pd(_mm256_permute2f128_pd(lanes, lanes, 1), lanes, 5);
}
inline Pack with_first_of(const Pack& other, const Pack& lanes) noexcept {
    return _mm256_blend_pd(lanes, other, 1);
}
#elif defined(__SSE2__)
inline Pack turn(const Pack& lanes) noexcept { return _mm_shuffle_pd(lanes, lanes, 1); }
inline Pack with_first_of(const Pack& other, const Pack& lanes) noexcept {
    return _mm_move_sd(lanes, other);
}
#else
inline Pack turn(const Pack& lanes) noexcept {
    double from[width], to[width];
    store(from, lanes);
    for (std::ptrdiff_t l = 0; l < width; ++l) to[l] = from[(l + width - 1) % width];
    return load(to);
}
inline Pack with_first_of(const Pack& other, const Pack& lanes) noexcept {
    double to[width];
    store(to, lanes);
    to[0] = simd::pfirst(other);
    return load(to);
}
#endif
