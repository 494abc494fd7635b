// Points and polylines in the plane, for area, pcm and curve_length.
#pragma once

#include <cmath>
#include <cstddef>

#include "curves/box.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::curves {

using runtime::Poller;

struct Point {
    double x;
    double y;
};

inline Point operator-(const Point& a, const Point& b) noexcept { return {a.x - b.x, a.y - b.y}; }

inline double cross(const Point& a, const Point& b) noexcept { return a.x * b.y - a.y * b.x; }

// Whether the squares have neither overflowed nor vanished.
inline bool is_in_range_of_squares(double squares) noexcept {
    return squares > 0x1p-900 && squares < 0x1p1000;
}

inline double norm(const Point& a) noexcept {
    const double squares = a.x * a.x + a.y * a.y;
    return is_in_range_of_squares(squares) ? std::sqrt(squares) : std::hypot(a.x, a.y);
}

// a + h (b - a), and b itself for h = 1.
inline Point interpolate(const Point& a, const Point& b, double h) noexcept {
    if (h == 1.0) return b;
    return {a.x + h * (b.x - a.x), a.y + h * (b.y - a.y)};
}

using Polyline = runtime::ScratchVector<Point>;

// All throw Stopped where the poller says so.
Polyline polyline(const CurveView& curve, const RangeScale& range, Poller& poller);

Polyline box_scaled(const CurveView& curve, const Box& box, Poller& poller);

}  // namespace curvewise::curves
