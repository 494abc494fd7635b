// DTW on the strip sweep: checks, the choice of recurrence, and where the path ends.
#include "curvewise/dtw.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "checks.hpp"
#include "dispatch.hpp"
#include "packed_pair.hpp"
#include "path.hpp"
#include "sweep.hpp"
#include "workers.hpp"

namespace curvewise {
namespace {

using detail::PackedPair;
using detail::RangeScale;
using detail::Row;
using detail::SweepProblem;

void check_options(const DtwOptions& options) {
    detail::check_ground_distance(options.ground);
    if (options.window && *options.window < 0) {
        throw std::invalid_argument("window is " + std::to_string(*options.window) +
                                    "; give a whole number >= 0, or None");
    }
    if (!options.open_begin && !options.open_end) return;
    if (options.step_pattern != StepPattern::symmetric1) {
        throw std::invalid_argument("open_begin and open_end need step_pattern='symmetric1'");
    }
    if (options.window) {
        throw std::invalid_argument("open_begin and open_end cannot be combined with window");
    }
}

void check_window(std::ptrdiff_t n, std::ptrdiff_t m, const DtwOptions& options) {
    if (options.window && *options.window == 0 && n != m && n > 1 && m > 1) {
        throw std::invalid_argument("window=0 admits no path between " + std::to_string(n) +
                                    " and " + std::to_string(m) + " points; use at least 1");
    }
}

// A call's curves and options, checked and ready to sweep.
struct Problem {
    Problem(const CurveView& P, const CurveView& Q, const DtwOptions& given)
        : degree((check_options(given), given.ground.metric == Metric::sqeuclidean ? 2 : 1)),
          range(detail::check_pair(P, Q, {"dtw", 1, false})),
          curves((check_window(P.size(), Q.size(), given), PackedPair(P, Q, range))),
          sweep{*detail::active_level().kernels,
                curves,
                given.step_pattern == StepPattern::symmetric1 ? kernels::Recurrence::dtw_symmetric1
                                                              : kernels::Recurrence::dtw_symmetric2,
                detail::canonical_cost(given.ground, curves),
                given.ground.p,
                detail::Band(P.size(), Q.size(), given.window),
                given.open_begin,
                detail::resolve_workers(given.workers)} {}

    double restore(double value) const noexcept { return range.restore(value, degree); }

    int degree;
    RangeScale range;
    PackedPair curves;
    SweepProblem sweep;
};

}  // namespace

double dtw(const CurveView& P, const CurveView& Q, const DtwOptions& options) {
    const Problem problem(P, Q, options);
    const Row bottom = last_row(problem.sweep);
    return problem.restore(bottom[options.open_end ? bottom.argmin() : Q.size() - 1]);
}

Alignment dtw_path(const CurveView& P, const CurveView& Q, const DtwOptions& options) {
    const Problem problem(P, Q, options);
    detail::Path path = find_path(problem.sweep, options.open_end);
    return {problem.restore(path.value), std::move(path.pairs)};
}

void dtw_table(const CurveView& P, const CurveView& Q, double* out, const DtwOptions& options) {
    const Problem problem(P, Q, options);
    sweep_table(problem.sweep, out);
    if (problem.range.is_identity()) return;
    std::transform(out, out + P.size() * Q.size(), out,
                   [&](double value) { return problem.restore(value); });
}

}  // namespace curvewise
