// Every public call at fixed sizes, each between two marks that callgrind sees: how many
// instructions it takes, and how many bytes at most. counts.py runs this, and says how exact it is.
//
// The curves are made with + - * / alone, so that no mathematical library decides what the calls
// have to do. A call runs once before it is counted: what is made at first use is not its own.
#include <valgrind/callgrind.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <curvewise/curvewise.hpp>
#include <functional>
#include <map>
#include <new>
#include <string>
#include <vector>

namespace {

struct Heap {
    std::size_t now = 0;
    std::size_t most = 0;
} heap;

// A block holds its size in front, in as many bytes as its alignment is wide.
void* allocate(std::size_t size, std::size_t alignment) {
    const std::size_t whole = (size + 2 * alignment - 1) / alignment * alignment;
    auto* const block = static_cast<std::byte*>(std::aligned_alloc(alignment, whole));
    if (block == nullptr) throw std::bad_alloc();
    *reinterpret_cast<std::size_t*>(block) = size;
    heap.now += size;
    heap.most = heap.now > heap.most ? heap.now : heap.most;
    return block + alignment;
}

void release(void* data, std::size_t alignment) noexcept {
    if (data == nullptr) return;
    std::byte* const block = static_cast<std::byte*>(data) - alignment;
    heap.now -= *reinterpret_cast<std::size_t*>(block);
    std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* data) noexcept { release(data, alignof(std::max_align_t)); }
void operator delete(void* data, std::size_t /*size*/) noexcept { operator delete(data); }
void operator delete(void* data, std::align_val_t alignment) noexcept {
    release(data, static_cast<std::size_t>(alignment));
}
void operator delete(void* data, std::size_t /*size*/, std::align_val_t alignment) noexcept {
    release(data, static_cast<std::size_t>(alignment));
}

namespace {

using curvewise::CurveView;
using Points = std::vector<std::array<double, 2>>;

// A cycle of tension, compression, tension, with saturation and a little noise.
Points loop(std::ptrdiff_t n, double size, std::uint64_t seed) {
    Points points;
    double stress = 0.0, before = 0.0;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const double t = 3.0 * static_cast<double>(i) / static_cast<double>(n);
        const double strain = t < 1.0 ? t : t < 2.0 ? 3.0 - 2.0 * t : 2.0 * t - 5.0;
        const double step = strain - before;
        stress += 4.0 * (step - (step < 0.0 ? -step : step) * stress);
        before = strain;
        seed = seed * 6364136223846793005U + 1442695040888963407U;
        const double noise = static_cast<double>(seed >> 40U) / 16777216.0 - 0.5;
        points.push_back({size * strain, size * stress + 0.01 * noise});
    }
    return points;
}

class Calls {
   public:
    // Counts one call: prints its name and the most bytes that it had.
    void operator()(const std::string& name, const std::function<void()>& call) const {
        call();
        const std::size_t before = heap.now;
        heap.most = before;
        CALLGRIND_ZERO_STATS;
        call();
        CALLGRIND_DUMP_STATS_AT(name.c_str());
        std::printf("%s,%zu\n", name.c_str(), heap.most - before);
    }
};

void count_pairs(const Calls& count) {
    for (const std::ptrdiff_t n : {5, 10, 100, 1000}) {
        const Points p = loop(n, 1.0, 1), q = loop(n - n / 10, 1.03, 2);
        const CurveView P(p), Q(q);
        const std::string size = " " + std::to_string(n);
        curvewise::for_each_measure([&](const auto& options) {
            count(options.measure + size, [&] { return evaluate(options, P, Q); });
        });
    }
}

void count_options(const Calls& count) {
    using namespace curvewise;
    const Points p = loop(1000, 1.0, 1), q = loop(900, 1.03, 2);
    const CurveView P(p), Q(q);
    for (const Spacing spacing : {Spacing::x, Spacing::arc_length, Spacing::matched}) {
        AreaOptions options;
        options.spacing = spacing;
        const std::string name = choice_names(spacing)[static_cast<std::size_t>(spacing)];
        count("area 1000 " + name, [&] { return area(P, Q, options); });
    }
    AreaOptions split;
    split.crossing = Crossing::split;
    count("area 1000 split", [&] { return area(P, Q, split); });
    count("area_quads 1000", [&] { return area_quads(P, Q); });
    PcmOptions continuous;
    continuous.continuous = true;
    const Points short_p = loop(100, 1.0, 1), short_q = loop(90, 1.03, 2);
    count("pcm 100 continuous", [&] { return pcm(short_p, short_q, continuous); });
    count("pcm_match 1000", [&] { return pcm_match(P, Q); });
    std::vector<double> residuals(2 * p.size());
    count("curve_length_residuals 1000", [&] { curve_length_residuals(P, Q, residuals.data()); });
    const Points same = loop(1000, 1.03, 2);
    count("sum_of_squares 1000", [&] { return sum_of_squares(P, same); });
    count("mse 1000", [&] { return mse(P, same); });
    count("mae 1000", [&] { return mae(P, same); });
    count("normalize 1000", [&] { normalize(P, P, residuals.data()); });
    count("compare 1000", [&] { return compare(P, Q); });
    count("frechet_within 1000", [&] { return frechet_within(P, Q, 0.1); });
    count("frechet_continuous_path 1000", [&] { return frechet_continuous_path(P, Q); });
}

void count_metrics(const Calls& count) {
    using namespace curvewise;
    const Points p = loop(100, 1.0, 1), q = loop(90, 1.03, 2);
    const CurveView P(p), Q(q);
    for (std::size_t metric = 0; metric < choice_names(Metric{}).size(); ++metric) {
        const std::string name = choice_names(Metric{})[metric];
        DtwOptions dtw_options;
        FrechetOptions frechet_options;
        dtw_options.prune = frechet_options.prune = false;
        dtw_options.ground = frechet_options.ground = {static_cast<Metric>(metric), 3.0};
        count("dtw 100 " + name + " in full", [&] { return dtw(P, Q, dtw_options); });
        count("frechet 100 " + name + " in full", [&] { return frechet(P, Q, frechet_options); });
    }
}

void count_warping(const Calls& count) {
    using namespace curvewise;
    const Points p = loop(300, 1.0, 1), q = loop(270, 1.03, 2);
    const CurveView P(p), Q(q);
    DtwOptions symmetric2, window, open;
    symmetric2.step_pattern = StepPattern::symmetric2;
    window.window = 30;
    open.open_begin = open.open_end = true;
    count("dtw 300 symmetric2", [&] { return dtw(P, Q, symmetric2); });
    count("dtw 300 window", [&] { return dtw(P, Q, window); });
    count("dtw 300 open", [&] { return dtw(P, Q, open); });
    count("dtw_path 300", [&] { return dtw_path(P, Q); });
    count("frechet_path 300", [&] { return frechet_path(P, Q); });
    count("dtw_info 300", [&] { return dtw_info(P, Q); });
    count("frechet_info 300", [&] { return frechet_info(P, Q); });
    std::vector<double> table(p.size() * q.size());
    count("dtw_table 300", [&] { dtw_table(P, Q, table.data()); });
    count("frechet_table 300", [&] { frechet_table(P, Q, table.data()); });
    count("subsequences dtw 300",
          [&] { return subsequences(CurveView(p.data()->data(), 60, 2), Q, 3); });
    count("subsequences frechet 300",
          [&] { return subsequences(CurveView(p.data()->data(), 60, 2), Q, 3, FrechetOptions{}); });
    std::vector<double> gradient(2 * q.size());
    count("gradient area 300", [&] { value_and_gradient(AreaOptions{}, P, Q, gradient.data()); });
    count("gradient frechet 300",
          [&] { value_and_gradient(FrechetOptions{}, P, Q, gradient.data()); });
    count("gradient dtw 300", [&] { value_and_gradient(DtwOptions{}, P, Q, gradient.data()); });
    count("gradient curve_length 300",
          [&] { value_and_gradient(CurveLengthOptions{}, P, Q, gradient.data()); });
    count("soft_dtw 300", [&] { return soft_dtw(P, Q); });
    count("gradient soft_dtw 300",
          [&] { value_and_gradient(SoftDtwOptions{}, P, Q, gradient.data()); });
}

void count_many(const Calls& count) {
    using namespace curvewise;
    std::vector<Points> points;
    for (std::uint64_t i = 0; i < 20; ++i) {
        points.push_back(loop(50, 1.0 + 0.02 * static_cast<double>(i % 7), i));
    }
    const std::vector<CurveView> curves(points.begin(), points.end());
    const std::vector<CurveView> few(curves.begin(), curves.begin() + 5);
    std::vector<double> out(400);
    std::vector<std::int64_t> places(400);
    for_each_measure([&](const auto& options) {
        const std::string name = options.measure;
        count("cdist " + name + " 5 x 20 of 50", [&] { cdist(few, curves, options, out.data()); });
        const Prepared prepared(curves[0], options);
        count("Prepared " + name + " 50", [&] { return prepared(curves[1]); });
    });
    count("pdist dtw 20 of 50", [&] { pdist(curves, DtwOptions{}, out.data()); });
    count("Index dtw 20 of 50", [&] { Index(curves, DtwOptions{}); });
    const Index dtw(curves, DtwOptions{}), frechet(curves, FrechetOptions{});
    count("kneighbors dtw", [&] { dtw.kneighbors(few, 3, out.data(), places.data()); });
    count("kneighbors frechet", [&] { frechet.kneighbors(few, 3, out.data(), places.data()); });
    count("radius_neighbors frechet", [&] { return frechet.radius_neighbors(few, 0.1); });
    count("dtw_mean 5 of 50",
          [&] { return dtw_mean(few, std::vector<double>(5, 1.0), curves[0]); });
}

void count_materials(const Calls& count) {
    using namespace curvewise;
    std::vector<double> strain, stress(300), slopes(300 * 16);
    for (const auto& point : loop(300, 0.03, 1)) strain.push_back(point[0]);
    const std::vector<double> chaboche{200e3, 300.0, 50.0, 5.0, 80e3, 400.0, 5e3, 20.0};
    count("chaboche_voce 300", [&] {
        material_stress(ChabocheVoce{}, chaboche.data(), strain.data(), 300, stress.data());
    });
    count("chaboche_voce slopes 300", [&] {
        material_stress(ChabocheVoce{}, chaboche.data(), strain.data(), 300, stress.data(),
                        slopes.data());
    });
    const std::vector<double> yoshida{200e3, 320.0, 250.0, 400.0, 20.0, 200.0, 60.0, 0.4};
    count("yoshida_uemori 300", [&] {
        material_stress(YoshidaUemori{}, yoshida.data(), strain.data(), 300, stress.data());
    });
}

}  // namespace

int main() {
    const Calls count;
    count_pairs(count);
    count_options(count);
    count_metrics(count);
    count_warping(count);
    count_many(count);
    count_materials(count);
}
