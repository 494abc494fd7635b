#include "curves/polyline.hpp"

#include <cstring>

namespace curvewise::curves {

namespace {

// The points of a curve, by point(i).
template <class MakePoint>
Polyline points_of(const CurveView& curve, Poller& poller, MakePoint point) {
    Polyline points;
    points.reserve(static_cast<std::size_t>(curve.size()));
    poller.in_runs(curve.size(), 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = first; i < end; ++i) points.push_back(point(i));
    });
    return points;
}

}  // namespace

Polyline polyline(const CurveView& curve, const RangeScale& range, Poller& poller) {
    static_assert(sizeof(Point) == 2 * sizeof(double), "x and y side by side");
    if (const double* const all = curve.row_major(); all != nullptr && range.is_identity()) {
        Polyline points(static_cast<std::size_t>(curve.size()));
        poller.in_runs(curve.size(), 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
            const auto count = static_cast<std::size_t>(end - first);
            std::memcpy(points.data() + first, all + 2 * first, count * sizeof(Point));
        });
        return points;
    }
    return points_of(curve, poller, [&](std::ptrdiff_t i) -> Point {
        return {range.shrink(curve(i, 0)), range.shrink(curve(i, 1))};
    });
}

Polyline box_scaled(const CurveView& curve, const Box& box, Poller& poller) {
    return points_of(curve, poller, [&](std::ptrdiff_t i) -> Point {
        return {box.x.scaled(curve(i, 0)), box.y.scaled(curve(i, 1))};
    });
}

}  // namespace curvewise::curves
