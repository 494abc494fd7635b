// The continuous Fréchet distance as Alt & Godau (1995) have it: the smallest of all critical
// values for which a path leads through the free space. With coordinates that are small whole
// numbers every critical value is the root of a quotient of whole numbers, and every decision is
// made in 128 bits, exactly. For other coordinates there is the decision alone, with 113 bits
// instead of 53. The library does neither: it searches between doubles. Time O((n^2 m + n m^2) log
// n + n m log n) for curves of n and m points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "curves.hpp"

namespace textbook {

using test::Curve;

__extension__ using Wide = __int128;
#ifdef __SIZEOF_FLOAT128__
__extension__ using Real = __float128;
#else
using Real = long double;  // 113 bits, or else too_few_bits
#endif
constexpr bool has_113_bits = sizeof(Real) == 16 && static_cast<Real>(1) + 0x1p-110L != 1;

// A squared distance, numerator / denominator.
struct Ratio {
    Wide numerator, denominator;
    friend bool operator<(const Ratio& x, const Ratio& y) {
        return x.numerator * y.denominator < y.numerator * x.denominator;
    }
};

// Of one edge and one vertex, in whole numbers: with u along the edge and w to the vertex, u.u,
// u.w and w.w.
template <class Number>
struct Products {
    Number length = 0, along = 0, distance = 0;
    Products(const Curve& edges, std::ptrdiff_t i, const Curve& points, std::ptrdiff_t j) {
        const std::ptrdiff_t next = std::min(i + 1, edges.size() - 1);
        for (std::ptrdiff_t c = 0; c < edges.dim(); ++c) {
            const Number u = static_cast<Number>(edges(next, c)) - static_cast<Number>(edges(i, c));
            const Number w = static_cast<Number>(points(j, c)) - static_cast<Number>(edges(i, c));
            length += u * u;
            along += u * w;
            distance += w * w;
        }
    }
};

// Decides in whole numbers. A position on an edge, times length and denominator, is
// whole + sign sqrt(radicand).
class ExactRule {
   public:
    struct Position {
        Wide whole, radicand;
        int sign;
    };
    struct Part {
        Position low, high;
    };

    explicit ExactRule(const Ratio& square) : square_(square) {}

    bool is_within(const Curve& P, std::ptrdiff_t i, const Curve& Q, std::ptrdiff_t j) const {
        const Products<Wide> of(P, i, Q, j);
        return of.distance * square_.denominator <= square_.numerator;
    }
    // The part of an edge within the radius of a vertex.
    std::optional<Part> free(const Curve& edges, std::ptrdiff_t i, const Curve& points,
                             std::ptrdiff_t j) const {
        const Products<Wide> of(edges, i, points, j);
        const Wide b = square_.denominator;
        if (of.length == 0) {
            if (!is_within(edges, i, points, j)) return std::nullopt;
            return Part{{0, 0, 0}, {0, 0, 0}};
        }
        const Wide c = b * of.along * of.along - of.length * (b * of.distance - square_.numerator);
        if (c < 0) return std::nullopt;
        const Position start{0, 0, 0}, end{b * of.length, 0, 0};
        Position low{b * of.along, b * c, -1}, high{b * of.along, b * c, 1};
        if (less(low, start)) low = start;
        if (less(end, high)) high = end;
        if (less(high, low)) return std::nullopt;
        return Part{low, high};
    }
    static bool less(const Position& x, const Position& y) {
        // The sign of (x.whole - y.whole) + x.sign sqrt(x.radicand) - y.sign sqrt(y.radicand).
        return sign(x.whole - y.whole, x.sign < 0 ? -x.radicand : x.sign * x.radicand,
                    y.sign < 0 ? y.radicand : -y.sign * y.radicand) < 0;
    }

   private:
    static int sign_of(Wide x) { return (x > 0) - (x < 0); }
    static Wide magnitude(Wide x) { return x < 0 ? -x : x; }
    // Of x + root(c) + root(e), where root(-c) = -root(c).
    static int sign(Wide x, Wide c, Wide e) {
        const int roots = sign_of(c + e), whole = sign_of(x);
        if (whole * roots >= 0) return whole != 0 ? whole : roots;
        // |root(c) + root(e)| against |x|, both squared: |c| + |e| ± 2 sqrt(|c e|) against x^2.
        const Wide rest = x * x - magnitude(c) - magnitude(e);
        const int product = sign_of(c) * sign_of(e);
        const Wide four = 4 * magnitude(c) * magnitude(e);
        int larger = sign_of(rest);
        if (product > 0) larger = rest <= 0 ? -1 : sign_of(rest * rest - four);
        if (product < 0) larger = rest >= 0 ? 1 : -sign_of(rest * rest - four);
        return whole * larger;
    }

    Ratio square_;
};

// Decides with 113 bits.
class RealRule {
   public:
    using Position = Real;
    struct Part {
        Position low, high;
    };
    explicit RealRule(Real radius) : square_(radius * radius) {}

    bool is_within(const Curve& P, std::ptrdiff_t i, const Curve& Q, std::ptrdiff_t j) const {
        return Products<Real>(P, i, Q, j).distance <= square_;
    }
    std::optional<Part> free(const Curve& edges, std::ptrdiff_t i, const Curve& points,
                             std::ptrdiff_t j) const {
        const Products<Real> of(edges, i, points, j);
        if (of.length == 0) {
            if (of.distance > square_) return std::nullopt;
            return Part{0, 0};
        }
        const Real c = of.along * of.along - of.length * (of.distance - square_);
        if (c < 0) return std::nullopt;
        const Real root = square_root(c);
        const Part part{std::max<Real>(0, of.along - root), std::min(of.length, of.along + root)};
        if (part.high < part.low) return std::nullopt;
        return part;
    }
    static bool less(Position x, Position y) { return x < y; }

   private:
    // By Newton's method from the root of the nearest double; 0 below the range of doubles.
    static Real square_root(Real x) {
        const auto start = static_cast<Real>(std::sqrt(static_cast<double>(x)));
        if (!(start > 0)) return 0;
        const Real better = (start + x / start) / 2;
        return (better + x / better) / 2;
    }
    Real square_;
};

// Whether a path leads up and to the right through the free space. A curve of one point is an edge
// of no length.
template <class Rule>
bool is_long_enough(const Rule& rule, const Curve& P, const Curve& Q) {
    using Part = typename Rule::Part;
    const std::ptrdiff_t n = std::max<std::ptrdiff_t>(P.size() - 1, 1);
    const std::ptrdiff_t m = std::max<std::ptrdiff_t>(Q.size() - 1, 1);
    if (!rule.is_within(P, 0, Q, 0) || !rule.is_within(P, P.size() - 1, Q, Q.size() - 1)) {
        return false;
    }
    // The reachable part of the lower sides of a row of cells (edges of Q, for a vertex of P), and
    // of the left side of the next cell (an edge of P, for a vertex of Q).
    const auto vertex = [](const Curve& curve, std::ptrdiff_t i) {
        return std::min(i, curve.size() - 1);
    };
    const auto at_start = [](const std::optional<Part>& part) {
        return part && !Rule::less(typename Rule::Position{}, part->low);
    };
    const auto cut = [](std::optional<Part> part, const std::optional<Part>& from) {
        if (!part || !from) return std::optional<Part>();
        if (Rule::less(part->low, from->low)) part->low = from->low;
        return Rule::less(part->high, part->low) ? std::nullopt : part;
    };
    std::vector<std::optional<Part>> lower(static_cast<std::size_t>(m));
    for (std::ptrdiff_t j = 0; j < m; ++j) {
        const auto part = rule.free(Q, j, P, 0);
        if (!at_start(part)) break;
        lower[static_cast<std::size_t>(j)] = part;
        if (!rule.is_within(P, 0, Q, vertex(Q, j + 1))) break;
    }
    bool column_reached = true;  // whether all of P's first vertices are reachable at Q's first
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        std::optional<Part> left;
        if (column_reached && rule.is_within(P, i, Q, 0)) left = rule.free(P, i, Q, 0);
        if (!at_start(left)) left = std::nullopt;
        column_reached = left && rule.is_within(P, vertex(P, i + 1), Q, 0);
        for (std::ptrdiff_t j = 0; j < m; ++j) {
            std::optional<Part>& below = lower[static_cast<std::size_t>(j)];
            const auto top = rule.free(Q, j, P, vertex(P, i + 1));
            const auto right = rule.free(P, i, Q, vertex(Q, j + 1));
            const auto upper = left ? top : cut(top, below);
            const auto next = below ? right : cut(right, left);
            below = upper;
            left = next;
        }
    }
    return lower.back().has_value();
}

// All squared radii at which the free space may change.
inline std::vector<Ratio> critical_squares(const Curve& P, const Curve& Q) {
    std::vector<Ratio> squares;
    for (const bool swapped : {false, true}) {
        const Curve& edges = swapped ? Q : P;
        const Curve& points = swapped ? P : Q;
        for (std::ptrdiff_t i = 0; i < edges.size(); ++i) {
            for (std::ptrdiff_t j = 0; j < points.size(); ++j) {
                const Products<Wide> of(edges, i, points, j);
                squares.push_back({of.distance, 1});
                if (of.length == 0) continue;
                // The foot of the perpendicular: |w|^2 - (u.w)^2 / |u|^2.
                squares.push_back({of.distance * of.length - of.along * of.along, of.length});
                for (std::ptrdiff_t k = 0; k < j; ++k) {
                    // Where the edge is as far from the one vertex as from the other, t = s / (2
                    // r): |w - t u|^2 = w.w - 2 t u.w + t^2 u.u.
                    const Products<Wide> other(edges, i, points, k);
                    const Wide s = of.distance - other.distance, r = of.along - other.along;
                    if (r == 0) continue;
                    squares.push_back(
                        {4 * r * r * of.distance - 4 * r * s * of.along + s * s * of.length,
                         4 * r * r});
                }
            }
        }
    }
    std::sort(squares.begin(), squares.end());
    return squares;
}

// The square of the continuous Fréchet distance of curves in small whole numbers.
inline Ratio continuous_square(const Curve& P, const Curve& Q) {
    const std::vector<Ratio> squares = critical_squares(P, Q);
    std::size_t low = 0, high = squares.size() - 1;
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (is_long_enough(ExactRule(squares[middle]), P, Q)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return squares[low];
}

// -1, 0 or 1: whether x is below, at, or above the root of a ratio. In whole numbers: x = k 2^e
// with k of 53 bits.
inline int compare_with_root(double x, const Ratio& square) {
    if (square.numerator == 0) return x > 0.0 ? 1 : 0;
    if (!(x > 0.0)) return -1;
    int exponent = 0;
    const auto k = static_cast<Wide>(std::ldexp(std::frexp(x, &exponent), 53));
    exponent -= 53;
    // Far from it, whole numbers would overflow, and doubles are good enough.
    const double ratio =
        x * x * static_cast<double>(square.denominator) / static_cast<double>(square.numerator);
    if (ratio < 0.5 || ratio > 2.0) return ratio < 1.0 ? -1 : 1;
    const Wide left = k * k * square.denominator;
    const Wide right = square.numerator << (-2 * exponent);
    return (left > right) - (left < right);
}

}  // namespace textbook
