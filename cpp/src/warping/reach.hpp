// Whether the Fréchet distance of two curves is at most a threshold. The cells of the table are
// reached from the first over cells whose ground distance is at most the threshold. There is a bit
// for each point of either curve; 64 x 64 cells are swept a word at a time.
#pragma once

#include <cstdint>

#include "runtime/scratch.hpp"
#include "warping/block_recursion.hpp"

namespace curvewise::warping {

// One of the two sides of a block, as the kernels read its points.
struct PointArray {
    const double* data;  // coordinate c of point i is data[c * stride + i * step]
    std::ptrdiff_t stride;
    std::ptrdiff_t step;
};

// For each run of either curve, runs of the other that hold all of its cells that have been
// reached.
struct ReachedRuns {
    runtime::ScratchVector<RunRange> of_p;
    runtime::ScratchVector<RunRange> of_q;
};

class ReachFront {
   public:
    using Value = bool;

    // P has step 1. `reached` is filled where it is not null.
    ReachFront(const PointArray& P, std::ptrdiff_t n, const PointArray& Q, std::ptrdiff_t m,
               std::ptrdiff_t dim, double threshold, kernels::ReachFunction reach,
               ReachedRuns* reached = nullptr);

    bool is_entered(const RunRange& p, const RunRange& q, bool corner) const noexcept;
    void block(const RunRange& p, const RunRange& q) noexcept;
    void pass(const RunRange& p, const RunRange& q, bool corner) noexcept;
    std::int64_t sweep(std::ptrdiff_t p_run, std::ptrdiff_t q_run, bool corner) noexcept;

    bool p_value_before(std::ptrdiff_t run) const noexcept { return is_last_set(p_, run); }
    bool q_value_before(std::ptrdiff_t run) const noexcept { return is_last_set(q_, run); }
    // The last cell.
    bool is_reached() const noexcept {
        return p_[static_cast<std::size_t>((n_ - 1) / 64)] >> ((n_ - 1) % 64) & 1;
    }

   private:
    using Words = runtime::ScratchVector<std::uint64_t>;

    void note_reached(const RunRange& p, const RunRange& q) noexcept;
    static bool is_last_set(const Words& words, std::ptrdiff_t run) noexcept {
        return words[static_cast<std::size_t>(run - 1)] >> 63;
    }

    PointArray P_;
    PointArray Q_;
    std::ptrdiff_t n_;
    std::ptrdiff_t m_;
    kernels::ReachFunction reach_;
    ReachedRuns* reached_;
    kernels::ReachBlock block_{};
    Words p_;  // bit i: whether the last cell swept of point i has been reached
    Words q_;
};

}  // namespace curvewise::warping
