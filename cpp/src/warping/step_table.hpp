// The steps of a recurrence as the kernels read them: checked, without terms that cost nothing, in
// the units of a range.
#pragma once

#include "curves/range_scale.hpp"
#include "curvewise/recurrence.hpp"
#include "runtime/scratch.hpp"
#include "warping/kernels/recurrence.hpp"

namespace curvewise::warping {

using curves::RangeScale;

// Whether a table holds counts, which have no unit.
inline bool is_count(const Recurrence& recurrence) noexcept {
    return recurrence.pair == PairCost::apart || recurrence.pair == PairCost::together;
}

struct StepTable {
    // Throws std::invalid_argument for steps that the kernels do not take.
    StepTable(const Recurrence& recurrence, const RangeScale& range);

    bool uses(kernels::Source source) const noexcept;

    runtime::ScratchVector<kernels::LaneStep> steps;
    runtime::ScratchVector<kernels::LaneTerm> terms;
    int reach = 1;            // the most rows or columns of a step
    int value_diagonals = 2;  // those that a cell depends on, and its own
    int pair_diagonals = 1;
};

}  // namespace curvewise::warping
