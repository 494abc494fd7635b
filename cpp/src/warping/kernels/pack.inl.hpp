// The SIMD vector of doubles of the level that a kernel is compiled for: Eigen's packet, so that
// the same source serves SSE2, AVX2, AVX-512 and NEON. Included inside the anonymous namespace of
// the kernel of each level, before the other .inl.hpp files.

namespace simd = Eigen::internal;
using Pack = simd::packet_traits<double>::type;
constexpr std::ptrdiff_t width = simd::unpacket_traits<Pack>::size;
static_assert(width <= padding);

inline Pack load(const double* from) noexcept { return simd::ploadu<Pack>(from); }
inline void store(double* to, const Pack& pack) noexcept { simd::pstoreu(to, pack); }
