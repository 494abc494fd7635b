// Narrows the strips of a sweep, one after the other, to the cells that are live (see
// live_columns.hpp): the columns where a strip begins, by the row above it; while it is swept, the
// lanes at both ends, by the last two diagonals, across one of which every path goes. Dead cells
// between live ones are swept. Time O(1) a lane that is dropped, O(w) a strip of w live columns.
#pragma once

#include <cstddef>

#include "warping/kernels/strip.hpp"
#include "warping/live_columns.hpp"

namespace curvewise::detail {

class StripNarrower {
   public:
    // Diagonals between two looks: each lets the live lanes grow by one, and looks at those lanes.
    static constexpr std::ptrdiff_t stride = 16;

    StripNarrower() noexcept = default;
    StripNarrower(const CostToGo& cost_to_go, SweptColumns& swept, std::ptrdiff_t columns) noexcept
        : cost_to_go_(&cost_to_go), swept_(&swept), written_end_(columns), above_{0, columns - 1} {}

    bool is_on() const noexcept { return cost_to_go_ != nullptr; }

    // Before a strip's first diagonal: moves the beginnings of its rows to the first live column of
    // the row above, in the strip's boundary. False where there is none.
    bool enter(const kernels::Strip& strip, std::ptrdiff_t first_row,
               std::ptrdiff_t* first_column) noexcept;
    // After some diagonals: drops dead lanes at both ends. False where no live lane is left, or
    // can come.
    bool narrow(kernels::Strip& strip, std::ptrdiff_t* first_column,
                std::ptrdiff_t* last_column) noexcept;
    // After a strip's last diagonal: what lies beside its bottom row's live columns is infinite.
    void leave(const kernels::Strip& strip, const std::ptrdiff_t* first_column,
               const std::ptrdiff_t* last_column, bool is_last);

   private:
    bool was_live(const kernels::Strip& strip, std::ptrdiff_t lane) const noexcept;
    bool is_live(const kernels::Strip& strip, std::ptrdiff_t lane) const noexcept;
    bool may_enter(const kernels::Strip& strip) const noexcept;
    bool has_left(const kernels::Strip& strip) noexcept;
    void count(const kernels::Strip& strip) noexcept;

    const CostToGo* cost_to_go_ = nullptr;
    SweptColumns* swept_ = nullptr;
    std::ptrdiff_t first_row_ = 0;
    // At the last look: the next diagonal, and the lanes.
    std::ptrdiff_t counted_to_ = 0;
    std::ptrdiff_t low_ = 0;
    std::ptrdiff_t high_ = -1;
    // Whether a column of the last row before this one was live.
    std::ptrdiff_t left_to_ = 0;
    bool has_left_ = false;
    // The boundary is infinite from this column on.
    std::ptrdiff_t written_end_ = 0;
    // What of the boundary, the row above, may be live; then what is.
    ColumnRange above_{0, -1};
};

}  // namespace curvewise::detail
