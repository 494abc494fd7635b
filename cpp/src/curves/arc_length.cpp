#include "curves/arc_length.hpp"

#include <stdexcept>
#include <string>

namespace curvewise::detail {

std::vector<double> arc_lengths(const Polyline& curve, Poller& poller) {
    std::vector<double> lengths;
    lengths.reserve(curve.size());
    lengths.push_back(0.0);
    for (std::size_t i = 1; i < curve.size(); ++i) {
        poller.poll_in_loop(i);
        lengths.push_back(lengths.back() + norm(curve[i] - curve[i - 1]));
    }
    return lengths;
}

void check_length(double length, const std::string& name, const char* measure) {
    if (length > 0.0) return;
    throw std::invalid_argument(name + " has zero length (all its points are equal); " + measure +
                                " needs two different points");
}

}  // namespace curvewise::detail
