// Random pairs of curves of the kinds that make pruning hard: ties, plateaus, repeated points,
// loops that cross, spirals, one far point, curves of one point; alike, and not at all.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "curves.hpp"

namespace test {

inline Curve empty_curve(std::ptrdiff_t n, std::ptrdiff_t dim) {
    return {std::vector<double>(static_cast<std::size_t>(n * dim)), dim};
}

// A closed figure run through `turns` times, a circle or an eight in its first two coordinates;
// with `growth`, a spiral.
inline Curve loops(std::ptrdiff_t n, std::ptrdiff_t dim, double turns, double growth, bool eight) {
    Curve curve = empty_curve(n, dim);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const double angle =
            6.283185307179586 * turns * static_cast<double>(i) / static_cast<double>(n);
        const double radius = 1.0 + growth * angle;
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            const double phase = angle * (c == 1 && eight ? 2.0 : 1.0);
            curve(i, c) = radius * (c % 2 == 0 ? std::cos(phase) : std::sin(phase));
        }
    }
    return curve;
}

inline Curve walk(std::ptrdiff_t n, std::ptrdiff_t dim, double step, Random& random) {
    Curve curve = empty_curve(n, dim);
    for (std::ptrdiff_t i = 1; i < n; ++i) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            curve(i, c) = curve(i - 1, c) + random.uniform(-step, step);
        }
    }
    return curve;
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
                         random.index(2) == 0 ? 0.0 : random.uniform(-0.02, 0.1),
                         random.index(2) == 0);
    }
}

// Runs of up to `longest` equal points.
inline Curve with_plateaus(const Curve& curve, std::ptrdiff_t longest, Random& random) {
    Curve result = curve;
    for (std::ptrdiff_t i = 0; i < curve.size();) {
        const std::ptrdiff_t end = std::min(curve.size(), i + 1 + random.index(longest));
        for (std::ptrdiff_t k = i; k < end; ++k) {
            for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) result(k, c) = curve(i, c);
        }
        i = end;
    }
    return result;
}

inline Curve rounded(Curve curve, double grid) {
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            curve(i, c) = std::round(curve(i, c) * grid);
        }
    }
    return curve;
}

// The curve at m points from its first to its last, larger by a little, with noise.
inline Curve alike(const Curve& curve, std::ptrdiff_t m, Random& random) {
    const double size =
        1.0 + 0.05 * random.uniform(-1.0, 1.0) * static_cast<double>(random.index(2));
    const double noise = random.index(3) == 0 ? 0.0 : random.uniform(0.0, 0.05);
    Curve result = empty_curve(m, curve.dim());
    for (std::ptrdiff_t j = 0; j < m; ++j) {
        const std::ptrdiff_t i = m == 1 ? 0 : j * (curve.size() - 1) / (m - 1);
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            result(j, c) = size * curve(i, c) + random.uniform(-noise, noise);
        }
    }
    return result;
}

inline std::ptrdiff_t any_size(Random& random) {
    switch (random.index(4)) {
        case 0:
            return 1 + random.index(10);
        case 1:
            return 60 + random.index(10);
        case 2:
            return 120 + random.index(20);
        default:
            return 1 + random.index(400);
    }
}

struct Pair {
    Curve P;
    Curve Q;
};

inline Pair any_pair(Random& random) {
    constexpr std::ptrdiff_t dimensions[] = {1, 2, 2, 2, 3, 4, 7};
    const std::ptrdiff_t n = any_size(random), m = any_size(random);
    const std::ptrdiff_t dim = dimensions[random.index(std::size(dimensions))];
    Curve P = any_curve(n, dim, random);
    if (random.index(4) == 0) P = with_plateaus(P, 1 + random.index(80), random);
    Curve Q = random.index(3) == 0 ? any_curve(m, dim, random) : alike(P, m, random);
    if (random.index(4) == 0) Q = with_plateaus(Q, 1 + random.index(80), random);
    if (random.index(8) == 0) Q(random.index(m), random.index(dim)) += 100.0;
    if (random.index(8) == 0) P(random.index(n), 0) -= 3.0;
    if (random.index(3) == 0) {
        const double grid = random.uniform(0.5, 20.0);
        P = rounded(P, grid);
        Q = rounded(Q, grid);
    }
    if (random.index(2) == 0) std::swap(P, Q);
    return {P, Q};
}

}  // namespace test
