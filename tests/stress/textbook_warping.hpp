// dtw and the discrete Fréchet distance in textbook form: a whole table, three loops, nothing
// skipped, no code of the library. One rule comes from the contract: if the largest coordinate of
// the curves is beyond 2^500, or below 2^-500, they are multiplied by a power of two before squares
// are taken, and the result is multiplied back. Time and memory O(n m).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "warping/oracle.hpp"

namespace textbook {

using curvewise::GroundDistance;
using curvewise::Metric;
using oracle::ground_distance;
using oracle::is_exact;
using oracle::Path;
using oracle::Rules;
using test::Curve;

constexpr double infinity = std::numeric_limits<double>::infinity();

inline bool is_euclidean(const GroundDistance& ground) {
    return ground.metric == Metric::euclidean ||
           (ground.metric == Metric::minkowski && ground.p == 2.0);
}

inline double largest_coordinate(const Curve& curve) {
    double largest = 0.0;
    for (const double x : curve.values()) largest = std::max(largest, std::abs(x));
    return largest;
}

// The k such that both curves times 2^-k can be squared; 0 if the unscaled curves can.
inline int range_exponent(const Curve& P, const Curve& Q) {
    const double largest = std::max(largest_coordinate(P), largest_coordinate(Q));
    if (largest <= 0x1p500 && (largest == 0.0 || largest >= 0x1p-500)) return 0;
    int exponent = 0;
    static_cast<void>(std::frexp(largest, &exponent));
    return exponent;
}

struct Table {
    std::ptrdiff_t n, m;
    std::vector<double> costs;   // c[i m + j]
    std::vector<double> ground;  // d(P_i, Q_j); infinite outside the window

    double& cost(std::ptrdiff_t i, std::ptrdiff_t j) {
        return costs[static_cast<std::size_t>(i * m + j)];
    }
    double& distance(std::ptrdiff_t i, std::ptrdiff_t j) {
        return ground[static_cast<std::size_t>(i * m + j)];
    }
    double cost(std::ptrdiff_t i, std::ptrdiff_t j) const {
        return costs[static_cast<std::size_t>(i * m + j)];
    }
    double distance(std::ptrdiff_t i, std::ptrdiff_t j) const {
        return ground[static_cast<std::size_t>(i * m + j)];
    }
};

// Of curves that can be squared.
inline Table filled(const Curve& P, const Curve& Q, const Rules& rules) {
    const std::ptrdiff_t n = P.size(), m = Q.size();
    const auto cells = static_cast<std::size_t>(n * m);
    Table t{n, m, std::vector<double>(cells, infinity), std::vector<double>(cells, infinity)};
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t j = 0; j < m; ++j) {
            if (!oracle::is_allowed(n, m, i, j, rules.window)) continue;
            const double d = t.distance(i, j) = ground_distance(rules.ground, P, i, Q, j);
            const double up = i > 0 ? t.cost(i - 1, j) : infinity;
            const double left = j > 0 ? t.cost(i, j - 1) : infinity;
            const double diagonal = i > 0 && j > 0 ? t.cost(i - 1, j - 1) : infinity;
            if (i == 0 && (j == 0 || rules.open_begin)) {
                t.cost(i, j) = d;
            } else if (rules.largest) {
                t.cost(i, j) = std::max(d, std::min(std::min(up, left), diagonal));
            } else {
                t.cost(i, j) =
                    std::min(std::min(up, left) + d, diagonal + rules.diagonal_weight * d);
            }
        }
    }
    return t;
}

struct Answer {
    double value = infinity;
    Path path;
    std::vector<double> table;
};

inline std::ptrdiff_t end_of(const Table& t, const Rules& rules) {
    std::ptrdiff_t end = t.m - 1;
    if (!rules.open_end) return end;
    for (std::ptrdiff_t j = t.m - 1; j >= 0; --j) {
        if (t.cost(t.n - 1, j) <= t.cost(t.n - 1, end)) end = j;
    }
    return end;
}

// Back from column j of the last row; among equals the diagonal, then (i-1, j), then (i, j-1).
inline Path traced(const Table& t, const Rules& rules, std::ptrdiff_t j) {
    std::ptrdiff_t i = t.n - 1;
    Path path{{i, j}};
    while (i > 0 || (j > 0 && !rules.open_begin)) {
        const double up = i > 0 ? t.cost(i - 1, j) : infinity;
        const double left = j > 0 ? t.cost(i, j - 1) : infinity;
        if (i == 0 || j == 0) {
            (i == 0 ? j : i) -= 1;
        } else {
            const double d = rules.largest ? 0.0 : t.distance(i, j);
            const double diagonal = t.cost(i - 1, j - 1);
            const bool goes_diagonally =
                rules.largest ? diagonal <= std::min(up, left)
                              : diagonal + rules.diagonal_weight * d <= std::min(up, left) + d;
            if (goes_diagonally || up <= left) --i;
            if (goes_diagonally || !(up <= left)) --j;
        }
        path.push_back({i, j});
    }
    std::reverse(path.begin(), path.end());
    return path;
}

// Value, path and table. For Fréchet with the Euclidean distance, the path is that of the squares,
// because fewer squares than roots are equal; the values are taken from the roots.
inline Answer answer(const Curve& P, const Curve& Q, const Rules& rules) {
    // Of degree 0, the curves are compared unscaled.
    const int k = oracle::degree(rules.ground.metric) == 0 ? 0 : range_exponent(P, Q);
    const Curve p = k == 0 ? P : P.times_power_of_two(-k);
    const Curve q = k == 0 ? Q : Q.times_power_of_two(-k);
    Table t = filled(p, q, rules);
    Answer found;
    found.value = t.cost(t.n - 1, end_of(t, rules));
    if (rules.largest && is_euclidean(rules.ground) && P.dim() > 1) {
        Rules squared = rules;
        squared.ground = {Metric::sqeuclidean};
        const Table of_squares = filled(p, q, squared);
        found.path = traced(of_squares, squared, end_of(of_squares, squared));
    } else {
        found.path = traced(t, rules, end_of(t, rules));
    }
    found.table = std::move(t.costs);
    const int exponent = k * oracle::degree(rules.ground.metric);
    found.value = std::ldexp(found.value, exponent);
    for (double& cost : found.table) cost = std::ldexp(cost, exponent);
    return found;
}

inline double value(const Curve& P, const Curve& Q, const Rules& rules) {
    return answer(P, Q, rules).value;
}

// The value alone, row by row, for tables that would not fit into the caches; not scaled.
inline double unscaled_value(const Curve& P, const Curve& Q, const Rules& rules) {
    std::vector<double> above(static_cast<std::size_t>(Q.size()), infinity), row = above;
    for (std::ptrdiff_t i = 0; i < P.size(); ++i, std::swap(above, row)) {
        for (std::ptrdiff_t j = 0; j < Q.size(); ++j) {
            const auto at = static_cast<std::size_t>(j);
            row[at] = infinity;
            if (!oracle::is_allowed(P.size(), Q.size(), i, j, rules.window)) continue;
            const double d = ground_distance(rules.ground, P, i, Q, j);
            const double side = std::min(above[at], j > 0 ? row[at - 1] : infinity);
            const double diagonal = i > 0 && j > 0 ? above[at - 1] : infinity;
            if (i == 0 && (j == 0 || rules.open_begin)) {
                row[at] = d;
            } else if (rules.largest) {
                row[at] = std::max(d, std::min(side, diagonal));
            } else {
                row[at] = std::min(side + d, diagonal + rules.diagonal_weight * d);
            }
        }
    }
    return rules.open_end ? *std::min_element(above.begin(), above.end()) : above.back();
}

}  // namespace textbook
