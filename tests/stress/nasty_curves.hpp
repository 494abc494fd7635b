// Pairs of curves of the kinds that break such programs: ties everywhere, repeated points, curves
// of one point, signed zeros, subnormals, numbers at both ends of the range of a double, large
// offsets, curves that differ in their last bits, one far point, loops that are alike. Sizes are
// small, so that a million pairs take minutes; now and then they reach the widths of the kernels'
// strips, and, where asked for, the table size from which the measures prune.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "choices.hpp"
#include "curves.hpp"

namespace stress {

using test::Curve;

// How the coordinates of a pair are drawn.
enum class Kind {
    lattice,   // -3, ..., 3: most distances are equal to others
    real,      // -1 to 1
    offset,    // eighths beside a large number
    zeros,     // 0, -0, the smallest and some other numbers, all tiny
    extremes,  // any magnitude from the smallest to the largest double
    raw,       // any finite bit pattern
    walk,      // short steps
    loop       // a circle or an eight, run through several times
};
constexpr int kinds = 8;

// Whether products of four coordinates neither overflow nor vanish, and sums keep ten digits: what
// measures that are not exact are held to their tolerance on.
inline bool is_tame(Kind kind) {
    return kind == Kind::lattice || kind == Kind::real || kind == Kind::walk || kind == Kind::loop;
}

class NastyCurves {
   public:
    NastyCurves(Choices& choices, Kind kind, std::ptrdiff_t dim)
        : choices_(choices), kind_(kind), dim_(dim), offset_(std::ldexp(1.0, exponent())) {}

    Curve curve(std::ptrdiff_t n) {
        Curve result(std::vector<double>(static_cast<std::size_t>(n * dim_)), dim_);
        const double turns = choices_.uniform(0.5, 4.0), growth = choices_.uniform(-0.02, 0.1);
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            for (std::ptrdiff_t c = 0; c < dim_; ++c) {
                result(i, c) = coordinate(result, i, c, turns, growth);
            }
        }
        return choices_.one_in(4) ? with_plateaus(result) : result;
    }

    // A curve of its own, or one that is like P.
    Curve other(const Curve& P, std::ptrdiff_t m) {
        switch (choices_.index(8)) {
            case 0:
                return P;
            case 1:
                return reversed(P);
            case 2:
                return with_last_bits_changed(P);
            case 3:
                return with_plateaus(P);
            case 4:
                return with_one_far_point(P);
            case 5:
                return resampled(P, m);
            default:
                return curve(m);
        }
    }

   private:
    // Of the offset: up to where eighths are lost.
    int exponent() { return static_cast<int>(choices_.between(10, 51)); }

    double coordinate(const Curve& curve, std::ptrdiff_t i, std::ptrdiff_t c, double turns,
                      double growth) {
        constexpr double tiny = std::numeric_limits<double>::denorm_min();
        constexpr double small[] = {0.0,      -0.0,      tiny,       -tiny,
                                    3 * tiny, 0x1p-1022, -0x1p-1022, 0x1p-530};
        switch (kind_) {
            case Kind::lattice:
                return static_cast<double>(choices_.between(-3, 3));
            case Kind::real:
                return choices_.uniform(-1.0, 1.0);
            case Kind::offset:
                return offset_ + 0.125 * static_cast<double>(choices_.between(-8, 8));
            case Kind::zeros:
                return small[choices_.index(std::size(small))];
            case Kind::extremes:
                return extreme();
            case Kind::raw: {
                const double value = choices_.any_double();
                return std::isfinite(value) ? value : 0.0;
            }
            case Kind::walk:
                return (i > 0 ? curve(i - 1, c) : 0.0) + choices_.uniform(-0.1, 0.1);
            case Kind::loop: {
                const double angle = 6.283185307179586 * turns * static_cast<double>(i) /
                                     static_cast<double>(curve.size());
                return (1.0 + growth * angle) * (c % 2 == 0 ? std::cos(angle) : std::sin(angle));
            }
        }
        return 0.0;
    }

    // Around the places where squares overflow or vanish, and where the scaling begins.
    double extreme() {
        constexpr int exponents[] = {-1074, -1050, -1022, -600, -512, -501, -500, -499, -1,   0,
                                     1,     2,     3,     4,    499,  500,  501,  512,  1000, 1022};
        const int exponent = exponents[choices_.index(std::size(exponents))];
        const double mantissa = 1.0 + 0.25 * static_cast<double>(choices_.index(4));
        return std::ldexp(choices_.one_in(2) ? -mantissa : mantissa, exponent);
    }

    Curve with_plateaus(const Curve& curve) {
        Curve result = curve;
        for (std::ptrdiff_t i = 1; i < curve.size(); ++i) {
            if (choices_.one_in(2)) continue;
            for (std::ptrdiff_t c = 0; c < dim_; ++c) result(i, c) = result(i - 1, c);
        }
        return result;
    }

    Curve reversed(const Curve& curve) const {
        Curve result = curve;
        for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
            for (std::ptrdiff_t c = 0; c < dim_; ++c) result(i, c) = curve(curve.size() - 1 - i, c);
        }
        return result;
    }

    Curve with_last_bits_changed(const Curve& curve) {
        Curve result = curve;
        for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
            for (std::ptrdiff_t c = 0; c < dim_; ++c) {
                const double next = std::nextafter(curve(i, c), choices_.one_in(2) ? 9.0 : -9.0);
                if (choices_.one_in(2)) result(i, c) = next;
            }
        }
        return result;
    }

    Curve with_one_far_point(const Curve& curve) {
        Curve result = curve;
        double& coordinate = result(choices_.index(curve.size()), choices_.index(dim_));
        coordinate = std::abs(coordinate) < 0x1p900 ? 8.0 * coordinate + 1.0 : 0.0;
        return result;
    }

    // Points of the curve from its first to its last, a little larger, with a little noise.
    Curve resampled(const Curve& curve, std::ptrdiff_t m) {
        Curve result(std::vector<double>(static_cast<std::size_t>(m * dim_)), dim_);
        const double size = choices_.one_in(2) ? 1.0 : 1.0078125;
        const double noise = choices_.one_in(3) ? 0.0 : 0x1p-7;
        for (std::ptrdiff_t j = 0; j < m; ++j) {
            const std::ptrdiff_t i = m == 1 ? 0 : j * (curve.size() - 1) / (m - 1);
            for (std::ptrdiff_t c = 0; c < dim_; ++c) {
                const double value =
                    std::abs(curve(i, c)) < 0x1p1000 ? size * curve(i, c) : curve(i, c);
                result(j, c) =
                    noise > 0.0 && is_tame(kind_) ? value + choices_.uniform(-noise, noise) : value;
            }
        }
        return result;
    }

    Choices& choices_;
    Kind kind_;
    std::ptrdiff_t dim_;
    double offset_;
};

// Mostly a few points; one in 16 up to `long_size`.
inline std::ptrdiff_t any_size(Choices& choices, std::ptrdiff_t least, std::ptrdiff_t long_size) {
    return choices.one_in(16) ? choices.between(std::max<std::ptrdiff_t>(least, 30), long_size)
                              : choices.between(least, 12);
}

inline std::ptrdiff_t any_dimension(Choices& choices) {
    constexpr std::ptrdiff_t dimensions[] = {1, 2, 2, 2, 3, 4, 7};
    return dimensions[choices.index(std::size(dimensions))];
}

inline Kind any_kind(Choices& choices) { return static_cast<Kind>(choices.index(kinds)); }

}  // namespace stress
