// The pruned Fréchet distance against the full sweep, in one thread, on pairs of curves in the
// plane from files: bench_frechet_pruned [--paths] NAME... reads the points of NAME.P and NAME.Q,
// doubles x0 y0 x1 y1 ... of this machine. The two take turns; medians. A line for each pair:
// sizes, milliseconds of both, their quotient, the share of the table that was swept, and the
// phases.
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
#include "warping/frechet_corridor.hpp"
#include "warping/frechet_pruned.hpp"
#include "warping/path.hpp"
#include "warping/sweep.hpp"

namespace {

namespace curves = curvewise::curves;
namespace runtime = curvewise::runtime;
namespace warping = curvewise::warping;
using curvewise::CurveView;
using curvewise::kernels::Recurrence;

constexpr double infinity = std::numeric_limits<double>::infinity();
using warping::PruningRecord;
using warping::SweepProblem;

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

// Two curves from files, and what is swept between them.
struct Pair {
    explicit Pair(const std::string& name)
        : p(read(name + ".P")),
          q(read(name + ".Q")),
          rows(view(p), curves::RangeScale(1.0), warping::PointOrder::forward, poller),
          columns(view(q), curves::RangeScale(1.0), warping::PointOrder::reversed, poller) {}

    static CurveView view(const std::vector<double>& values) {
        return {values.data(), static_cast<std::ptrdiff_t>(values.size() / 2), 2};
    }
    double cells() const {
        return static_cast<double>(rows.size()) * static_cast<double>(columns.size());
    }
    int samples() const { return cells() < 5e6 ? 51 : cells() < 5e7 ? 15 : cells() < 1e9 ? 7 : 3; }

    std::vector<double> p;
    std::vector<double> q;
    runtime::Poller poller{nullptr};
    warping::PackedCurve rows;
    warping::PackedCurve columns;
    warping::SweepMemory memory;
    SweepProblem problem{*warping::active_level().kernels,
                         {rows, columns},
                         Recurrence::frechet,
                         {curvewise::Metric::sqeuclidean, false},
                         2.0,
                         warping::Band(rows.size(), columns.size(), std::nullopt),
                         false,
                         1,
                         poller,
                         memory};
};

constexpr double too_many_cells = 2e10;  // for a full sweep

void time_value(const std::string& name) {
    Pair pair(name);
    double full = 0.0, pruned = 0.0;
    std::vector<double> full_times, pruned_times;
    PruningRecord record;
    const std::ptrdiff_t last = pair.columns.size() - 1;
    for (int sample = 0; sample < pair.samples(); ++sample) {
        if (pair.cells() < too_many_cells && (sample == 0 || pair.cells() < 3e9)) {
            full_times.push_back(seconds([&] { full = last_row(pair.problem)[last]; }));
        }
        pruned_times.push_back(seconds([&] {
            record = PruningRecord();
            const std::optional<double> found = frechet_pruned(pair.problem, {}, record);
            pruned = found ? *found : last_row(pair.problem)[last];
        }));
    }
    const double fast = median(pruned_times);
    const double slow = full_times.empty() ? 0.0 : median(full_times);
    std::printf(
        "%-22s %8td %8td %10.3f ms %10.3f ms %7.2f x  swept %6.3f %% blocks %lld passes %d + %d"
        "  bounds %.3f search %.3f ms%s\n",
        name.c_str(), pair.rows.size(), pair.columns.size(), slow * 1e3, fast * 1e3, slow / fast,
        100.0 * static_cast<double>(record.swept_cells) / pair.cells(),
        static_cast<long long>(record.blocks), record.reach_passes, record.value_passes,
        record.bound_seconds * 1e3, record.search_seconds * 1e3,
        full_times.empty() || full == pruned ? "" : "  DIFFERENT");
    std::fflush(stdout);
}

// The path, its search narrowed to the corridor, against the search in the whole table.
void time_path(const std::string& name) {
    Pair pair(name);
    warping::Path full{}, pruned{};
    std::vector<double> full_times, pruned_times, corridor_times;
    double share = 0.0;
    for (int sample = 0; sample < pair.samples() / 2; ++sample) {
        if (pair.cells() < too_many_cells && (sample == 0 || pair.cells() < 3e9)) {
            full_times.push_back(seconds([&] { full = find_path(pair.problem, false); }));
        }
        pruned_times.push_back(seconds([&] {
            PruningRecord record;
            const double value = *frechet_pruned(pair.problem, {infinity, false, 0}, record);
            warping::SweptColumns corridor;
            corridor_times.push_back(
                seconds([&] { corridor = frechet_corridor(pair.problem, value); }));
            share = static_cast<double>(corridor.cells) / pair.cells();
            SweepProblem narrow = pair.problem;
            narrow.columns = {warping::Band(1, 1, std::nullopt), corridor};
            pruned = find_path(narrow, false);
        }));
    }
    const double fast = median(pruned_times);
    const double slow = full_times.empty() ? 0.0 : median(full_times);
    std::printf(
        "%-22s %8td %8td path %10.3f ms %10.3f ms %7.2f x  corridor %6.3f %% in %.3f ms%s\n",
        name.c_str(), pair.rows.size(), pair.columns.size(), slow * 1e3, fast * 1e3, slow / fast,
        share * 100.0, median(corridor_times) * 1e3,
        full_times.empty() || full.pairs == pruned.pairs ? "" : "  DIFFERENT");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const bool paths = argc > 1 && std::string(argv[1]) == "--paths";
    for (int k = paths ? 2 : 1; k < argc; ++k) paths ? time_path(argv[k]) : time_value(argv[k]);
    return 0;
}
