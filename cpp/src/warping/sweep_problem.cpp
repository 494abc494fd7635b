#include "warping/sweep_problem.hpp"

#include <algorithm>
#include <limits>

namespace curvewise::warping {

Region whole_table(const PackedPair& curves) noexcept {
    return {0, curves.rows(), 0, curves.columns()};
}

void Row::assign(std::ptrdiff_t columns, double value) {
    columns_ = columns;
    row_.reserve(columns + max_strip_height + kernels::padding);
    std::fill_n(row_.data(), columns, value);
}

std::ptrdiff_t Row::argmin() const noexcept {
    return std::min_element(row_.data(), row_.data() + columns_) - row_.data();
}

void assign_start(const SweepProblem& problem, std::ptrdiff_t columns, Row& row) {
    row.assign(columns, std::numeric_limits<double>::infinity());
    const std::ptrdiff_t begun = problem.open_begin ? problem.columns.columns(0).last + 1 : 1;
    std::fill_n(row.data(), std::min(begun, columns), 0.0);
}

}  // namespace curvewise::warping
