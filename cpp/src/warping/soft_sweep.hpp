// The table of soft-DTW: its last cell, and the derivatives of that cell by both curves.
//
// As for dtw (strip.hpp), the table is swept by strips of rows, each by anti-diagonals, in the
// scaled numbers of kernels/soft.hpp. The gradient needs all of the table. The row above every
// strip is kept. From the last strip up, each is swept again with the shares of every cell's
// predecessors, and weights run back along them. With strips of sqrt(n) rows, this takes O(m
// sqrt(n)) memory, and at most two sweeps forward and one back.
#pragma once

#include <cstddef>

#include "runtime/aligned_buffer.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"
#include "warping/band.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

// A row of scaled numbers, column j at index j + 1.
struct ScaledRow {
    explicit ScaledRow(std::ptrdiff_t columns);
    void clear() noexcept;

    runtime::ScratchVector<double> mantissas;
    runtime::ScratchVector<double> exponents;
};

class SoftSweep {
   public:
    // `scale` is log2(e) / gamma, in the unit of the packed curves.
    SoftSweep(const PackedPair& curves, const Band& band, double scale, Poller& poller);

    // The logarithm of the last cell.
    double log_of_total();
    // The same, with the derivatives of -gamma times it by the packed coordinates, in the places of
    // these; `by_p` and `by_q` are 0 before.
    double log_of_total(double* by_p, double* by_q);

   private:
    struct Strip {
        std::ptrdiff_t first_row;
        std::ptrdiff_t rows;
        std::ptrdiff_t first_diagonal;  // on which a cell may be
        std::ptrdiff_t end_diagonal;
    };
    // The shares of a strip's cells, diagonal by diagonal.
    class ShareTable;
    // What the strip below adds to its neighbours above: column j at index j.
    struct FromBelow {
        runtime::ScratchVector<double> up;
        runtime::ScratchVector<double> diagonal;
    };

    Strip strip(std::ptrdiff_t first_row, std::ptrdiff_t height) const noexcept;
    // The row above the first.
    ScaledRow start() const;
    // Writes the strip's last row to `below`, and the shares if requested.
    void forward(const Strip& strip, const ScaledRow& above, ScaledRow& below, ShareTable* shares);
    // Replaces the contributions of the strip below by those of this one.
    void backward(const Strip& strip, ShareTable& shares, FromBelow& from_below, double* by_p,
                  double* by_q);
    // Moves the range of lanes on to diagonal t.
    void advance(const Strip& strip, std::ptrdiff_t t, ColumnRange& lanes) const noexcept;
    double log_of_last(const ScaledRow& row) const noexcept;
    kernels::ScaledLanes lanes_of(std::ptrdiff_t which) noexcept;

    const kernels::KernelSet& kernels_;
    PackedPair curves_;
    Band band_;
    double scale_;
    Poller& poller_;
    std::ptrdiff_t lane_room_ = 0;
    runtime::AlignedBuffer lanes_;  // three diagonals, then one of costs or weights
};

}  // namespace curvewise::warping
