#include "warping/frechet_corridor.hpp"

#include <algorithm>

#include "runtime/scratch.hpp"
#include "warping/block_recursion.hpp"
#include "warping/box_tree.hpp"
#include "warping/reach.hpp"

namespace curvewise::warping {
namespace {

// Both curves from their ends, or from their beginnings: `across` is stored in the order in which
// it is gone through, `down` against it.
ReachedRuns reached_runs(const SweepProblem& problem, const PackedCurve& across,
                         const PackedCurve& down, double value) {
    const Metric metric = problem.cost.metric;
    const BoxTree A(across, PointOrder::forward), D(down, PointOrder::reversed);
    const PointArray a{across.data(), across.stride(), 1};
    const PointArray d{down.data() + down.size() - 1, down.stride(), -1};
    ReachedRuns reached;
    ReachFront front(a, across.size(), d, down.size(), across.dim(), value,
                     problem.kernels.reach(metric, across.dim()), &reached);
    with_norm(metric, [&](auto norm) {
        BlockRecursion<decltype(norm), ReachFront>(A, D, value, value, front, problem.poller, 0)
            .run(true);
    });
    return reached;
}

// Of `size` columns.
ColumnRange columns_of(const RunRange& runs, std::ptrdiff_t size) noexcept {
    return {runs.first * kernels::block_side, std::min(runs.end * kernels::block_side, size) - 1};
}

ColumnRange mirrored(const ColumnRange& range, std::ptrdiff_t size) noexcept {
    return {size - 1 - range.last, size - 1 - range.first};
}

// The ends of the reachable columns never fall from row to row. The ends of whole blocks may.
void make_monotone(runtime::ScratchVector<ColumnRange>& rows) noexcept {
    for (std::size_t i = 1; i < rows.size(); ++i) {
        rows[i].first = std::max(rows[i].first, rows[i - 1].first);
    }
    for (std::size_t i = rows.size() - 1; i > 0; --i) {
        rows[i - 1].last = std::min(rows[i - 1].last, rows[i].last);
    }
}

}  // namespace

SweptColumns frechet_corridor(const SweepProblem& problem, double value) {
    const PackedPair& curves = problem.curves;
    const std::ptrdiff_t n = curves.rows(), m = curves.columns();
    const runtime::ScratchVector<RunRange> from_start =
        reached_runs(problem, curves.p, curves.q, value).of_p;
    const runtime::ScratchVector<RunRange> from_end =
        reached_runs(problem, curves.q, curves.p, value).of_q;
    SweptColumns corridor;
    corridor.rows.reserve(static_cast<std::size_t>(n));
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const auto run = static_cast<std::size_t>(i / kernels::block_side);
        const auto run_from_end = static_cast<std::size_t>((n - 1 - i) / kernels::block_side);
        const ColumnRange forward = columns_of(from_start[run], m);
        const ColumnRange backward = mirrored(columns_of(from_end[run_from_end], m), m);
        corridor.rows.push_back(
            {std::max(forward.first, backward.first), std::min(forward.last, backward.last)});
    }
    make_monotone(corridor.rows);
    for (const ColumnRange& row : corridor.rows) corridor.cells += row.last - row.first + 1;
    return corridor;
}

}  // namespace curvewise::warping
