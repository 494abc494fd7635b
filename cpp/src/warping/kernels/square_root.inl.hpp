// A correctly rounded square root that does not wait for the divider, where the level has fused
// multiply-add and 14-bit reciprocal square roots: Goldschmidt's iteration and one correction.
// Included by the kernel of each level, inside its anonymous namespace.
//
// With y = rsqrt14(x), s = x y and h = y / 2, two steps r = 1/2 - s h, s += s r, h += h r leave s
// within two ulps of sqrt(x) and h within 2^-51 of 1 / (2 sqrt(x)), relatively. Then
// s + h (x - s s), with an exact residual, is the square root to about 2^-50 ulp before its one
// rounding, so that it is rounded right unless sqrt(x) lies that close to the middle between two
// doubles. Those x can be listed, and all come out right: tests/cpp/warping/test_square_root.cpp.
//
// (To step once and correct twice with the h of that step is one operation shorter. Its error is
// 2^-28 ulp: one argument in some 10^9 comes out wrong, and a third of the listed ones.)
//
// Domain: 0, and 2^-904 to 2^1020: below, the residual would not be exact. What keeps sums of
// squares in it is in ../packed_curve.hpp.

#include "pack.inl.hpp"

// The hardware's instruction: any argument.
struct DividerRoot {
    static Pack of(const Pack& x) noexcept { return simd::psqrt(x); }
};

#ifdef __AVX512F__

struct FastRoot {
    static Pack of(const Pack& x) noexcept {
        const Pack half = simd::pset1<Pack>(0.5);
        // The smallest x above 0 stands for 0, whose reciprocal root is infinite; s is 0 then.
        const Pack y = _mm512_rsqrt14_pd(simd::pmax(x, simd::pset1<Pack>(0x1p-904)));
        Pack s = simd::pmul(x, y);
        Pack h = simd::pmul(y, half);
        for (int step = 0; step < 2; ++step) {
            const Pack r = _mm512_fnmadd_pd(s, h, half);
            s = _mm512_fmadd_pd(s, r, s);
            h = _mm512_fmadd_pd(h, r, h);
        }
        return _mm512_fmadd_pd(h, _mm512_fnmadd_pd(s, s, x), s);
    }
};

#else

// AVX2 has no such start. One of its own (an integer's shift, then a polynomial of degree 4 to
// 2^-26, one step, one correction) makes 0.87 of 10^9 cells a second where the
// divider makes 1.40, which is its limit (Zen, nine cycles for four roots); for every second
// vector 1.23, for every third 1.39.
using FastRoot = DividerRoot;

#endif
