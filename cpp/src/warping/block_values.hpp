// The cells of the Fréchet table along the front of a recursion over its blocks. Cells that are at
// most the recursion's upper bound are exact, or equal to the lower bound if they are below it. The
// rest are above the upper bound. In a free block of similar curves, most values along the front
// are equal. A run of equal values is stored as one, and blocked runs cost almost nothing.
#pragma once

#include <cstdint>
#include <limits>

#include "runtime/aligned_buffer.hpp"
#include "runtime/scratch.hpp"
#include "warping/block_recursion.hpp"

namespace curvewise::warping {

// The values along one of the curves.
class FrontSide {
   public:
    explicit FrontSide(std::ptrdiff_t points);

    double operator[](std::ptrdiff_t point) const noexcept {
        const auto run = static_cast<std::size_t>(point / kernels::block_side);
        return is_even_[run] ? lowest_[run] : values_.data()[point];
    }
    double lowest(const RunRange& runs) const noexcept;
    void fill(const RunRange& runs, double value) noexcept;
    // Every value to the smallest of itself, those before it, and `entering`.
    void take_smallest_so_far(const RunRange& runs, double entering) noexcept;
    // The values of a run, one by one; after they have been changed, `changed`.
    double* spread(std::ptrdiff_t run) noexcept;
    void changed(std::ptrdiff_t run, double upper) noexcept;

   private:
    std::ptrdiff_t points_of(std::ptrdiff_t run) const noexcept;

    std::ptrdiff_t points_;
    runtime::ScratchVector<double> lowest_;         // of each run
    runtime::ScratchVector<std::uint8_t> is_even_;  // all of a run are the lowest
    AlignedBuffer values_;
};

class ValueFront {
   public:
    using Value = double;

    ValueFront(const PackedPair& curves, double upper, kernels::ValueFunction values);

    bool is_entered(const RunRange& p, const RunRange& q, double corner) const noexcept {
        return corner <= upper_ || p_.lowest(p) <= upper_ || q_.lowest(q) <= upper_;
    }
    void block(const RunRange& p, const RunRange& q) noexcept;
    void pass(const RunRange& p, const RunRange& q, double corner) noexcept;
    std::int64_t sweep(std::ptrdiff_t p_run, std::ptrdiff_t q_run, double corner) noexcept;

    double p_value_before(std::ptrdiff_t run) const noexcept {
        return p_[run * kernels::block_side - 1];
    }
    double q_value_before(std::ptrdiff_t run) const noexcept {
        return q_[run * kernels::block_side - 1];
    }
    double last_cell() const noexcept { return p_[curves_.rows() - 1]; }

   private:
    PackedPair curves_;
    double upper_;
    kernels::ValueFunction values_;
    FrontSide p_;
    FrontSide q_;
};

}  // namespace curvewise::warping
