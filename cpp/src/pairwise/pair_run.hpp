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

#include "pairwise/batch.hpp"
#include "pairwise/measure.hpp"
#include "pairwise/pair_tiles.hpp"
#include "runtime/poller.hpp"
#include "runtime/workers.hpp"

namespace curvewise::detail {

// All pairs of prepared rows and columns.
template <class M>
class PairRun {
   public:
    using Rows = std::vector<typename M::PreparedP>;
    using Columns = std::vector<typename M::PreparedQ>;

    PairRun(const M& measure, const Rows& rows, const Columns& columns, const PairTiles& tiles,
            const PairDestination& destination, const BatchOptions& options)
        : measure_(measure),
          rows_(rows),
          columns_(columns),
          tiles_(tiles),
          destination_(destination),
          workers_(resolve_workers(options.workers)),
          cutoff_(options.cutoff) {}

    void run(Control* control) {
        Poller poller(control);
        poller.begin(tiles_.total());
        run(poller);
        poller.finish();
    }

   private:
    void run(Poller& poller) {
        if constexpr (M::is_swept) {
            if (workers_ > 1) run_giants(poller);
        }
        const auto useful = static_cast<std::ptrdiff_t>(tiles_.tiles().size());
        run_workers(std::min(workers_, useful), poller,
                    [this](std::ptrdiff_t /*w*/, Poller& own) { take_tiles(own); });
        if (failure_) std::rethrow_exception(failure_);
    }

    // A pair of at least this many steps a thread is worth sweeping by all threads at once, if
    // there are too few of them to keep every thread busy to the end.
    static constexpr std::int64_t giant_cells_per_worker = std::int64_t{1} << 23;
    static constexpr std::size_t few = 8;  // a thread

    bool is_giant(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
        return steps(i, j) >= giant_;
    }
    std::int64_t steps(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
        return M::steps(points(rows_[static_cast<std::size_t>(i)]), 1,
                        points(columns_[static_cast<std::size_t>(j)]));
    }
    template <class Side>
    static std::ptrdiff_t points(const Side& side) noexcept {
        return side.checked.curve.size();
    }

    double value(std::ptrdiff_t i, std::ptrdiff_t j, const Call<typename M::Memory>& call) const {
        if constexpr (M::is_swept) {
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

    void run_giants(Poller& poller) {
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
        typename M::Memory memory;
        for (const auto& [i, j] : giants) {
            destination_.write(i, j, value(i, j, {cutoff_, workers_, poller, memory}));
        }
    }

    void take_tiles(Poller& poller) noexcept {
        try {
            typename M::Memory memory;
            const Call<typename M::Memory> call{cutoff_, 1, poller, memory};
            const std::vector<Tile>& tiles = tiles_.tiles();
            for (std::size_t t = next_++; t < tiles.size() && !has_failed_; t = next_++) {
                tiles_.for_each(tiles[t], [&](std::ptrdiff_t i, std::ptrdiff_t j) {
                    if (is_giant(i, j)) return true;
                    destination_.write(i, j, value(i, j, call));
                    if (M::is_swept ? poller.stopped() : poller.count_steps(steps(i, j))) {
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

    const M& measure_;
    const Rows& rows_;
    const Columns& columns_;
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
