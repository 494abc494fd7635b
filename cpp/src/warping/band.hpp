// Which columns of the table a row may hold: all of them, or a Sakoe-Chiba band.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

namespace curvewise::warping {

struct ColumnRange {
    std::ptrdiff_t first;
    std::ptrdiff_t last;
};

class Band {
   public:
    // |i (m-1) - j (n-1)| <= window (max(n, m) - 1); no limit where n = 1 or m = 1.
    Band(std::ptrdiff_t n, std::ptrdiff_t m, std::optional<std::ptrdiff_t> window) noexcept
        : row_step_(m - 1),
          column_step_(n - 1),
          last_column_(m - 1),
          limited_(window.has_value() && n > 1 && m > 1 && *window < std::max(n, m)) {
        if (limited_) reach_ = *window * (std::max(n, m) - 1);
        if (limited_ && n == m) {  // the same, without divisions
            row_step_ = column_step_ = 1;
            reach_ = *window;
        }
    }

    bool is_limited() const noexcept { return limited_; }

    ColumnRange columns(std::ptrdiff_t row) const noexcept {
        if (!limited_) return {0, last_column_};
        const std::ptrdiff_t low = row * row_step_ - reach_;
        const std::ptrdiff_t high = row * row_step_ + reach_;
        if (column_step_ == 1)
            return {std::max<std::ptrdiff_t>(low, 0), std::min(last_column_, high)};
        const std::ptrdiff_t first = low <= 0 ? 0 : (low + column_step_ - 1) / column_step_;
        return {first, std::min(last_column_, high / column_step_)};
    }

   private:
    std::ptrdiff_t row_step_;
    std::ptrdiff_t column_step_;
    std::ptrdiff_t last_column_;
    std::ptrdiff_t reach_ = 0;
    bool limited_;
};

}  // namespace curvewise::warping
