#include "curves/arc_length.hpp"

#include <stdexcept>
#include <string>

#include "runtime/scratch.hpp"

namespace curvewise::curves {

runtime::ScratchVector<double> arc_lengths(const Polyline& curve, Poller& poller) {
    const auto size = static_cast<std::ptrdiff_t>(curve.size());
    return summed_edges(size, poller, [&](std::ptrdiff_t first, EdgeBlock& edges) {
        const Point* const from = curve.data() + first;
        for (std::size_t k = 0; k < edges.count; ++k) {
            edges.x[k] = from[k + 1].x - from[k].x;
            edges.y[k] = from[k + 1].y - from[k].y;
        }
    });
}

runtime::ScratchVector<double> box_scaled_arc_lengths(const CurveView& curve, const Box& box,
                                                      Poller& poller) {
    return summed_edges(curve.size(), poller, [&](std::ptrdiff_t first, EdgeBlock& edges) {
        for (std::size_t k = 0; k < edges.count; ++k) {
            const std::ptrdiff_t i = first + static_cast<std::ptrdiff_t>(k);
            edges.x[k] = box.x.scaled_difference(curve(i, 0), curve(i + 1, 0));
            edges.y[k] = box.y.scaled_difference(curve(i, 1), curve(i + 1, 1));
        }
    });
}

void check_length(const CurveView& curve, const std::string& name, const char* measure,
                  Poller& poller) {
    for (std::ptrdiff_t i = 1; i < curve.size(); ++i) {
        poller.poll_in_loop(static_cast<std::size_t>(i));
        if (curve(i, 0) != curve(0, 0) || curve(i, 1) != curve(0, 1)) return;
    }
    throw std::invalid_argument(name + " has zero length (all its points are equal); " + measure +
                                " needs two different points");
}

}  // namespace curvewise::curves
