#include "planar.hpp"

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

Polyline box_scaled(const CurveView& curve, const Box& box) {
    Polyline points(static_cast<std::size_t>(curve.size()));
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        points[static_cast<std::size_t>(i)] = {box.x.scaled(curve(i, 0)),
                                               box.y.scaled(curve(i, 1))};
    }
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
