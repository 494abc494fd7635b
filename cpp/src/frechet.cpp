// The discrete Fréchet distance on the strip sweep. For the Euclidean distance the table holds
// squares and one sqrt is taken at the end: sqrt is monotone, so the value has the same bits. The
// path is decided on the squares, that is before the rounding of sqrt can make two of them equal.
#include "curvewise/frechet.hpp"

#include <algorithm>
#include <cmath>
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
using detail::SweepProblem;

// A call's curves and options, checked and ready to sweep.
struct Problem {
    Problem(const CurveView& P, const CurveView& Q, const FrechetOptions& options)
        : degree(options.ground.metric == Metric::sqeuclidean ? 2 : 1),
          range((detail::check_ground_distance(options.ground),
                 detail::check_pair(P, Q, {"frechet", 1, false}))),
          curves(P, Q, range),
          sweep{*detail::active_level().kernels,
                curves,
                kernels::Recurrence::frechet,
                detail::canonical_cost(options.ground, curves),
                options.ground.p,
                detail::Band(P.size(), Q.size(), std::nullopt),
                false,
                detail::resolve_workers(options.workers)},
          squared(sweep.cost == kernels::Cost::euclidean ||
                  sweep.cost == kernels::Cost::euclidean_in_domain) {
        if (squared) sweep.cost = kernels::Cost::sqeuclidean;
    }

    double restore(double value) const noexcept {
        return range.restore(squared ? std::sqrt(value) : value, degree);
    }

    int degree;
    RangeScale range;
    PackedPair curves;
    SweepProblem sweep;
    bool squared;
};

}  // namespace

double frechet(const CurveView& P, const CurveView& Q, const FrechetOptions& options) {
    const Problem problem(P, Q, options);
    return problem.restore(last_row(problem.sweep)[Q.size() - 1]);
}

Alignment frechet_path(const CurveView& P, const CurveView& Q, const FrechetOptions& options) {
    const Problem problem(P, Q, options);
    detail::Path path = find_path(problem.sweep, false);
    return {problem.restore(path.value), std::move(path.pairs)};
}

void frechet_table(const CurveView& P, const CurveView& Q, double* out,
                   const FrechetOptions& options) {
    const Problem problem(P, Q, options);
    sweep_table(problem.sweep, out);
    std::transform(out, out + P.size() * Q.size(), out,
                   [&](double value) { return problem.restore(value); });
}

}  // namespace curvewise
