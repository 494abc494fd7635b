// The cumulative table of DTW or Fréchet, strip by strip, in any of its three forms: its last row
// only (memory O(m)), with the predecessor of every cell (one byte each), or whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "aligned_buffer.hpp"
#include "band.hpp"
#include "curvewise/alignment.hpp"
#include "curvewise/ground_distance.hpp"
#include "kernels/strip.hpp"
#include "packed_pair.hpp"

namespace curvewise::detail {

struct SweepProblem {
    const kernels::KernelSet& kernels;
    const PackedPair& curves;
    kernels::Recurrence recurrence;
    kernels::Cost cost;
    double minkowski_p;
    Band band;
    bool open_begin;
};

// Throws std::invalid_argument for an order of minkowski outside [1, inf].
void check_ground_distance(const GroundDistance& ground);

// The metric to compute: orders 1, 2 and inf of minkowski by their own names, and everything but
// sqeuclidean as |difference| in one dimension.
kernels::Cost canonical_cost(const GroundDistance& ground, const PackedPair& curves) noexcept;

// The last row of the table.
class BottomRow {
   public:
    explicit BottomRow(std::ptrdiff_t columns);
    double* data() noexcept { return row_.data(); }
    double operator[](std::ptrdiff_t j) const noexcept { return row_.data()[j]; }
    // The first column with the smallest value.
    std::ptrdiff_t argmin() const noexcept;

   private:
    std::ptrdiff_t columns_;
    AlignedBuffer row_;
};

BottomRow sweep(const SweepProblem& problem);
BottomRow sweep_into_table(const SweepProblem& problem, double* table);

// The table of predecessors, in the order in which the strips were swept.
class PredecessorTable {
   public:
    // Sweeps. Throws AllocationError where n m bytes cannot be had.
    explicit PredecessorTable(const SweepProblem& problem);

    const BottomRow& bottom_row() const noexcept { return bottom_; }
    // The path that ends in the last row at `column`; in row 0 it stops at once if open_begin.
    std::vector<std::array<std::int64_t, 2>> path_to(std::ptrdiff_t column) const;

   private:
    kernels::Predecessor at(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept;

    struct StripCodes {
        std::ptrdiff_t first_diagonal;
        std::ptrdiff_t offset;
    };
    std::ptrdiff_t rows_;
    std::ptrdiff_t strip_height_;
    bool open_begin_;
    std::vector<StripCodes> strips_;
    std::unique_ptr<std::uint8_t[]> codes_;
    BottomRow bottom_;
};

}  // namespace curvewise::detail
