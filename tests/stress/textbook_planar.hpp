// area (Algorithm 1 of the paper, and by arc length), pcm and curve_length, directly by their
// definitions, quadratic if that is shorter. Decisions (the longest segment, whether a
// quadrilateral intersects itself) are computed in doubles in the stated order of operations, so
// that they agree at ties. Measured quantities are added up in long double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "curves.hpp"
#include "curvewise/area.hpp"
#include "curvewise/curve_length.hpp"

namespace textbook {

using test::Curve;
using Long = long double;

struct Point {
    double x, y;
};
using Points = std::vector<Point>;

inline Points points_of(const Curve& curve) {
    Points points;
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) points.push_back({curve(i, 0), curve(i, 1)});
    return points;
}

inline double to_34_bits(double length) {
    int exponent = 0;
    const double mantissa = std::frexp(length, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(mantissa, 34)), exponent - 34);
}

// The longest part, the first among equals, is halved until there are `count` more vertices.
inline Points bisected(const Points& curve, std::size_t count, curvewise::Spacing spacing) {
    struct Part {
        std::size_t segment;
        double begin, width, length;
    };
    std::vector<Part> parts;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const double dx = curve[i + 1].x - curve[i].x, dy = curve[i + 1].y - curve[i].y;
        const double length =
            spacing == curvewise::Spacing::x ? std::abs(dx) : std::sqrt(dx * dx + dy * dy);
        parts.push_back({i, 0.0, 1.0, to_34_bits(length)});
    }
    for (std::size_t k = 0; k < count; ++k) {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < parts.size(); ++i) {
            if (parts[i].length > parts[longest].length) longest = i;
        }
        Part& part = parts[longest];
        part.width /= 2;
        part.length /= 2;
        const Part second{part.segment, part.begin + part.width, part.width, part.length};
        parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(longest) + 1, second);
    }
    Points result;
    for (const Part& part : parts) {
        const Point a = curve[part.segment], b = curve[part.segment + 1];
        result.push_back({a.x + part.begin * (b.x - a.x), a.y + part.begin * (b.y - a.y)});
    }
    result.push_back(curve.back());
    return result;
}

struct Box {
    double width = 0.0, height = 0.0, x = 0.0, y = 0.0;  // extents, 1 where 0; lower corner
    explicit Box(const Points& points) {
        Point low = points[0], high = points[0];
        for (const Point& p : points) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
        width = high.x > low.x ? high.x - low.x : 1.0;
        height = high.y > low.y ? high.y - low.y : 1.0;
        x = low.x;
        y = low.y;
    }
};

inline std::vector<double> relative_lengths(const Points& curve, const Box& box) {
    std::vector<double> u{0.0};
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const double dx = (curve[i].x - curve[i - 1].x) / box.width;
        const double dy = (curve[i].y - curve[i - 1].y) / box.height;
        u.push_back(u.back() + std::sqrt(dx * dx + dy * dy));
    }
    const double total = u.back();
    for (double& length : u) length = total > 0.0 ? length / total : 0.0;
    u.back() = 1.0;
    return u;
}

// A vertex of each at every relative arc length of either. Of vertices at the same place the next
// of both is taken, and where only one curve has several there, the other waits.
inline std::pair<Points, Points> merged(const Points& P, const Points& Q) {
    const Box box(P);
    const std::vector<double> u[2] = {relative_lengths(P, box), relative_lengths(Q, box)};
    const Points* const curves[2] = {&P, &Q};
    std::size_t at[2] = {0, 0};
    Points faced[2] = {{P[0]}, {Q[0]}};
    while (at[0] + 1 < P.size() || at[1] + 1 < Q.size()) {
        double next[2];
        for (int side = 0; side < 2; ++side) {
            next[side] = at[side] + 1 < u[side].size() ? u[side][at[side] + 1]
                                                       : std::numeric_limits<double>::infinity();
        }
        const double here = std::min(next[0], next[1]);
        for (int side = 0; side < 2; ++side) {
            if (next[side] == here) ++at[side];
            const Point a = (*curves[side])[at[side]];
            const double begin = u[side][at[side]];
            if (here == begin || at[side] + 1 == u[side].size()) {
                faced[side].push_back(a);
                continue;
            }
            const Point b = (*curves[side])[at[side] + 1];
            const double t = (here - begin) / (u[side][at[side] + 1] - begin);
            faced[side].push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    return {faced[0], faced[1]};
}

using Quad = std::array<Point, 4>;

inline double cross(const Point& a, const Point& b, const Point& c, const Point& d) {
    return (b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x);
}

inline bool is_simple(const Quad& q) {
    int left = 0, right = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const double turn = cross(q[k], q[(k + 1) % 4], q[(k + 1) % 4], q[(k + 2) % 4]);
        left += turn >= 0 ? 1 : 0;
        right += turn <= 0 ? 1 : 0;
    }
    return left >= 3 || right >= 3;
}

inline Long area_of_simple(const Quad& q) {
    const Long ax = static_cast<Long>(q[2].x) - q[0].x, ay = static_cast<Long>(q[2].y) - q[0].y;
    const Long bx = static_cast<Long>(q[3].x) - q[1].x, by = static_cast<Long>(q[3].y) - q[1].y;
    return std::abs(ax * by - ay * bx) / 2;
}

inline Long area_rearranged(const Quad& q) {
    if (is_simple(q)) return area_of_simple(q);
    const Quad first{q[1], q[0], q[2], q[3]}, second{q[0], q[2], q[1], q[3]};
    return area_of_simple(is_simple(first) ? first : second);
}

// The two triangles where AB crosses CD.
inline std::optional<Long> triangles(const Point& A, const Point& B, const Point& C,
                                     const Point& D) {
    const auto opposite = [](double s, double t) {
        return std::min(s, t) <= 0 && std::max(s, t) >= 0 && s != t;
    };
    const double abc = cross(A, B, A, C), abd = cross(A, B, A, D);
    const double cda = cross(C, D, C, A), cdb = cross(C, D, C, B);
    if (!opposite(abc, abd) || !opposite(cda, cdb)) return std::nullopt;
    const Long total = std::abs(static_cast<Long>(abc)) + std::abs(static_cast<Long>(abd));
    return (std::abs(abc) / total * std::abs(cdb) + std::abs(abd) / total * std::abs(cda)) / 2;
}

inline Long area_of(const Quad& q, curvewise::Crossing crossing) {
    if (crossing == curvewise::Crossing::rearrange || is_simple(q)) return area_rearranged(q);
    if (const auto first = triangles(q[0], q[1], q[2], q[3])) return *first;
    if (const auto second = triangles(q[1], q[2], q[3], q[0])) return *second;
    return area_of_simple(q);
}

inline double area(const Curve& P, const Curve& Q, const curvewise::AreaOptions& options) {
    Points a = points_of(P), b = points_of(Q);
    if (options.spacing == curvewise::Spacing::arc_length) {
        std::tie(a, b) = merged(a, b);
    } else {
        if (a.size() < b.size()) std::swap(a, b);
        b = bisected(b, a.size() - b.size(), options.spacing);
    }
    Long sum = 0;
    for (std::size_t i = 0; i + 1 < a.size(); ++i) {
        const Long part = area_of({a[i], a[i + 1], b[i + 1], b[i]}, options.crossing);
        sum += options.squared ? part * part : part;
    }
    return static_cast<double>(sum);
}

// A curve in long double, with the arc length of every vertex.
struct Measured {
    std::vector<std::array<Long, 2>> points;
    std::vector<Long> lengths{0};

    Measured(const Points& given, Long x, Long y, Long width, Long height) {
        for (const Point& p : given) points.push_back({(p.x - x) / width, (p.y - y) / height});
        for (std::size_t i = 1; i < points.size(); ++i) {
            lengths.push_back(lengths.back() + std::hypot(points[i][0] - points[i - 1][0],
                                                          points[i][1] - points[i - 1][1]));
        }
    }
    // Where the point at an arc length lies: a segment and a fraction of it.
    std::pair<std::size_t, Long> place(Long at) const {
        std::size_t k = 0;
        while (k + 2 < lengths.size() && lengths[k + 1] <= at) ++k;
        const Long extent = lengths[k + 1] - lengths[k];
        return {k, extent > 0 ? std::min<Long>(1, (at - lengths[k]) / extent) : 1};
    }
    std::array<Long, 2> at(Long length) const {
        const auto [k, t] = place(length);
        return {points[k][0] + t * (points[k + 1][0] - points[k][0]),
                points[k][1] + t * (points[k + 1][1] - points[k][1])};
    }
};

inline Measured measured_by_box_of(const Curve& P, const Curve& curve) {
    const Box box(points_of(P));
    return {points_of(curve), box.x, box.y, box.width, box.height};
}

// In units of the curve's own largest magnitudes.
inline Measured measured_by_largest(const Curve& curve) {
    Long largest[2] = {0, 0};
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (int c = 0; c < 2; ++c) largest[c] = std::max<Long>(largest[c], std::abs(curve(i, c)));
    }
    for (Long& value : largest) value = value > 0 ? value : 1;
    return {points_of(curve), 0, 0, largest[0], largest[1]};
}

struct PcmAnswer {
    Long value, S, T;
    Long area_at_best;  // of the offset that was asked about
};

// By every offset of the grid; and the area at `offset`.
inline PcmAnswer pcm(const Curve& P, const Curve& Q, std::ptrdiff_t offsets, Long offset) {
    const Measured a = measured_by_box_of(P, P), b = measured_by_box_of(P, Q);
    const bool maps_p = a.lengths.back() <= b.lengths.back() * (1 + 1e-12L);
    const Measured& shorter = maps_p ? a : b;
    const Measured& longer = maps_p ? b : a;
    const Long S = shorter.lengths.back(), T = longer.lengths.back();
    const auto area_at = [&](Long o) {
        Long sum = 0, before = 0;
        for (std::size_t i = 0; i < shorter.points.size(); ++i) {
            const auto q = longer.at(std::min(shorter.lengths[i] + o, T));
            const Long d = std::hypot(q[0] - shorter.points[i][0], q[1] - shorter.points[i][1]);
            if (i > 0) sum += (before + d) / 2 * (shorter.lengths[i] - shorter.lengths[i - 1]);
            before = d;
        }
        return sum;
    };
    Long best = std::numeric_limits<Long>::infinity();
    for (std::ptrdiff_t k = 0; k < offsets; ++k) {
        const Long o = offsets == 1 ? 0
                                    : std::max<Long>(T - S, 0) * static_cast<Long>(k) /
                                          static_cast<Long>(offsets - 1);
        best = std::min(best, area_at(o));
    }
    return {best, S, T, area_at(offset)};
}

// Nothing where there is nothing to divide by; `condition` is how much larger the largest
// coordinate is than the divisor.
struct LengthAnswer {
    std::optional<double> value;
    Long condition;
};

inline LengthAnswer curve_length(const Curve& P, const Curve& Q, curvewise::LengthScale scale) {
    const Measured p = measured_by_largest(P), q = measured_by_largest(Q);
    Long sum = 0, condition = 1;
    for (std::ptrdiff_t c = 0; c < 2; ++c) {
        Long mean = 0, mean_abs = 0, low = P(0, c), high = P(0, c);
        for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
            mean += static_cast<Long>(P(i, c)) / static_cast<Long>(P.size());
            mean_abs += std::abs(static_cast<Long>(P(i, c))) / static_cast<Long>(P.size());
            low = std::min<Long>(low, P(i, c));
            high = std::max<Long>(high, P(i, c));
        }
        const Long largest = std::max(std::abs(low), std::abs(high));
        const Long divisor = scale == curvewise::LengthScale::mean       ? mean
                             : scale == curvewise::LengthScale::mean_abs ? mean_abs
                                                                         : high - low;
        if (std::abs(divisor) <= static_cast<Long>(P.size()) * 0x1p-52L * largest) {
            return {std::nullopt, 0};
        }
        condition = std::max(condition, largest / std::abs(divisor));
        for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
            const Long s = p.lengths[static_cast<std::size_t>(i)] / p.lengths.back();
            const auto [k, t] = q.place(i + 1 < P.size() ? s * q.lengths.back() : q.lengths.back());
            const auto at = static_cast<std::ptrdiff_t>(k);
            const Long there = Q(at, c) + t * (static_cast<Long>(Q(at + 1, c)) - Q(at, c));
            const Long r = std::log1p(std::abs((there - P(i, c)) / divisor));
            sum += r * r;
        }
    }
    return {static_cast<double>(std::sqrt(sum)), condition};
}

}  // namespace textbook
