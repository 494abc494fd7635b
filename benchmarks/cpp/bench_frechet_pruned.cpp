// The pruned Fréchet distance against the full sweep, in one thread, on pairs of curves in the
// plane from files: bench_frechet_pruned NAME... reads the points of NAME.P and NAME.Q, doubles
// x0 y0 x1 y1 ... of this machine. The two take turns; medians. A line for each pair: sizes,
// milliseconds of both, their quotient, the share of the table that was swept, and the phases.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "curvewise/curvewise.hpp"
#include "warping/dispatch.hpp"
#include "warping/frechet_pruned.hpp"
#include "warping/sweep.hpp"

namespace {

namespace detail = curvewise::detail;
using curvewise::CurveView;
using curvewise::kernels::Recurrence;
using detail::PruningRecord;
using detail::SweepProblem;

std::vector<double> read(const std::string& name) {
    std::ifstream file(name, std::ios::binary | std::ios::ate);
    std::vector<double> values(static_cast<std::size_t>(file.tellg()) / sizeof(double));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(double)));
    return values;
}

double median(std::vector<double> times) {
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                     times.end());
    return times[times.size() / 2];
}

template <class Call>
double seconds(Call call) {
    const std::clock_t start = std::clock();  // of the processor: other programs may run
    call();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void time_pair(const std::string& name) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> p = read(name + ".P"), q = read(name + ".Q");
    const CurveView P(p.data(), static_cast<std::ptrdiff_t>(p.size() / 2), 2);
    const CurveView Q(q.data(), static_cast<std::ptrdiff_t>(q.size() / 2), 2);
    const double cells = static_cast<double>(P.size()) * static_cast<double>(Q.size());
    const detail::PackedCurve rows(P, detail::RangeScale(1.0), detail::PointOrder::forward);
    const detail::PackedCurve columns(Q, detail::RangeScale(1.0), detail::PointOrder::reversed);
    detail::Poller poller(nullptr);
    detail::SweepMemory memory;
    const SweepProblem problem{*detail::active_level().kernels,
                               {rows, columns},
                               Recurrence::frechet,
                               {curvewise::Metric::sqeuclidean, false},
                               2.0,
                               detail::Band(P.size(), Q.size(), std::nullopt),
                               false,
                               1,
                               poller,
                               memory};
    double full = infinity, pruned = infinity;
    std::vector<double> full_times, pruned_times;
    PruningRecord record;
    const int samples = cells < 5e7 ? 15 : cells < 1e9 ? 7 : 3;
    for (int sample = 0; sample < samples; ++sample) {
        if (cells < 2e10 && (sample == 0 || cells < 3e9)) {
            full_times.push_back(seconds([&] { full = last_row(problem)[Q.size() - 1]; }));
        }
        pruned_times.push_back(seconds([&] {
            record = PruningRecord();
            const std::optional<double> found = frechet_pruned(problem, {}, record);
            pruned = found ? *found : last_row(problem)[Q.size() - 1];
        }));
    }
    const double fast = median(pruned_times);
    const double slow = full_times.empty() ? 0.0 : median(full_times);
    std::printf(
        "%-22s %8td %8td %10.3f ms %10.3f ms %7.2f x  swept %6.3f %% blocks %lld passes %d + %d"
        "  bounds %.3f search %.3f ms%s\n",
        name.c_str(), P.size(), Q.size(), slow * 1e3, fast * 1e3, slow / fast,
        100.0 * static_cast<double>(record.swept_cells) / cells,
        static_cast<long long>(record.blocks), record.reach_passes, record.value_passes,
        record.bound_seconds * 1e3, record.search_seconds * 1e3,
        full_times.empty() || full == pruned ? "" : "  DIFFERENT");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    for (int k = 1; k < argc; ++k) time_pair(argv[k]);
    return 0;
}
