// Lower bounds of what the rows, and the columns, of a table cost that a path has still to visit:
// sums from the end, of a least cost for each. O(n + m).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "warping/live_columns.hpp"

namespace curvewise::warping {

class CostSums {
   public:
    // All 0. `they_add`: whether a path pays for its rows and its columns (symmetric2 counts a
    // diagonal step twice), or for the dearer of the two.
    void assign(std::ptrdiff_t rows, std::ptrdiff_t columns, bool they_add) {
        after_row_.assign(static_cast<std::size_t>(rows + 1), 0.0);
        after_column_.assign(static_cast<std::size_t>(columns + 1), 0.0);
        they_add_ = they_add;
    }

    // The least cost of every row, of every column: to be written, and then added up.
    double* rows() noexcept { return after_row_.data(); }
    double* columns() noexcept { return after_column_.data(); }
    void add_up() noexcept {
        for (std::vector<double>* terms : {&after_row_, &after_column_}) {
            for (std::size_t k = terms->size() - 1; k > 0; --k) (*terms)[k - 1] += (*terms)[k];
        }
    }

    // For paths that cost `most` at most. The table adds up the n + m - 1 cells of a path at most,
    // and the sums above n or m terms, each with a relative error of 2^-53.
    CostToGo cost_to_go(double most) const noexcept {
        const auto terms = static_cast<double>(after_row_.size() + after_column_.size());
        return {most, 1.0 - terms * 0x1p-52, after_row_.data() + 1, after_column_.data() + 1,
                they_add_};
    }

    // Of a whole path, whose first cell is paid for once.
    double all() const noexcept {
        const double rows = after_row_[0], columns = after_column_[0];
        return they_add_ ? std::max(rows + after_column_[1], after_row_[1] + columns)
                         : std::max(rows, columns);
    }

   private:
    std::vector<double> after_row_;
    std::vector<double> after_column_;
    bool they_add_ = false;
};

}  // namespace curvewise::warping
