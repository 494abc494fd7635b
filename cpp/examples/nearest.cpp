// Which loop of a library is nearest to a test, and where in a long record a cycle occurs.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <curvewise/curvewise.hpp>
#include <vector>

namespace {

using Points = std::vector<std::array<double, 2>>;

// A closed loop: x a triangle wave, y a parabola on each branch.
Points loop(int n, double height) {
    Points points;
    points.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        const double t = 4.0 * i / (n - 1);
        const double u = t < 2.0 ? t - 1.0 : 3.0 - t;
        const double bow = height * (1.0 - u * u);
        points.push_back({u, t < 2.0 ? u + bow : u - bow});
    }
    return points;
}

}  // namespace

int main() {
    std::vector<Points> library;
    for (int i = 0; i < 40; ++i) library.push_back(loop(i % 2 == 0 ? 65 : 129, 0.125 * i));
    const Points test = loop(65, 1.3);
    const curvewise::Index index({library.begin(), library.end()}, curvewise::DtwOptions{});

    std::array<double, 3> distances;
    std::array<std::int64_t, 3> places;
    index.kneighbors({test}, 3, distances.data(), places.data());
    for (std::size_t k = 0; k < 3; ++k) {
        std::printf("%d %.17g\n", static_cast<int>(places[k]), distances[k]);
    }
    const auto within = index.radius_neighbors({test}, 10.0);
    for (const curvewise::Neighbor& near : within.front()) {
        std::printf("within 10: %d\n", static_cast<int>(near.index));
    }

    Points record;
    for (const double height : {0.5, 1.5, 1.0, 1.25}) {
        for (const auto& point : loop(65, height)) record.push_back(point);
    }
    for (const curvewise::Subsequence& found : curvewise::subsequences(test, record, 2)) {
        std::printf("%d to %d: %.17g\n", static_cast<int>(found.start),
                    static_cast<int>(found.stop), found.distance);
    }
}
