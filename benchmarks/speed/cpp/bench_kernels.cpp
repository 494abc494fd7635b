// How fast the sweep is without Python: cells per second of every rule and ground distance,
// at every instruction-set level of this machine, and microseconds of the other measures. The
// levels take turns, sample by sample, so that a machine that drifts drifts for all; medians.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

#include "curvewise/curvewise.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/sweep.hpp"

namespace {

using curvewise::CurveView;
using curvewise::GroundDistance;
using curvewise::Metric;
using curvewise::kernels::Rule;
namespace curves = curvewise::curves;
namespace runtime = curvewise::runtime;
namespace warping = curvewise::warping;

constexpr int samples = 9;
constexpr double seconds_per_sample = 0.02;

std::vector<double> random_walk(std::ptrdiff_t n, std::ptrdiff_t dim, unsigned seed) {
    std::mt19937_64 bits(seed);
    std::normal_distribution<double> step;
    std::vector<double> curve(static_cast<std::size_t>(n * dim));
    for (std::size_t i = 0; i < curve.size(); ++i) {
        curve[i] =
            step(bits) +
            (i < static_cast<std::size_t>(dim) ? 0.0 : curve[i - static_cast<std::size_t>(dim)]);
    }
    return curve;
}

double seconds(const std::function<void()>& call, int repeats) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < repeats; ++i) call();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return elapsed.count() / repeats;
}

// The median time of each call, the calls taking turns.
std::vector<double> medians(const std::vector<std::function<void()>>& calls) {
    std::vector<std::vector<double>> times(calls.size());
    for (int sample = -1; sample < samples; ++sample) {  // one to warm up
        for (std::size_t c = 0; c < calls.size(); ++c) {
            const double once = std::max(seconds(calls[c], 1), 1e-9);
            const int repeats = 1 + static_cast<int>(std::min(1e6, seconds_per_sample / once));
            const double time = seconds(calls[c], repeats);
            if (sample >= 0) times[c].push_back(time);
        }
    }
    std::vector<double> result;
    for (std::vector<double>& of_call : times) {
        std::nth_element(of_call.begin(), of_call.begin() + samples / 2, of_call.end());
        result.push_back(of_call[samples / 2]);
    }
    return result;
}

void time_sweep(const char* name, Rule rule, Metric metric, std::ptrdiff_t dim, std::ptrdiff_t n) {
    const std::vector<double> p = random_walk(n, dim, 1), q = random_walk(n, dim, 2);
    const CurveView P(p.data(), n, dim), Q(q.data(), n, dim);
    const std::vector<warping::Level> levels = warping::available_levels();
    std::vector<std::function<void()>> calls;
    for (const warping::Level& level : levels) {
        calls.emplace_back([&, level] {
            runtime::Poller poller(nullptr);
            const warping::PackedCurve rows(P, curves::RangeScale(1.0),
                                            warping::PointOrder::forward, poller);
            const warping::PackedCurve columns(Q, curves::RangeScale(1.0),
                                               warping::PointOrder::reversed, poller);
            const warping::PackedPair curves{rows, columns};
            warping::SweepMemory memory;
            const GroundDistance ground{metric};
            const warping::SweepProblem problem{*level.kernels,
                                                curves,
                                                rule,
                                                warping::canonical_cost(ground, curves),
                                                2.0,
                                                warping::Band(n, n, std::nullopt),
                                                false,
                                                1,
                                                poller,
                                                memory};
            last_row(problem);
        });
    }
    const std::vector<double> times = medians(calls);
    std::printf("%-24s %6td x %td-D", name, n, dim);
    for (std::size_t l = 0; l < levels.size(); ++l) {
        std::printf("   %s %9.2f us %5.2f", levels[l].name, times[l] * 1e6,
                    static_cast<double>(n * n) / times[l] / 1e9);
    }
    std::printf("\n");
    std::fflush(stdout);
}

void time_planar() {
    const std::vector<double> p = random_walk(1000, 2, 1), q = random_walk(900, 2, 2);
    const CurveView P(p.data(), 1000, 2), Q(q.data(), 900, 2);
    const std::vector<double> times =
        medians({[&] { return curvewise::area(P, Q); }, [&] { return curvewise::pcm(P, Q); },
                 [&] { return curvewise::curve_length(P, Q); }});
    std::printf("1000 and 900 points: area %.1f us, pcm %.1f us, curve_length %.1f us\n",
                times[0] * 1e6, times[1] * 1e6, times[2] * 1e6);
}

}  // namespace

int main() {
    std::printf("time of a call in us, and 10^9 cells per second\n");
    for (const std::ptrdiff_t n : {20, 100, 300, 1000, 4000}) {
        for (const std::ptrdiff_t dim : {1, 2, 3, 7}) {
            time_sweep("dtw euclidean", Rule::dtw_symmetric1, Metric::euclidean, dim, n);
        }
        time_sweep("dtw symmetric2", Rule::dtw_symmetric2, Metric::euclidean, 2, n);
        time_sweep("dtw sqeuclidean", Rule::dtw_symmetric1, Metric::sqeuclidean, 2, n);
        time_sweep("dtw cityblock", Rule::dtw_symmetric1, Metric::cityblock, 2, n);
        time_sweep("frechet (on squares)", Rule::frechet, Metric::sqeuclidean, 2, n);
    }
    time_planar();
    return 0;
}
