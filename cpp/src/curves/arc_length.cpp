#include "curves/arc_length.hpp"

#include <stdexcept>
#include <string>

namespace curvewise::curves {

namespace {

// Of `size` vertices, with edge(i) from vertex i - 1 to i.
template <class Edge>
std::vector<double> summed_lengths(std::size_t size, Poller& poller, Edge edge) {
    std::vector<double> lengths;
    lengths.reserve(size);
    lengths.push_back(0.0);
    for (std::size_t i = 1; i < size; ++i) {
        poller.poll_in_loop(i);
        lengths.push_back(lengths.back() + norm(edge(i)));
    }
    return lengths;
}

}  // namespace

std::vector<double> arc_lengths(const Polyline& curve, Poller& poller) {
    return summed_lengths(curve.size(), poller,
                          [&](std::size_t i) { return curve[i] - curve[i - 1]; });
}

std::vector<double> box_scaled_arc_lengths(const CurveView& curve, const Box& box, Poller& poller) {
    const auto edge = [&](std::size_t vertex) -> Point {
        const auto i = static_cast<std::ptrdiff_t>(vertex);
        return {box.x.scaled_difference(curve(i - 1, 0), curve(i, 0)),
                box.y.scaled_difference(curve(i - 1, 1), curve(i, 1))};
    };
    return summed_lengths(static_cast<std::size_t>(curve.size()), poller, edge);
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
