// The pruned DTW distance and path against the full sweep, in one thread, on pairs of curves in the
// plane from files: bench_dtw_pruned [symmetric2] [path] [nofull] NAME... reads the points of
// NAME.P and NAME.Q, doubles x0 y0 x1 y1 ... of this machine. The two take turns; medians of
// processor time, which counts less of what else the machine does. A line for each pair: sizes,
// milliseconds of both, their quotient, the shares of the table that were swept for the value and
// for the upper bound, both bounds by the value, and the phases.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "curves/range_scale.hpp"
#include "curvewise/curvewise.hpp"
#include "warping/dispatch.hpp"
#include "warping/dtw_pruned.hpp"
#include "warping/ground_distance.hpp"
#include "warping/path.hpp"
#include "warping/sweep.hpp"

namespace {

namespace curves = curvewise::curves;
namespace runtime = curvewise::runtime;
namespace warping = curvewise::warping;
using curvewise::CurveView;
using curvewise::kernels::Recurrence;

struct Settings {
    Recurrence recurrence = Recurrence::dtw_symmetric1;
    bool with_path = false;
    bool with_full = true;
};

struct Times {
    std::vector<double> samples;
    void add(double seconds) { samples.push_back(seconds); }
    double median() {
        if (samples.empty()) return 0.0;
        const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
        std::nth_element(samples.begin(), middle, samples.end());
        return *middle;
    }
};

std::vector<double> read(const std::string& name) {
    std::ifstream file(name, std::ios::binary | std::ios::ate);
    std::vector<double> values(static_cast<std::size_t>(file.tellg()) / sizeof(double));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(double)));
    return values;
}

template <class Call>
double seconds(Call call) {
    const std::clock_t start = std::clock();
    call();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double full_value(const warping::SweepProblem& problem, bool with_path) {
    if (with_path) return find_path(problem, false).value;
    return last_row(problem)[problem.curves.columns() - 1];
}

// As a call does it: the full sweep where pruning gives up.
double pruned_value(const warping::SweepProblem& problem, bool with_path,
                    warping::DtwPruningRecord& record) {
    record = warping::DtwPruningRecord();
    if (with_path) {
        const auto path = dtw_path_pruned(problem, {}, record);
        if (path) return path->value;
    } else {
        const auto value = dtw_pruned(problem, {}, record);
        if (value) return *value;
    }
    return full_value(problem, with_path);
}

void time_pair(const std::string& name, const Settings& settings) {
    const std::vector<double> p = read(name + ".P"), q = read(name + ".Q");
    const CurveView P(p.data(), static_cast<std::ptrdiff_t>(p.size() / 2), 2);
    const CurveView Q(q.data(), static_cast<std::ptrdiff_t>(q.size() / 2), 2);
    const double cells = static_cast<double>(P.size()) * static_cast<double>(Q.size());
    runtime::Poller poller(nullptr);
    const warping::PackedCurve rows(P, curves::RangeScale(1.0), warping::PointOrder::forward,
                                    poller);
    const warping::PackedCurve columns(Q, curves::RangeScale(1.0), warping::PointOrder::reversed,
                                       poller);
    const warping::PackedPair curves{rows, columns};
    warping::SweepMemory memory;
    const warping::SweepProblem problem{*warping::active_level().kernels,
                                        curves,
                                        settings.recurrence,
                                        warping::canonical_cost({}, curves),
                                        2.0,
                                        warping::Band(P.size(), Q.size(), std::nullopt),
                                        false,
                                        1,
                                        poller,
                                        memory};
    double full = 0.0, pruned = 0.0;
    Times full_times, pruned_times;
    warping::DtwPruningRecord record;
    const int samples = cells < 5e6 ? 101 : cells < 5e7 ? 25 : cells < 1e9 ? 5 : 1;
    for (int sample = 0; sample < samples; ++sample) {
        if (settings.with_full) {
            full_times.add(seconds([&] { full = full_value(problem, settings.with_path); }));
        }
        pruned_times.add(
            seconds([&] { pruned = pruned_value(problem, settings.with_path, record); }));
    }
    const double slow = full_times.median(), fast = pruned_times.median();
    std::printf(
        "%-20s %7td %10.3f %9.3f ms %6.2fx  swept %6.2f %% +%5.2f %%  upper %.4f lower %.3f"
        "  path %.3f upper %.3f lower %.3f sweep %.3f ms%s\n",
        name.substr(name.rfind('/') + 1).c_str(), P.size(), slow * 1e3, fast * 1e3, slow / fast,
        100.0 * static_cast<double>(record.swept_cells) / cells,
        100.0 * static_cast<double>(record.corridor_cells) / cells, record.upper / pruned,
        record.lower / pruned, record.path_seconds * 1e3, record.upper_seconds * 1e3,
        record.lower_seconds * 1e3, record.sweep_seconds * 1e3,
        !settings.with_full || full == pruned ? "" : "  DIFFERENT");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    for (int k = 1; k < argc; ++k) {
        const std::string argument = argv[k];
        if (argument == "symmetric2") {
            settings.recurrence = Recurrence::dtw_symmetric2;
        } else if (argument == "path") {
            settings.with_path = true;
        } else if (argument == "nofull") {
            settings.with_full = false;
        } else {
            time_pair(argument, settings);
        }
    }
    return 0;
}
