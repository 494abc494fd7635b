#include "warping/sweep_problem.hpp"

#include <algorithm>

namespace curvewise::detail {

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

}  // namespace curvewise::detail
