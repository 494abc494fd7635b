// A region of the table cut into strips, and the state with which one thread sweeps one strip
// after the other.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/scratch.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/strip_narrower.hpp"
#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

// The threads that are worth their start for a region.
std::ptrdiff_t worker_count(const SweepProblem& problem, const Region& region) noexcept;

// How a region is swept: the strips, the kernel, and where results go. Shared by all threads.
class StripPlan {
   public:
    StripPlan(const SweepProblem& problem, const Region& region, std::ptrdiff_t workers,
              const Destination& destination) noexcept;

    std::ptrdiff_t height() const noexcept { return height_; }
    bool is_resident() const noexcept { return resident_ != nullptr; }
    std::ptrdiff_t strips() const noexcept { return (region_.rows + height_ - 1) / height_; }
    std::ptrdiff_t workers() const noexcept { return workers_; }
    // What a row of the region may hold, in columns of the region.
    ColumnRange columns(std::ptrdiff_t row) const noexcept;

   private:
    friend class StripWalk;
    const SweepProblem* problem_;
    Region region_;
    Destination destination_;
    kernels::Output output_;
    kernels::AdvanceFunction resident_;  // null where strips are not swept in registers
    std::ptrdiff_t height_;
    std::ptrdiff_t workers_;
};

// The height of the strips that a sweep with `codes` cuts a region into, and where each begins.
struct CodeLayout {
    CodeLayout(const SweepProblem& problem, const Region& region);
    std::ptrdiff_t height;
    std::ptrdiff_t size = 0;  // of all codes, in bytes
    runtime::ScratchVector<StripCodes> strips;
};

// Aligned to two cache lines, which processors fetch together: a kernel writes to its strip on
// every diagonal, and the walks of two threads must not share a line.
class alignas(128) StripWalk {
   public:
    // `edges`: the data for narrowing, see StripNarrower.
    StripWalk(const StripPlan& plan, bool starts_here, double* boundary, SweepMemory& memory,
              StripEdge* edges);

    // For the caller's own distances, of the columns that the strip may hold; before it is entered.
    void ask_for_distances(std::ptrdiff_t strip);
    void enter(std::ptrdiff_t strip) noexcept;
    // Advances to the diagonal `end`, or to the strip's actual end. Returns the completed share of
    // the strip's rows times all columns of the region. A caller counts this as done, for any band.
    std::int64_t advance(std::ptrdiff_t end) noexcept;
    // After the last diagonal. Returns the rest of that share.
    std::int64_t leave() noexcept;

    // The columns of the strip above that must be finished before a strip can be entered.
    std::ptrdiff_t columns_to_enter(std::ptrdiff_t strip) const noexcept {
        return narrower_.is_on() ? 1 : plan_->columns(strip * plan_->height()).first;
    }
    // Whether all values are above it of which a path to the end crosses one: those of the last two
    // diagonals, of the row above the strip from there on, and of the strip's last row up to there,
    // unless it is the table's, of which the last cell counts. Not of a strip in registers.
    bool is_hopeless(double most) const noexcept;
    std::ptrdiff_t next_diagonal() const noexcept { return strip_.next_diagonal; }
    std::ptrdiff_t end_diagonal() const noexcept { return end_diagonal_; }
    // The columns of the last row that have been written, to stay.
    std::ptrdiff_t finished_columns() const noexcept {
        if (narrower_.is_on() && !narrower_.has_left()) return 0;
        return strip_.next_diagonal - strip_.rows + 1;
    }
    // The strip above the present one is finished.
    void above_is_finished() noexcept { narrower_.above_is_finished(); }
    std::int64_t narrowed_cells() const noexcept { return narrower_.cells(); }

   private:
    void aim(std::ptrdiff_t strip) noexcept;
    void advance_narrowing(std::ptrdiff_t end) noexcept;

    const StripPlan* plan_;
    SweepMemory* memory_;
    bool starts_here_;
    bool at_start_ = false;
    bool is_last_ = false;
    std::ptrdiff_t lane_stride_;
    double* lanes_;
    std::ptrdiff_t* columns_;  // first_column of every row, then last_column
    kernels::AdvanceFunction advance_;
    kernels::CostFunction fill_;
    kernels::Strip strip_{};
    StripNarrower narrower_;
    std::ptrdiff_t first_diagonal_ = 0;
    std::ptrdiff_t end_diagonal_ = 0;
    std::int64_t counted_ = 0;
};

}  // namespace curvewise::warping
