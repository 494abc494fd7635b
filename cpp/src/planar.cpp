#include "planar.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace curvewise::detail {

Polyline polyline(const CurveView& curve, const RangeScale& range) {
    Polyline points(static_cast<std::size_t>(curve.size()));
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        points[static_cast<std::size_t>(i)] = {range.shrink(curve(i, 0)),
                                               range.shrink(curve(i, 1))};
    }
    return points;
}

Box::Box(const Polyline& curve) noexcept : low(curve.front()), extent{} {
    Point high = low;
    for (const Point& point : curve) {
        low = {std::min(low.x, point.x), std::min(low.y, point.y)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    extent = {high.x > low.x ? high.x - low.x : 1.0, high.y > low.y ? high.y - low.y : 1.0};
}

Polyline Box::scaled(const Polyline& curve) const {
    Polyline points(curve.size());
    std::transform(curve.begin(), curve.end(), points.begin(),
                   [this](const Point& point) { return scaled(point); });
    return points;
}

std::vector<double> arc_lengths(const Polyline& curve) {
    std::vector<double> lengths(curve.size(), 0.0);
    for (std::size_t i = 1; i < curve.size(); ++i) {
        lengths[i] = lengths[i - 1] + norm(curve[i] - curve[i - 1]);
    }
    return lengths;
}

void check_length(double length, const char* name, const char* measure) {
    if (length > 0.0) return;
    throw std::invalid_argument(std::string(name) +
                                " has zero length (all its points are equal); " + measure +
                                " needs two different points");
}

}  // namespace curvewise::detail
