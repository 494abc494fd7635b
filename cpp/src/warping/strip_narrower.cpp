#include "warping/strip_narrower.hpp"

#include <algorithm>
#include <limits>

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

bool StripNarrower::enter(const kernels::Strip& strip, std::ptrdiff_t number,
                          std::ptrdiff_t first_row, std::ptrdiff_t* first_column) noexcept {
    edge_ = edges_ + number + 1;
    first_row_ = first_row;
    is_above_finished_ = false;
    const std::ptrdiff_t first = edge_[-1].first;
    for (std::ptrdiff_t k = 0; k < strip.rows; ++k) {
        first_column[k] = std::max(first_column[k], first);
    }
    low_ = 0;
    high_ = -1;
    counted_to_ = first_column[0];
    left_to_ = first_column[strip.rows - 1];
    has_left_ = false;
    return first >= 0;
}

void StripNarrower::above_is_finished() noexcept { is_above_finished_ = true; }

// On the last diagonal but one, a lane that has just begun is infinite, and its column may be -1.
bool StripNarrower::was_live(const kernels::Strip& strip, std::ptrdiff_t lane) const noexcept {
    return cost_to_go_->is_live(first_row_ + lane, strip.next_diagonal - 2 - lane,
                                strip.before_last[lane + 1]);
}

// On either of the last two diagonals.
bool StripNarrower::is_live(const kernels::Strip& strip, std::ptrdiff_t lane) const noexcept {
    return cost_to_go_->is_live(first_row_ + lane, strip.next_diagonal - 1 - lane,
                                strip.before[lane + 1]) ||
           was_live(strip, lane);
}

// Whether lanes may still be reached other than through themselves: from the row above, or by a
// diagonal step from the lane that ended last.
bool StripNarrower::may_enter(const kernels::Strip& strip) const noexcept {
    if (!is_above_finished_ || strip.next_diagonal - 1 <= edge_[-1].last) return true;
    return strip.low_lane > 0 && was_live(strip, strip.low_lane - 1);
}

// Where the band lets them, lanes begin on the first diagonals since the last look, and end on the
// last ones.
void StripNarrower::count(const kernels::Strip& strip) noexcept {
    const std::ptrdiff_t diagonals = strip.next_diagonal - counted_to_;
    const std::ptrdiff_t begun = strip.high_lane - high_, ended = strip.low_lane - low_;
    cells_ += diagonals * (strip.high_lane - low_ + 1) - begun * (begun - 1) / 2 -
              ended * (ended + 1) / 2;
    counted_to_ = strip.next_diagonal;
    low_ = strip.low_lane;
    high_ = strip.high_lane;
}

// Looks at no cell twice.
bool StripNarrower::look_for_leaving(const kernels::Strip& strip) noexcept {
    const std::ptrdiff_t row = first_row_ + strip.rows - 1;
    const std::ptrdiff_t end = strip.next_diagonal - strip.rows + 1;
    for (; !has_left_ && left_to_ < end; ++left_to_) {
        if (!cost_to_go_->is_live(row, left_to_, strip.boundary[left_to_])) continue;
        has_left_ = true;
        edge_->first = left_to_;
    }
    return has_left_;
}

bool StripNarrower::narrow(kernels::Strip& strip, std::ptrdiff_t* first_column,
                           std::ptrdiff_t* last_column) noexcept {
    count(strip);
    const std::ptrdiff_t next = strip.next_diagonal;
    const bool nothing_enters = !may_enter(strip);
    std::ptrdiff_t low = strip.low_lane, high = strip.high_lane;
    if (nothing_enters) {
        while (low <= high && !is_live(strip, low)) ++low;
    }
    // Paths that have left through the last row pass no diagonal of the strip any more.
    if (high + 1 < strip.rows || !look_for_leaving(strip)) {
        while (high >= low && !is_live(strip, high)) --high;
    }
    for (std::ptrdiff_t k = strip.low_lane; k < low; ++k) last_column[k] = next - 1 - k;
    if (low > high && nothing_enters) return false;
    if (low > strip.low_lane) {
        strip.low_lane = low;
        strip.before[low] = strip.before_last[low] = infinity;
    }
    if (high < strip.high_lane) {
        strip.high_lane = high;
        strip.before[high + 2] = infinity;
        // The lanes below restart, one on each diagonal, all at the same column.
        first_column[high + 1] = std::max(first_column[high + 1], next - high - 1);
        left_to_ = first_column[high + 1];
    }
    low_ = low;
    high_ = high;
    return true;
}

void StripNarrower::leave(const kernels::Strip& strip, const std::ptrdiff_t* first_column,
                          const std::ptrdiff_t* last_column, bool is_last) noexcept {
    count(strip);
    ColumnRange range{0, -1};
    for (std::ptrdiff_t k = 0; k < strip.rows; ++k) {
        range.first = std::max(range.first, first_column[k]);
        range.last = std::max(range.last, last_column[k]);
        swept_->rows[static_cast<std::size_t>(first_row_ + k)] = range;
    }
    const bool is_left = strip.high_lane == strip.rows - 1 && look_for_leaving(strip);
    if (!is_left) edge_->first = -1;
    const std::ptrdiff_t last = strip.next_diagonal - strip.rows;
    edge_->last = is_left ? last : -1;
    // The strip above is finished, and has left the row infinite beyond its last column.
    const std::ptrdiff_t written = std::max(edge_[-1].last, last);
    double* const row = strip.boundary;
    if (edge_->last < written) std::fill(row + edge_->last + 1, row + written + 1, infinity);
    if (is_last && is_left) std::fill(row, row + edge_->first, infinity);
}

}  // namespace curvewise::warping
