#include "warping/line_table.hpp"

#include <algorithm>

#include "warping/band.hpp"
#include "warping/dispatch.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {

double LineTable::value(const PackedPair& curves, Metric metric,
                        std::optional<std::ptrdiff_t> window, const CostToGo& cost_to_go) {
    assign(curves.rows(), curves.columns(), window);
    const auto line = active_level().kernels->line(metric);
    double* const q = q_.data() + kernels::max_line_height;
    std::copy_n(curves.q.data(), columns_, q);
    return line({curves.p.data(), q, rows_, columns_, first_step_.data(), last_step_.data(),
                 cost_to_go.most, cost_to_go.slack, cost_to_go.after_row, cost_to_go.after_column,
                 cost_to_go.they_add, row_.data() + kernels::max_line_height});
}

void LineTable::assign(std::ptrdiff_t rows, std::ptrdiff_t columns,
                       std::optional<std::ptrdiff_t> window) {
    if (rows == rows_ && columns == columns_) return;
    rows_ = rows;
    columns_ = columns;
    const Band band(rows, columns, window);
    const std::ptrdiff_t height = active_level().kernels->line_height;
    first_step_.assign(static_cast<std::size_t>(rows + kernels::max_line_height), 0.0);
    last_step_.assign(first_step_.size(), 0.0);
    for (std::ptrdiff_t i = 0; i < rows; ++i) {
        const ColumnRange range = band.columns(i);
        const std::ptrdiff_t lane = i % height;
        first_step_[static_cast<std::size_t>(i)] = static_cast<double>(range.first + lane);
        last_step_[static_cast<std::size_t>(i)] = static_cast<double>(range.last + lane);
    }
    row_.reserve(columns + 2 * kernels::max_line_height);
    q_.reserve(columns + 2 * kernels::max_line_height);
    std::fill_n(q_.data(), kernels::max_line_height, 0.0);
    std::fill_n(q_.data() + kernels::max_line_height + columns, kernels::max_line_height, 0.0);
}

}  // namespace curvewise::warping
