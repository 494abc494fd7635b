#include "curves/polyline.hpp"

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

}  // namespace curvewise::detail
