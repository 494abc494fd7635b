#include "warping/frechet_pruned.hpp"

#include <algorithm>
#include <chrono>

#include "warping/block_values.hpp"
#include "warping/hausdorff.hpp"
#include "warping/reach.hpp"

namespace curvewise::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Clock = std::chrono::steady_clock;

double since(Clock::time_point& start) {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start).count();
    start = now;
    return seconds;
}

void add(BlockCounts& to, const BlockCounts& counts) {
    to.blocks += counts.blocks;
    to.swept_cells += counts.swept_cells;
}

}  // namespace

double frechet_pruned(const kernels::KernelSet& kernels, const PackedPair& curves,
                      kernels::Cost cost, double cutoff, Watch& watch, FrechetRecord& record) {
    Clock::time_point start = Clock::now();
    const BoxTree P(curves.p, PointOrder::forward), Q(curves.q, PointOrder::reversed);
    record.tree_seconds = since(start);
    record.lower = hausdorff_bound(P, Q, cost, watch);
    record.bound_seconds = since(start);
    const std::ptrdiff_t n = curves.rows(), m = curves.columns();
    const PointArray p{curves.p.data(), curves.p.stride(), 1};
    const PointArray q{curves.q.data() + m - 1, curves.q.stride(), -1};
    double value = infinity;
    with_norm(cost, [&](auto norm) {
        using Norm = decltype(norm);
        if (record.lower > cutoff) return;
        {
            ReachFront front(p, n, q, m, curves.dim(), record.lower,
                             kernels.reach(cost, curves.dim()));
            BlockRecursion<Norm, ReachFront> recursion(P, Q, record.lower, record.lower, front,
                                                       watch);
            recursion.run(true);
            add(record.counts, recursion.counts());
            ++record.tries;
            if (front.is_reached()) value = record.lower;
        }
        double step = 1.04;
        while (value == infinity && record.lower < cutoff) {
            record.upper = std::min(record.lower * step, cutoff);
            step *= step;
            ValueFront front(curves, record.upper, kernels.values(cost, curves.dim()));
            BlockRecursion<Norm, ValueFront> recursion(P, Q, record.lower, record.upper, front,
                                                       watch);
            recursion.run(record.lower);
            add(record.counts, recursion.counts());
            ++record.tries;
            if (front.last_cell() <= record.upper) {
                value = front.last_cell();
            } else {
                record.lower = record.upper;
            }
        }
    });
    record.upper = value;
    record.search_seconds = since(start);
    return value;
}

}  // namespace curvewise::detail
