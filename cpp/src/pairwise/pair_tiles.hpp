// The pairs of a batch in the order in which threads take them. Tiles contain neighbours in lists
// sorted by size, so that a tile's pairs cost about the same and its curves stay in the cache. The
// most expensive tile comes first, so that the last ones to finish are cheap. O(k log k) time for k
// curves, and memory for about 10^5 tiles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/scratch.hpp"

namespace curvewise::pairwise {

using Sizes =
    runtime::ScratchVector<std::ptrdiff_t>;  // the number of points of every curve of a list

enum class PairSet {
    rectangle,  // every row with every column
    triangle    // every two different curves of one list, which is rows and columns
};

// Positions in the sorted lists, the ends not included; and the work of the largest pair, or (on
// the diagonal of a triangle) a little more.
struct Tile {
    std::ptrdiff_t row, row_end;
    std::ptrdiff_t column, column_end;
    std::int64_t largest;
};

class PairTiles {
   public:
    // The work of a curve of n points against `count` curves of `points` points in all.
    using Steps = std::int64_t (*)(std::int64_t n, std::int64_t count,
                                   std::int64_t points) noexcept;

    // The work of all pairs.
    static std::int64_t total(const Sizes& rows, const Sizes& columns, PairSet set,
                              Steps steps) noexcept;

    // `beside`: the columns that are computed at once, so that a tile has as many if it can.
    PairTiles(const Sizes& rows, const Sizes& columns, PairSet set, Steps steps,
              std::ptrdiff_t workers, std::ptrdiff_t beside);

    PairSet set() const noexcept { return set_; }
    const runtime::ScratchVector<Tile>& tiles() const noexcept { return tiles_; }
    // Calls visit(i, j), indices of the lists as given, for every pair of a row and a column of the
    // tile. Ends at once where `visit` returns false.
    template <class Visit>
    void for_each(const Tile& tile, Visit visit) const {
        for (std::ptrdiff_t a = tile.row; a < tile.row_end; ++a) {
            for (std::ptrdiff_t b = first_column(tile, a); b < tile.column_end; ++b) {
                if (!visit(row(a), columns_[static_cast<std::size_t>(b)])) return;
            }
        }
    }

    // The indices by position in the sorted lists.
    std::ptrdiff_t row(std::ptrdiff_t position) const noexcept {
        return rows_[static_cast<std::size_t>(position)];
    }
    const std::ptrdiff_t* columns() const noexcept { return columns_.data(); }
    // The position of the first column that a row of the tile is paired with.
    std::ptrdiff_t first_column(const Tile& tile, std::ptrdiff_t row) const noexcept {
        const bool on_diagonal = set_ == PairSet::triangle && row + 1 > tile.column;
        return on_diagonal ? row + 1 : tile.column;
    }

   private:
    PairSet set_;
    runtime::ScratchVector<std::ptrdiff_t> rows_;  // indices, the largest curve first
    runtime::ScratchVector<std::ptrdiff_t> columns_;
    runtime::ScratchVector<Tile> tiles_;
};

}  // namespace curvewise::pairwise
