// Lower bounds of the cost of the rows, and of the columns, that a path has still to visit: sums
// from the end of the least cost of each. O(n + m).
#pragma once

#include <algorithm>
#include <cstddef>

#include "runtime/scratch.hpp"
#include "warping/live_columns.hpp"

namespace curvewise::warping {

class CostSums {
   public:
    // Sets all to 0. `they_add`: whether a path pays for its rows and its columns (symmetric2
    // counts a diagonal step twice), or for the more expensive of the two.
    void assign(std::ptrdiff_t rows, std::ptrdiff_t columns, bool they_add) {
        after_row_.assign(static_cast<std::size_t>(rows + 1), 0.0);
        after_column_.assign(static_cast<std::size_t>(columns + 1), 0.0);
        they_add_ = they_add;
    }

    // The least cost of every row, of every column: to be written, and then added up.
    double* rows() noexcept { return after_row_.data(); }
    double* columns() noexcept { return after_column_.data(); }
    void add_up() noexcept {
        for (runtime::ScratchVector<double>* terms : {&after_row_, &after_column_}) {
            for (std::size_t k = terms->size() - 1; k > 0; --k) (*terms)[k - 1] += (*terms)[k];
        }
    }

    // All of these sums for n rows and m columns, from the last one on. The least costs of the rows
    // are `row_step` apart, those of the columns are contiguous. The two sums do not wait for each
    // other.
    void add_up(const double* row, std::ptrdiff_t row_step, std::ptrdiff_t n, const double* column,
                std::ptrdiff_t m, bool they_add) {
        after_row_.resize(static_cast<std::size_t>(n + 1));
        after_column_.resize(static_cast<std::size_t>(m + 1));
        they_add_ = they_add;
        double* after_row = after_row_.data() + n;
        double* after_column = after_column_.data() + m;
        double rows = *after_row = 0.0, columns = *after_column = 0.0;
        const auto add_row = [&] {
            rows += *row;
            row += row_step;
            *--after_row = rows;
        };
        const auto add_column = [&] {
            columns += *column++;
            *--after_column = columns;
        };
        const std::ptrdiff_t both = std::min(n, m);
        for (std::ptrdiff_t k = 0; k < both; ++k) {
            add_row();
            add_column();
        }
        for (std::ptrdiff_t k = both; k < n; ++k) add_row();
        for (std::ptrdiff_t k = both; k < m; ++k) add_column();
    }

    // The slack of sums for n rows and m columns. The table adds up at most the n + m - 1 cells of
    // a path, and the sums have n or m terms, or both. Each addition has a relative error of 2^-53.
    // A term and a cell have three such errors themselves.
    static double slack(std::ptrdiff_t n, std::ptrdiff_t m) noexcept {
        return 1.0 - static_cast<double>(n + m + 6) * 0x1p-52;
    }

    // For paths that cost `most` at most.
    CostToGo cost_to_go(double most) const noexcept {
        const auto n = static_cast<std::ptrdiff_t>(after_row_.size()) - 1;
        const auto m = static_cast<std::ptrdiff_t>(after_column_.size()) - 1;
        return {most, slack(n, m), after_row_.data() + 1, after_column_.data() + 1, they_add_};
    }

    // The bound of a whole path, whose first cell is paid for once.
    double all() const noexcept {
        const double rows = after_row_[0], columns = after_column_[0];
        return they_add_ ? std::max(rows + after_column_[1], after_row_[1] + columns)
                         : std::max(rows, columns);
    }

   private:
    runtime::ScratchVector<double> after_row_;
    runtime::ScratchVector<double> after_column_;
    bool they_add_ = false;
};

}  // namespace curvewise::warping
