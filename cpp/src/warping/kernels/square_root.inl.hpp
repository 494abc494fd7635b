// Correctly rounded square roots that do not wait for the divider, for levels with fused
// multiply-add: a first guess, Goldschmidt's iteration, one correction. The kernel of each level
// includes this file inside its anonymous namespace.
//
// With y close to 1 / sqrt(x), s = x y and h = y / 2, a step r = 1/2 - s h, s += s r, h += h r
// squares the relative error of both. The last step leaves s within 2^-50 of sqrt(x) and h equally
// close to 1 / (2 sqrt(x)). Then s + h (x - s s) is the square root to about 2^-45 ulp before its
// one rounding. It is rounded correctly unless sqrt(x) lies that close to the middle between two
// doubles. Those x can be listed, and all are rounded correctly:
// tests/cpp/warping/test_square_root.cpp.
//
// (One step less and two corrections with the h of that step is one operation shorter. But its
// error is 2^-28 ulp: about one argument in 10^9 is wrong, and a third of the listed ones.)
//
// Domain: 0, and 2^-904 to 2^1020. Below, the residual would not be exact. ../packed_curve.hpp
// keeps sums of squares in this domain.
//
// The constructor starts each root and root() finishes it, so that others may come between.

#include "pack.inl.hpp"

// The hardware's instruction: any argument.
class DividerRoot {
   public:
    explicit DividerRoot(const Pack& x) noexcept : x_(x) {}
    Pack root() const noexcept { return simd::psqrt(x_); }
    static Pack of(const Pack& x) noexcept { return simd::psqrt(x); }

   private:
    Pack x_;
};

#if defined(EIGEN_VECTORIZE_AVX512)

// From a reciprocal root to 14 bits, in two steps.
class FastRoot {
   public:
    // The added number changes no x except 0, whose reciprocal root is infinite; s is 0 then. An
    // addition and a subtraction of exponents leave the multiplication units to the rest.
    explicit FastRoot(const Pack& x) noexcept
        : x_(x), y_(_mm512_rsqrt14_pd(simd::padd(x, simd::pset1<Pack>(0x1p-1000)))) {}
    Pack root() const noexcept {
        const Pack half = simd::pset1<Pack>(0.5);
        const __m512i one_less = _mm512_set1_epi64(std::int64_t{1} << 52);  // in the exponent
        Pack s = simd::pmul(x_, y_);
        Pack h = _mm512_castsi512_pd(_mm512_sub_epi64(_mm512_castpd_si512(y_), one_less));
        for (int step = 0; step < 2; ++step) {
            const Pack r = _mm512_fnmadd_pd(s, h, half);
            s = _mm512_fmadd_pd(s, r, s);
            h = _mm512_fmadd_pd(h, r, h);
        }
        return _mm512_fmadd_pd(h, _mm512_fnmadd_pd(s, s, x_), s);
    }
    static Pack of(const Pack& x) noexcept { return FastRoot(x).root(); }

   private:
    Pack x_, y_;
};
using UniformRoot = FastRoot;
constexpr bool mixes_roots = true;
constexpr bool multiplies_roots = true;  // faster than by the divider alone

#elif defined(EIGEN_VECTORIZE_AVX2) && defined(EIGEN_VECTORIZE_FMA)

// Starts from a reciprocal root to 4.8 bits: an integer less half the bits of x (Robertson, A brief
// history of InvSqrt, 2012). Then r lies between -0.0346 and 0.0338. The polynomial of r, of degree
// 5 through the Chebyshev nodes, is 1 / sqrt(1 - 2 r) to 2^-30.3. A step would leave 2^-60 if
// doubles had that many bits. For 0 the guess is finite, and s remains 0.
class FastRoot {
   public:
    explicit FastRoot(const Pack& x) noexcept : x_(x) {
        const __m256i half_bits = _mm256_srli_epi64(_mm256_castpd_si256(x), 1);
        const __m256i y = _mm256_sub_epi64(_mm256_set1_epi64x(0x5FE6EB50C7B537A9), half_bits);
        const __m256i one_less = _mm256_set1_epi64x(std::int64_t{1} << 52);  // in the exponent
        s_ = simd::pmul(x, _mm256_castsi256_pd(y));
        h_ = _mm256_castsi256_pd(_mm256_sub_epi64(y, one_less));
    }
    Pack root() const noexcept {
        const Pack half = simd::pset1<Pack>(0.5);
        Pack r = _mm256_fnmadd_pd(s_, h_, half);
        Pack q = _mm256_fmadd_pd(r, simd::pset1<Pack>(0x1.f8d92c7062284p+2),
                                 simd::pset1<Pack>(0x1.199ee57f0abb4p+2));
        q = _mm256_fmadd_pd(r, q, simd::pset1<Pack>(0x1.40009e0a4b660p+1));
        q = _mm256_fmadd_pd(r, q, simd::pset1<Pack>(0x1.7fff46371e277p+0));
        q = _mm256_fmadd_pd(r, q, simd::pset1<Pack>(0x1.ffffffc160d43p-1));
        q = _mm256_fmadd_pd(r, q, simd::pset1<Pack>(0x1.000000031457fp+0));
        Pack s = simd::pmul(s_, q);
        Pack h = simd::pmul(h_, q);
        r = _mm256_fnmadd_pd(s, h, half);
        s = _mm256_fmadd_pd(s, r, s);
        h = _mm256_fmadd_pd(h, r, h);
        return _mm256_fmadd_pd(h, _mm256_fnmadd_pd(s, s, x_), s);
    }
    static Pack of(const Pack& x) noexcept { return FastRoot(x).root(); }

   private:
    Pack x_, s_, h_;
};
// The fast root alone is as slow as the divider; both together are faster.
using UniformRoot = DividerRoot;
constexpr bool mixes_roots = true;
constexpr bool multiplies_roots = false;

#else

using FastRoot = DividerRoot;
using UniformRoot = DividerRoot;
constexpr bool mixes_roots = false;
constexpr bool multiplies_roots = false;

#endif

// Calls use(k, root) for the vectors of lanes low to high, given squares(k) of each. Every second
// vector takes the fast root, so that the divider is busy, too.
template <class Squares, class Use>
void each_second_root_fast(std::ptrdiff_t low, std::ptrdiff_t high, const Squares& squares,
                           const Use& use) noexcept {
    std::ptrdiff_t k = low;
    for (; k + width <= high; k += 2 * width) {
        use(k, DividerRoot::of(squares(k)));
        use(k + width, FastRoot::of(squares(k + width)));
    }
    if (k <= high) use(k, FastRoot::of(squares(k)));
}

// The same for levels on which the fast root alone is as slow as the divider: one of four takes it.
// The next fast root is begun before this one is finished. A processor cannot hold enough
// instructions to overlap them by itself; it would wait for each chain of multiplications.
template <class Squares, class Use>
void each_fourth_root_fast(std::ptrdiff_t low, std::ptrdiff_t high, const Squares& squares,
                           const Use& use) noexcept {
    constexpr std::ptrdiff_t together = 4 * width;
    std::ptrdiff_t k = low;
    if (high - low < 4 * together) {  // too few to come between the steps of a fast root
        for (; k <= high; k += width) use(k, DividerRoot::of(squares(k)));
        return;
    }
    FastRoot begun(squares(k));
    const auto finish = [&](std::ptrdiff_t end) {
        const Pack root = begun.root();
        for (std::ptrdiff_t j = k + width; j < end; j += width) {
            use(j, DividerRoot::of(squares(j)));
        }
        use(k, root);
    };
    for (; k + 2 * together - width <= high; k += together) {
        const FastRoot next(squares(k + together));
        finish(k + together);
        begun = next;
    }
    finish(high + 1);
}

template <class Squares, class Use>
void each_mixed_root(std::ptrdiff_t low, std::ptrdiff_t high, const Squares& squares,
                     const Use& use) noexcept {
    if constexpr (multiplies_roots) {
        each_second_root_fast(low, high, squares, use);
    } else {
        each_fourth_root_fast(low, high, squares, use);
    }
}
