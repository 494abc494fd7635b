// Curves, and pairs of curves, that often break such programs or make pruning hard: ties
// everywhere, plateaus, repeated points, single points, signed zeros, subnormals, numbers at both
// ends of the range of a double. Also large offsets, curves that differ in their last bits, one far
// point, loops that cross, spirals. Pairs may be similar or not.
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

namespace test {

inline Curve empty_curve(std::ptrdiff_t n, std::ptrdiff_t dim) {
    return {std::vector<double>(static_cast<std::size_t>(n * dim)), dim};
}

// coordinate(i, c) for every coordinate.
template <class Coordinate>
Curve filled_curve(std::ptrdiff_t n, std::ptrdiff_t dim, Coordinate coordinate) {
    Curve curve = empty_curve(n, dim);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) curve(i, c) = coordinate(i, c);
    }
    return curve;
}

// A closed figure run through `turns` times, a circle or an eight in its first two coordinates;
// with `growth`, a spiral.
inline Curve loops(std::ptrdiff_t n, std::ptrdiff_t dim, double turns, double growth, bool eight) {
    return filled_curve(n, dim, [=](std::ptrdiff_t i, std::ptrdiff_t c) {
        const double angle =
            6.283185307179586 * turns * static_cast<double>(i) / static_cast<double>(n);
        const double phase = angle * (c == 1 && eight ? 2.0 : 1.0);
        return (1.0 + growth * angle) * (c % 2 == 0 ? std::cos(phase) : std::sin(phase));
    });
}

inline Curve walk(std::ptrdiff_t n, std::ptrdiff_t dim, double step, Choices& choices) {
    Curve curve = empty_curve(n, dim);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            curve(i, c) = (i > 0 ? curve(i - 1, c) : 0.0) + choices.uniform(-step, step);
        }
    }
    return curve;
}

// Runs of up to `longest` equal points.
inline Curve with_plateaus(const Curve& curve, std::ptrdiff_t longest, Choices& choices) {
    std::ptrdiff_t from = 0, end = 0;
    return filled_curve(curve.size(), curve.dim(), [&](std::ptrdiff_t i, std::ptrdiff_t c) {
        if (i == end) {
            from = i;
            end = i + 1 + choices.index(longest);
        }
        return curve(from, c);
    });
}

inline Curve rounded(const Curve& curve, double grid) {
    return filled_curve(curve.size(), curve.dim(), [&](std::ptrdiff_t i, std::ptrdiff_t c) {
        return std::round(curve(i, c) * grid);
    });
}

inline Curve reversed(const Curve& curve) {
    return filled_curve(curve.size(), curve.dim(), [&](std::ptrdiff_t i, std::ptrdiff_t c) {
        return curve(curve.size() - 1 - i, c);
    });
}

inline Curve with_last_bits_changed(const Curve& curve, Choices& choices) {
    return filled_curve(curve.size(), curve.dim(), [&](std::ptrdiff_t i, std::ptrdiff_t c) {
        const double next = std::nextafter(curve(i, c), choices.one_in(2) ? 9.0 : -9.0);
        return choices.one_in(2) ? next : curve(i, c);
    });
}

inline Curve with_one_far_point(Curve curve, Choices& choices) {
    double& coordinate = curve(choices.index(curve.size()), choices.index(curve.dim()));
    coordinate = std::abs(coordinate) < 0x1p900 ? 8.0 * coordinate + 1.0 : 0.0;
    return curve;
}

// Points of the curve from its first to its last, `size` times as large as far as that is finite,
// with noise.
inline Curve resampled(const Curve& curve, std::ptrdiff_t m, double size, double noise,
                       Choices& choices) {
    return filled_curve(m, curve.dim(), [&](std::ptrdiff_t j, std::ptrdiff_t c) {
        const double x = curve(m == 1 ? 0 : j * (curve.size() - 1) / (m - 1), c);
        const double value = std::abs(x) < 0x1p1000 ? size * x : x;
        return noise > 0.0 ? value + choices.uniform(-noise, noise) : value;
    });
}

// The curve at m points, slightly larger or smaller, with or without noise.
inline Curve alike(const Curve& curve, std::ptrdiff_t m, Choices& choices) {
    const double size = choices.one_in(2) ? 1.0 : 1.0 + choices.uniform(-0.05, 0.05);
    const double noise = choices.one_in(3) ? 0.0 : choices.uniform(0.0, 0.05);
    return resampled(curve, m, size, noise, choices);
}

// How the coordinates of a pair are drawn.
enum class Kind {
    lattice,   // -3, ..., 3: most distances are equal to others
    real,      // -1 to 1
    offset,    // eighths added to a large number
    zeros,     // 0, -0, the smallest and some other numbers, all tiny
    extremes,  // any magnitude from the smallest to the largest double
    raw,       // any finite bit pattern
    walk,      // short steps
    loop       // a circle, run through several times, or a spiral
};
constexpr int kinds = 8;

// Whether products of four coordinates neither overflow nor vanish, and sums keep ten digits: what
// measures that are not exact are held to their tolerance on.
inline bool is_tame(Kind kind) {
    return kind == Kind::lattice || kind == Kind::real || kind == Kind::walk || kind == Kind::loop;
}

// Curves of one kind: a first one, and others that may be like it.
class HardCurves {
   public:
    HardCurves(Choices& choices, Kind kind, std::ptrdiff_t dim)
        : choices_(choices),
          kind_(kind),
          dim_(dim),
          // Up to where eighths are lost.
          offset_(std::ldexp(1.0, static_cast<int>(choices.between(10, 51)))) {}

    Curve curve(std::ptrdiff_t n) {
        const Curve result = plain(n);
        return choices_.one_in(4) ? with_plateaus(result, 4, choices_) : result;
    }

    // An independent curve, or one that is like P.
    Curve other(const Curve& P, std::ptrdiff_t m) {
        switch (choices_.index(8)) {
            case 0:
                return P;
            case 1:
                return reversed(P);
            case 2:
                return with_last_bits_changed(P, choices_);
            case 3:
                return with_plateaus(P, 4, choices_);
            case 4:
                return with_one_far_point(P, choices_);
            case 5: {
                const double size = choices_.one_in(2) ? 1.0 : 1.0078125;
                const bool is_exact = choices_.one_in(3) || !is_tame(kind_);
                return resampled(P, m, size, is_exact ? 0.0 : 0x1p-7, choices_);
            }
            default:
                return curve(m);
        }
    }

   private:
    Curve plain(std::ptrdiff_t n) {
        const double turns = choices_.uniform(0.5, 4.0), growth = choices_.uniform(-0.02, 0.1);
        if (kind_ == Kind::loop) return loops(n, dim_, turns, growth, false);
        if (kind_ == Kind::walk) return walk(n, dim_, 0.1, choices_);
        return filled_curve(n, dim_, [&](std::ptrdiff_t, std::ptrdiff_t) { return coordinate(); });
    }

    double coordinate() {
        constexpr double tiny = std::numeric_limits<double>::denorm_min();
        constexpr double small[] = {0.0,      -0.0,      tiny,       -tiny,
                                    3 * tiny, 0x1p-1022, -0x1p-1022, 0x1p-530};
        switch (kind_) {
            case Kind::lattice:
                return static_cast<double>(choices_.between(-3, 3));
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
            case Kind::real:
            case Kind::walk:
            case Kind::loop:
                break;
        }
        return choices_.uniform(-1.0, 1.0);
    }

    // Around the places where squares overflow or vanish, and where the scaling begins.
    double extreme() {
        constexpr int exponents[] = {-1074, -1050, -1022, -600, -512, -501, -500, -499, -1,   0,
                                     1,     2,     3,     4,    499,  500,  501,  512,  1000, 1022};
        const int exponent = exponents[choices_.index(std::size(exponents))];
        const double mantissa = 1.0 + 0.25 * static_cast<double>(choices_.index(4));
        return std::ldexp(choices_.one_in(2) ? -mantissa : mantissa, exponent);
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

// Sizes around those of pruning's blocks. Pruning is tried for long or similar curves.
inline std::ptrdiff_t any_block_size(Choices& choices) {
    switch (choices.index(4)) {
        case 0:
            return choices.between(1, 10);
        case 1:
            return choices.between(60, 69);
        case 2:
            return choices.between(120, 139);
        default:
            return choices.between(1, 400);
    }
}

inline Curve any_curve(std::ptrdiff_t n, std::ptrdiff_t dim, Random& random) {
    switch (random.index(6)) {
        case 0:
            return random.curve(n, dim);
        case 1:
            return random.lattice_curve(n, dim);
        case 2:
            return walk(n, dim, 0.1, random);
        default:
            return loops(n, dim, random.uniform(0.5, 6.0),
                         random.one_in(2) ? 0.0 : random.uniform(-0.02, 0.1), random.one_in(2));
    }
}

struct Pair {
    Curve P;
    Curve Q;
};

inline Pair any_pair(Random& random) {
    const std::ptrdiff_t n = any_block_size(random), m = any_block_size(random);
    const std::ptrdiff_t dim = any_dimension(random);
    Curve P = any_curve(n, dim, random);
    if (random.one_in(4)) P = with_plateaus(P, 1 + random.index(80), random);
    Curve Q = random.one_in(3) ? any_curve(m, dim, random) : alike(P, m, random);
    if (random.one_in(4)) Q = with_plateaus(Q, 1 + random.index(80), random);
    if (random.one_in(8)) Q(random.index(m), random.index(dim)) += 100.0;
    if (random.one_in(8)) P(random.index(n), 0) -= 3.0;
    if (random.one_in(3)) {
        const double grid = random.uniform(0.5, 20.0);
        P = rounded(P, grid);
        Q = rounded(Q, grid);
    }
    if (random.one_in(2)) std::swap(P, Q);
    return {P, Q};
}

}  // namespace test
