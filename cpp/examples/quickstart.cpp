// The five measures of two short curves, which are vectors of points.
#include <array>
#include <cstdio>
#include <curvewise/curvewise.hpp>
#include <vector>

int main() {
    const std::vector<std::array<double, 2>> P{{0.0, 0.0}, {0.1, 1.3}, {0.3, 2.2}, {0.7, 2.9}};
    const std::vector<std::array<double, 2>> Q{{0.0, 0.1}, {0.2, 1.6}, {0.8, 2.7}};

    std::printf("area %.17g\n", curvewise::area(P, Q));
    std::printf("pcm %.17g\n", curvewise::pcm(P, Q));
    std::printf("frechet %.17g\n", curvewise::frechet(P, Q));
    std::printf("dtw %.17g\n", curvewise::dtw(P, Q));
    std::printf("curve_length %.17g\n", curvewise::curve_length(P, Q));

    curvewise::DtwOptions options;  // an option of each measure has its default until it is set
    options.ground.metric = curvewise::Metric::cityblock;
    options.step_pattern = curvewise::StepPattern::symmetric2;
    const curvewise::Alignment alignment = curvewise::dtw_path(P, Q, options);
    std::printf("dtw_path %.17g", alignment.distance);
    for (const auto& [i, j] : alignment.path) std::printf(" %d,%d", int(i), int(j));
    std::printf("\n");
}
