// What dtw and frechet have in common: two curves, checked and packed, whose cumulative table is
// swept for a distance, a path or all of it. Time O(n m), memory O(n + m) but for the table.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "checks.hpp"
#include "curvewise/alignment.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "packed_curve.hpp"
#include "sweep.hpp"
#include "watch.hpp"

namespace curvewise::detail {

// The options of either, checked.
struct TableOptions {
    explicit TableOptions(const DtwOptions& options);
    explicit TableOptions(const FrechetOptions& options);

    // Throws where no path between n and m points fits the window.
    void check_window(std::ptrdiff_t n, std::ptrdiff_t m) const;

    Requirements needs;
    kernels::Recurrence recurrence;
    GroundDistance ground;
    std::optional<std::ptrdiff_t> window;
    bool open_begin = false;
    bool open_end = false;
    std::ptrdiff_t workers;
};

class TableProblem {
   public:
    TableProblem(const TableOptions& options, const PackedPair& curves, const RangeScale& range,
                 Watch& watch, SweepMemory& memory);

    // One above `cutoff` may come back as any other that is.
    double distance(double cutoff = std::numeric_limits<double>::infinity());
    Alignment alignment() const;
    void write_table(double* out) const;

   private:
    double restore(double value) const noexcept;
    bool ends_are_within(double cutoff) const;

    RangeScale range_;
    int degree_;            // of homogeneity in the coordinates
    bool squared_ = false;  // the table holds squares of the values
    bool open_end_;
    SweepProblem sweep_;
};

// Checks and packs both curves, and owns them while `use(problem)` runs.
template <class Use>
auto with_table(const TableOptions& options, const CurveView& P, const CurveView& Q,
                Control* control, Use use) {
    const RangeScale range = check_pair(P, Q, options.needs);
    options.check_window(P.size(), Q.size());
    const PackedCurve p(P, range, PointOrder::forward);
    const PackedCurve q(Q, range, PointOrder::reversed);
    Watch watch(control);
    watch.begin(P.size() * Q.size());
    SweepMemory memory;
    TableProblem problem(options, {p, q}, range, watch, memory);
    auto result = use(problem);
    watch.finish();
    return result;
}

}  // namespace curvewise::detail
