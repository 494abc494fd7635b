// The columns of the table that a sweep covers, row by row. The band never narrows. A sweep may be
// limited to the columns that an earlier sweep left of every row, or narrow its columns while it
// runs. Cells from which no path of interest continues are pruned, and count as infinite.
//
// Pruning changes no value on a path of interest, nor a decision on it. Sums and minima are
// monotone in floating point, too. A predecessor that is not on such a path is worse, and can only
// become still worse.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "runtime/scratch.hpp"
#include "warping/band.hpp"

namespace curvewise::warping {

// The least cost of the rest of a path, and the largest valid cost of a whole path: they decide
// which cells are pruned.
struct CostToGo {
    // No path that costs more is of interest.
    double most;
    // Just below 1: sums in another order than the table's are this much too large at most.
    double slack;
    // The least that the rows after row i, the columns after column j cost, from index -1 on.
    const double* after_row;
    const double* after_column;
    // Whether a path pays for both (symmetric2 counts a diagonal step twice), or for the larger.
    bool they_add;

    bool is_live(std::ptrdiff_t row, std::ptrdiff_t column, double value) const noexcept {
        const double rows = after_row[row], columns = after_column[column];
        const double rest = they_add ? rows + columns : std::max(rows, columns);
        return (value + rest) * slack <= most;
    }
};

// The columns that a narrowing sweep has covered.
struct SweptColumns {
    // Per row, ends that never fall: every path of interest keeps to them.
    runtime::ScratchVector<ColumnRange> rows;
    std::int64_t cells = 0;
};

class LiveColumns {
   public:
    LiveColumns(const Band& band) noexcept : band_(band) {}
    // What `kept` says of every row of `base`. It must outlive the sweep.
    LiveColumns(const LiveColumns& base, const SweptColumns& kept) noexcept
        : band_(base.band_), kept_(kept.rows.data()) {}
    // `base`, narrowed strip by strip to the active cells; `swept` receives the remaining columns.
    // Both must outlive the sweep, which covers the whole table.
    LiveColumns(const LiveColumns& base, const CostToGo& cost_to_go, SweptColumns& swept) noexcept
        : band_(base.band_), kept_(base.kept_), cost_to_go_(&cost_to_go), swept_(&swept) {}

    // Whether some cells are left out from the outset.
    bool is_limited() const noexcept { return kept_ != nullptr || band_.is_limited(); }

    // What a row may hold at most; both ends never fall from row to row.
    ColumnRange columns(std::ptrdiff_t row) const noexcept {
        return kept_ != nullptr ? kept_[row] : band_.columns(row);
    }

    // Null where nothing narrows.
    const CostToGo* cost_to_go() const noexcept { return cost_to_go_; }
    SweptColumns* swept() const noexcept { return swept_; }

   private:
    Band band_;
    const ColumnRange* kept_ = nullptr;
    const CostToGo* cost_to_go_ = nullptr;
    SweptColumns* swept_ = nullptr;
};

}  // namespace curvewise::warping
