#include "warping/step_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "warping/ground_distance.hpp"

namespace curvewise::warping {
namespace {

[[noreturn]] void refuse(std::size_t step, const std::string& what) {
    throw std::invalid_argument("step " + std::to_string(step + 1) + " of the pattern " + what);
}

void check(std::size_t place, const Step& step) {
    if (step.rows < 0 || step.columns < 0 || step.rows + step.columns == 0) {
        refuse(place, "leads nowhere; it must go forward by a row or a column");
    }
    if (std::max(step.rows, step.columns) > kernels::max_reach) {
        refuse(place, "is longer than " + std::to_string(kernels::max_reach) +
                          " rows or columns; make it shorter");
    }
    if (!std::isfinite(step.constant)) refuse(place, "costs what is no finite number");
    for (const StepTerm& term : step.terms) {
        if (term.rows < 0 || term.rows > step.rows || term.columns < 0 ||
            term.columns > step.columns) {
            refuse(place, "visits a cell that is not between its ends");
        }
        if (!std::isfinite(term.weight)) refuse(place, "has a weight that is not finite");
    }
}

// The enumerators of both have the same order.
static_assert(static_cast<int>(CostFrom::column_move) ==
              static_cast<int>(kernels::Source::column_move));
static_assert(static_cast<int>(PairCost::weighted) ==
              static_cast<int>(kernels::PairRule::weighted));

}  // namespace

StepTable::StepTable(const Recurrence& recurrence, const RangeScale& range) {
    const int degree = is_count(recurrence) ? 0 : warping::degree(recurrence.ground.metric);
    std::size_t count = 0;
    for (const Step& step : recurrence.steps) count += step.terms.size();
    if (recurrence.steps.empty() || recurrence.steps.size() > kernels::max_steps ||
        count > kernels::max_terms) {
        throw std::invalid_argument("a step pattern has from 1 to " +
                                    std::to_string(kernels::max_steps) + " steps and at most " +
                                    std::to_string(kernels::max_terms) + " weights");
    }
    for (std::size_t i = 0; i < recurrence.steps.size(); ++i) {
        const Step& step = recurrence.steps[i];
        check(i, step);
        for (const StepTerm& term : step.terms) {
            if (term.weight == 0.0) continue;
            const bool is_offset = term.from == CostFrom::offset;
            terms.push_back({static_cast<kernels::Source>(term.from), term.rows + term.columns,
                             term.rows,
                             is_offset ? range.restore(term.weight, -degree) : term.weight});
            pair_diagonals = std::max(pair_diagonals, term.rows + term.columns + 1);
        }
        steps.push_back({step.rows + step.columns, step.rows, range.restore(step.constant, -degree),
                         static_cast<int>(terms.size())});
        reach = std::max({reach, step.rows, step.columns});
        value_diagonals = std::max(value_diagonals, step.rows + step.columns + 1);
    }
}

bool StepTable::uses(kernels::Source source) const noexcept {
    return std::any_of(terms.begin(), terms.end(),
                       [=](const kernels::LaneTerm& term) { return term.source == source; });
}

}  // namespace curvewise::warping
