// Narrows the strips of a sweep to the active cells (see live_columns.hpp). The row above a strip
// gives the columns where it begins. While the strip is swept, the last two diagonals give the
// lanes at both ends, because every path crosses one of them. Pruned cells between active ones are
// swept. Time O(1) for each dropped lane, and O(1) a row.
//
// Several threads may take turns with the strips. A strip may be entered as soon as a column of the
// row above it is active, and ends after the strip above it has.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "warping/kernels/strip.hpp"
#include "warping/live_columns.hpp"

namespace curvewise::warping {

// What the sweeping threads say to each other of a strip's last row, in the order of Pipeline.
struct StripEdge {
    std::ptrdiff_t first = 0;  // the first active column; published with the first column
    std::ptrdiff_t last = -1;  // the last column that was swept; said when the strip is finished
};

class StripNarrower {
   public:
    // Diagonals between two tests: each lets the active lanes grow by one, and tests those lanes.
    static std::ptrdiff_t stride(const kernels::Strip& strip) noexcept {
        return std::clamp<std::ptrdiff_t>(strip.rows / 8, 2, 16);
    }

    StripNarrower() noexcept = default;
    // `edges` belong to the row above the table, whose cells may all be active, and to every strip.
    StripNarrower(const CostToGo& cost_to_go, SweptColumns& swept, StripEdge* edges) noexcept
        : cost_to_go_(&cost_to_go), swept_(&swept), edges_(edges) {}

    bool is_on() const noexcept { return cost_to_go_ != nullptr; }

    // Before a strip's first diagonal: moves the beginnings of its rows to the first active column
    // of the row above. False if there is no such column, and the strip above is finished.
    bool enter(const kernels::Strip& strip, std::ptrdiff_t number, std::ptrdiff_t first_row,
               std::ptrdiff_t* first_column) noexcept;
    // The strip above the present one is finished.
    void above_is_finished() noexcept;
    // After some diagonals: drops pruned lanes at both ends. False if no lane is active, or can
    // become active.
    bool narrow(kernels::Strip& strip, std::ptrdiff_t* first_column,
                std::ptrdiff_t* last_column) noexcept;
    // Whether a path may have left the strip through its last row; from then on, the row's contents
    // do not change.
    bool has_left() const noexcept { return has_left_; }
    // After a strip's last diagonal: sets the cells next to its last row's columns to infinity.
    void leave(const kernels::Strip& strip, const std::ptrdiff_t* first_column,
               const std::ptrdiff_t* last_column, bool is_last) noexcept;

    // What this one has swept.
    std::int64_t cells() const noexcept { return cells_; }

   private:
    bool was_live(const kernels::Strip& strip, std::ptrdiff_t lane) const noexcept;
    bool is_live(const kernels::Strip& strip, std::ptrdiff_t lane) const noexcept;
    bool may_enter(const kernels::Strip& strip) const noexcept;
    bool look_for_leaving(const kernels::Strip& strip) noexcept;
    void count(const kernels::Strip& strip) noexcept;

    const CostToGo* cost_to_go_ = nullptr;
    SweptColumns* swept_ = nullptr;
    StripEdge* edges_ = nullptr;
    std::int64_t cells_ = 0;

    StripEdge* edge_ = nullptr;  // of the present strip; the one before it is of the row above
    std::ptrdiff_t first_row_ = 0;
    // At the last look: the next diagonal, and the lanes.
    std::ptrdiff_t counted_to_ = 0;
    std::ptrdiff_t low_ = 0;
    std::ptrdiff_t high_ = -1;
    // Columns of the last row before this one have been tested.
    std::ptrdiff_t left_to_ = 0;
    bool has_left_ = false;
    bool is_above_finished_ = false;
};

}  // namespace curvewise::warping
