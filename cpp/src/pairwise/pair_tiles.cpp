#include "pairwise/pair_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/scratch.hpp"

namespace curvewise::pairwise {
namespace {

// This number keeps threads from waiting long for each other at the end. A tile of 32 x 32 pairs is
// large enough to reuse its curves while they are in the cache.
constexpr double tiles_per_worker = 512.0;
constexpr double max_edge = 32.0;
constexpr double max_tiles = 2e5;

runtime::ScratchVector<std::ptrdiff_t> largest_first(const Sizes& sizes) {
    runtime::ScratchVector<std::ptrdiff_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::ptrdiff_t{0});
    std::sort(order.begin(), order.end(), [&](std::ptrdiff_t a, std::ptrdiff_t b) {
        const std::ptrdiff_t n = sizes[static_cast<std::size_t>(a)];
        const std::ptrdiff_t m = sizes[static_cast<std::size_t>(b)];
        return n != m ? n > m : a < b;
    });
    return order;
}

// Pairs that are computed together are short, and a thread waits for no more than a few of them: it
// needs fewer tiles, a single thread none. The more rows a tile has, the fewer times its columns
// are gathered.
constexpr double tiles_per_worker_beside = 16.0;

std::ptrdiff_t tile_edge(double pairs, std::ptrdiff_t workers, std::ptrdiff_t beside) noexcept {
    const double tiles = beside > 1 ? tiles_per_worker_beside : tiles_per_worker;
    const bool is_largest = beside > 1 && workers == 1;
    const double least = is_largest ? max_edge : 1.0;
    double edge =
        std::clamp(std::sqrt(pairs / (tiles * static_cast<double>(workers))), least, max_edge);
    const auto whole = static_cast<double>(beside);
    if (edge > whole) edge -= std::fmod(edge, whole);
    return static_cast<std::ptrdiff_t>(std::max(edge, std::ceil(std::sqrt(pairs / max_tiles))));
}

}  // namespace

std::int64_t PairTiles::total(const Sizes& rows, const Sizes& columns, PairSet set,
                              Steps steps) noexcept {
    auto count = static_cast<std::int64_t>(columns.size());
    std::int64_t points = std::accumulate(columns.begin(), columns.end(), std::int64_t{0});
    std::int64_t total = 0;
    for (const std::int64_t n : rows) {
        if (set == PairSet::triangle) {
            --count;
            points -= n;
        }
        total += steps(n, count, points);
    }
    return total;
}

PairTiles::PairTiles(const Sizes& rows, const Sizes& columns, PairSet set, Steps steps,
                     std::ptrdiff_t workers, std::ptrdiff_t beside)
    : set_(set),
      rows_(largest_first(rows)),
      columns_(set == PairSet::triangle ? rows_ : largest_first(columns)) {
    const auto height = static_cast<std::ptrdiff_t>(rows.size());
    const auto width = static_cast<std::ptrdiff_t>(columns.size());
    const double share = set == PairSet::triangle ? 0.5 : 1.0;
    const std::ptrdiff_t edge = tile_edge(
        share * static_cast<double>(height) * static_cast<double>(width), workers, beside);
    const auto points = [](const Sizes& sizes, const runtime::ScratchVector<std::ptrdiff_t>& order,
                           std::ptrdiff_t position) {
        return sizes[static_cast<std::size_t>(order[static_cast<std::size_t>(position)])];
    };
    for (std::ptrdiff_t row = 0; row < height; row += edge) {
        const std::ptrdiff_t first = set == PairSet::triangle ? row : 0;
        for (std::ptrdiff_t column = first; column < width; column += edge) {
            tiles_.push_back(
                {row, std::min(row + edge, height), column, std::min(column + edge, width),
                 steps(points(rows, rows_, row), 1, points(columns, columns_, column))});
        }
    }
    std::sort(tiles_.begin(), tiles_.end(), [](const Tile& a, const Tile& b) {
        if (a.largest != b.largest) return a.largest > b.largest;
        return a.row != b.row ? a.row < b.row : a.column < b.column;
    });
}

}  // namespace curvewise::pairwise
