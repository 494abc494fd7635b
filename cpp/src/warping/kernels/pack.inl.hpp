// The SIMD vector of doubles of the level that a kernel is compiled for: Eigen's packet, so that
// the same source serves SSE2, AVX2, AVX-512 and NEON. Included inside the anonymous namespace of
// the kernel of each level, before the other .inl.hpp files. Eigen's own macros say which vectors
// it has: none if the host defines EIGEN_DONT_VECTORIZE, or on processors that it has no packets
// for.

namespace simd = Eigen::internal;
using Pack = simd::packet_traits<double>::type;
constexpr std::ptrdiff_t width = simd::unpacket_traits<Pack>::size;
static_assert(width <= padding);

inline Pack load(const double* from) noexcept { return simd::ploadu<Pack>(from); }
inline void store(double* to, const Pack& pack) noexcept { simd::pstoreu(to, pack); }

// The lanes one further, the last one first; and `lanes` with the first lane of `other`.
#if defined(EIGEN_VECTORIZE_AVX512)
inline Pack turn(const Pack& lanes) noexcept {
    const __m512i bits = _mm512_castpd_si512(lanes);
    return _mm512_castsi512_pd(_mm512_alignr_epi64(bits, bits, 7));
}
inline Pack with_first_of(const Pack& other, const Pack& lanes) noexcept {
    return _mm512_mask_blend_pd(1, lanes, other);
}
#elif defined(EIGEN_VECTORIZE_AVX)
inline Pack turn(const Pack& lanes) noexcept {
    return _mm256_shuffle_pd(_mm256_permute2f128_pd(lanes, lanes, 1), lanes, 5);
}
inline Pack with_first_of(const Pack& other, const Pack& lanes) noexcept {
    return _mm256_blend_pd(lanes, other, 1);
}
#elif defined(EIGEN_VECTORIZE_SSE2)
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

// The lanes of a vector, each moved to the next, behind a lane of `first`, in which all are equal.
#if defined(EIGEN_VECTORIZE_AVX512)
inline Pack moved_up(const Pack& pack, const Pack& first) noexcept {
    return _mm512_castsi512_pd(
        _mm512_alignr_epi64(_mm512_castpd_si512(pack), _mm512_castpd_si512(first), 7));
}
#elif defined(EIGEN_VECTORIZE_AVX)
// By an insertion and a shuffle within halves, which take less than half as long as a permutation
// of all lanes does.
inline Pack moved_up(const Pack& pack, const Pack& first) noexcept {
    const __m256d halves = _mm256_insertf128_pd(first, _mm256_castpd256_pd128(pack), 1);
    return _mm256_shuffle_pd(halves, pack, 0b0101);
}
#elif defined(EIGEN_VECTORIZE_SSE2)
inline Pack moved_up(const Pack& pack, const Pack& first) noexcept {
    return _mm_unpacklo_pd(first, pack);
}
#else
inline Pack moved_up(const Pack& pack, const Pack& first) noexcept {
    double lanes[width + 1];
    lanes[0] = simd::pfirst(first);
    store(lanes + 1, pack);
    return load(lanes);
}
#endif
// A template, since a pack of one lane is a double: then the function above is all.
template <class Lanes, std::enable_if_t<!std::is_same_v<Lanes, double>, int> = 0>
Pack moved_up(const Lanes& pack, double first) noexcept {
    return moved_up(pack, simd::pset1<Pack>(first));
}
