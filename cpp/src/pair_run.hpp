// All pairs of two prepared lists of curves. Threads take tiles of pairs from a common counter.
// Before that, where a few pairs are so large that sharing out whole pairs would leave threads
// idle, each of these is swept by all threads together.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "curvewise/pairwise.hpp"
#include "pair_measures.hpp"
#include "pair_tiles.hpp"
#include "watch.hpp"
#include "workers.hpp"

namespace curvewise::detail {

// Where the value of pair (i, j) goes.
class PairDestination {
   public:
    enum class Shape { matrix, mirrored, condensed };

    PairDestination(double* out, std::size_t columns, Shape shape) noexcept
        : out_(out), columns_(static_cast<std::ptrdiff_t>(columns)), shape_(shape) {}

    void write(std::ptrdiff_t i, std::ptrdiff_t j, double value) const noexcept {
        if (shape_ == Shape::condensed) {
            out_[i * columns_ - i * (i + 1) / 2 + j - i - 1] = value;
            return;
        }
        out_[i * columns_ + j] = value;
        if (shape_ == Shape::mirrored) out_[j * columns_ + i] = value;
    }

   private:
    double* out_;
    std::ptrdiff_t columns_;
    Shape shape_;
};

// All pairs of prepared rows and columns.
template <class Measure>
class PairRun {
   public:
    using References = std::vector<typename Measure::Reference>;
    using Others = std::vector<typename Measure::Other>;

    PairRun(const Measure& measure, const References& rows, const Others& columns,
            const PairTiles& tiles, const PairDestination& destination, const BatchOptions& options)
        : measure_(measure),
          rows_(rows),
          columns_(columns),
          tiles_(tiles),
          destination_(destination),
          workers_(resolve_workers(options.workers)),
          cutoff_(options.cutoff) {}

    void run(Watch& watch) {
        if constexpr (Measure::is_swept) {
            if (workers_ > 1) run_giants(watch);
        }
        const auto useful = static_cast<std::ptrdiff_t>(tiles_.tiles().size());
        run_workers(std::min(workers_, useful), watch,
                    [this](std::ptrdiff_t /*w*/, Watch& own) { take_tiles(own); });
        if (failure_) std::rethrow_exception(failure_);
    }

   private:
    // A pair of at least this many steps a thread is worth sweeping by all threads at once, if
    // there are too few of them to keep every thread busy to the end.
    static constexpr std::int64_t giant_cells_per_worker = std::int64_t{1} << 23;
    static constexpr std::size_t few = 8;  // a thread

    bool is_giant(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
        return steps(i, j) >= giant_;
    }
    std::int64_t steps(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
        return Measure::steps(points(rows_[static_cast<std::size_t>(i)]), 1,
                              points(columns_[static_cast<std::size_t>(j)]));
    }
    template <class Side>
    static std::ptrdiff_t points(const Side& side) noexcept {
        return side.checked.curve.size();
    }

    double value(std::ptrdiff_t i, std::ptrdiff_t j, const PairCall& call) const {
        if constexpr (Measure::is_swept) {
            // The transposed table holds the same values, to the bit, and fewer, longer rows are
            // swept faster.
            const bool is_tall = points(rows_[static_cast<std::size_t>(i)]) >
                                 points(columns_[static_cast<std::size_t>(j)]);
            if (tiles_.set() == PairSet::triangle && is_tall) std::swap(i, j);
        }
        const double found = measure_(rows_[static_cast<std::size_t>(i)],
                                      columns_[static_cast<std::size_t>(j)], call);
        return found > cutoff_ ? std::numeric_limits<double>::infinity() : found;
    }

    void run_giants(Watch& watch) {
        std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> giants;
        giant_ = giant_cells_per_worker * workers_;
        const std::size_t most = few * static_cast<std::size_t>(workers_);
        for (const Tile& tile : tiles_.tiles()) {
            if (tile.largest < giant_ || giants.size() > most) break;
            tiles_.for_each(tile, [&](std::ptrdiff_t i, std::ptrdiff_t j) {
                if (is_giant(i, j)) giants.emplace_back(i, j);
                return giants.size() <= most;
            });
        }
        if (giants.size() > most) giants.clear();
        if (giants.empty()) giant_ = no_giant;
        SweepMemory memory;
        for (const auto& [i, j] : giants) {
            destination_.write(i, j, value(i, j, {cutoff_, workers_, watch, memory}));
        }
    }

    void take_tiles(Watch& watch) noexcept {
        try {
            SweepMemory memory;
            const PairCall call{cutoff_, 1, watch, memory};
            const std::vector<Tile>& tiles = tiles_.tiles();
            for (std::size_t t = next_++; t < tiles.size() && !has_failed_; t = next_++) {
                tiles_.for_each(tiles[t], [&](std::ptrdiff_t i, std::ptrdiff_t j) {
                    if (is_giant(i, j)) return true;
                    destination_.write(i, j, value(i, j, call));
                    if (Measure::is_swept ? watch.stopped() : watch.step(steps(i, j))) {
                        throw Stopped();
                    }
                    return true;
                });
            }
        } catch (...) {
            const std::lock_guard<std::mutex> lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
            has_failed_ = true;
        }
    }

    static constexpr std::int64_t no_giant = std::numeric_limits<std::int64_t>::max();

    const Measure& measure_;
    const References& rows_;
    const Others& columns_;
    const PairTiles& tiles_;
    const PairDestination& destination_;
    std::ptrdiff_t workers_;
    double cutoff_;
    std::int64_t giant_ = no_giant;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> has_failed_{false};
    std::mutex mutex_;
    std::exception_ptr failure_;
};

}  // namespace curvewise::detail
