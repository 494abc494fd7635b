// All pairs of many curves on all cores, watched while it runs; and how a run is stopped.
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
    std::vector<Points> loops;
    for (int i = 0; i < 40; ++i) loops.push_back(loop(i % 2 == 0 ? 65 : 129, 0.125 * i));
    const std::vector<curvewise::CurveView> curves(loops.begin(), loops.end());
    std::vector<double> distances(curves.size() * (curves.size() - 1) / 2);

    curvewise::DtwOptions measure;
    measure.step_pattern = curvewise::StepPattern::symmetric2;
    curvewise::BatchOptions batch;
    batch.workers = -1;  // a thread a core
    curvewise::Control watched([](std::int64_t done, std::int64_t total) {
        std::fprintf(stderr, "%3.0f %%\n", 100.0 * static_cast<double>(done) / double(total));
        return true;
    });
    curvewise::pdist(curves, measure, distances.data(), batch, &watched);
    for (const double distance : distances) std::printf("%.17g\n", distance);

    // Control::stop() may be called from any thread, e.g. by a button; here it has been already.
    curvewise::Control control;
    control.stop();
    try {
        curvewise::pdist(curves, measure, distances.data(), batch, &control);
    } catch (const curvewise::Stopped& stopped) {
        std::printf("%s\n", stopped.what());
        return 0;
    }
    return 1;
}
