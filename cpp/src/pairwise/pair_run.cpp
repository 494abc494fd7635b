#include "pairwise/pair_run.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "runtime/scratch.hpp"
#include "runtime/workers.hpp"

namespace curvewise::pairwise {
namespace {

class PairRun {
   public:
    PairRun(const PairValues& pairs, const PairTiles& tiles, const PairDestination& destination,
            const BatchOptions& options)
        : pairs_(pairs),
          tiles_(tiles),
          destination_(destination),
          workers_(runtime::resolve_workers(options.workers)),
          cutoff_(options.cutoff),
          are_some_beside_(pairs.most_beside(1, 1) > 1) {}

    void run(Poller& poller) {
        if (pairs_.is_swept() && workers_ > 1) run_giants(poller);
        runtime::for_each(tiles_.tiles().size(), workers_, poller, [this](Poller& own) {
            return [this, &own, memory = pairs_.make_memory(),
                    values = runtime::ScratchVector<double>()](std::size_t t) mutable {
                const PairCall call{cutoff_, 1, own, *memory};
                if (are_some_beside_) {
                    take_columns_beside(tiles_.tiles()[t], call, values);
                } else {
                    take_one_by_one(tiles_.tiles()[t], call);
                }
            };
        });
    }

   private:
    // If there are too few pairs to keep every thread busy to the end, all threads sweep a pair of
    // at least this number of steps a thread together.
    static constexpr std::int64_t giant_cells_per_worker = std::int64_t{1} << 23;
    static constexpr std::size_t few = 8;  // a thread

    bool is_giant(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
        return steps(i, j) >= giant_;
    }
    std::int64_t steps(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
        return pairs_.steps()(pairs_.row_points(i), 1, pairs_.column_points(j));
    }

    double value(std::ptrdiff_t i, std::ptrdiff_t j, const PairCall& call) const {
        // The transposed table holds the same values, to the bit, and fewer, longer rows are swept
        // faster.
        if (pairs_.is_swept() && tiles_.set() == PairSet::triangle &&
            pairs_.row_points(i) > pairs_.column_points(j)) {
            std::swap(i, j);
        }
        return within_cutoff(pairs_.value(i, j, call));
    }
    double within_cutoff(double found) const noexcept {
        return found > cutoff_ ? std::numeric_limits<double>::infinity() : found;
    }

    void run_giants(Poller& poller) {
        runtime::ScratchVector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> giants;
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
        const std::unique_ptr<ThreadMemory> memory = pairs_.make_memory();
        for (const auto& [i, j] : giants) {
            destination_.write(i, j, value(i, j, {cutoff_, workers_, poller, *memory}));
        }
    }

    void take_one_by_one(const Tile& tile, const PairCall& call) const {
        tiles_.for_each(tile, [&](std::ptrdiff_t i, std::ptrdiff_t j) {
            if (is_giant(i, j)) return true;
            destination_.write(i, j, value(i, j, call));
            if (pairs_.is_swept() ? call.poller.stopped() : call.poller.count_steps(steps(i, j))) {
                throw Stopped();
            }
            return true;
        });
    }

    // `values`: the memory of the thread.
    void take_columns_beside(Tile tile, const PairCall& call,
                             runtime::ScratchVector<double>& values) const {
        const std::ptrdiff_t end = tile.column_end;
        for (; tile.column < end; tile.column = tile.column_end) {
            const std::ptrdiff_t count =
                pairs_.gather(tiles_.columns() + tile.column, end - tile.column, call.memory);
            tile.column_end = tile.column + std::max<std::ptrdiff_t>(count, 1);
            if (count < 2) {
                take_one_by_one(tile, call);
                continue;
            }
            values.resize(static_cast<std::size_t>(count));
            for (std::ptrdiff_t a = tile.row; a < tile.row_end; ++a) {
                take_row(tile, a, call, values.data());
            }
        }
    }

    // A row with the columns of the tile, all of which have been gathered.
    void take_row(Tile tile, std::ptrdiff_t a, const PairCall& call, double* values) const {
        const std::ptrdiff_t first = tiles_.first_column(tile, a);
        if (first >= tile.column_end) return;
        const std::ptrdiff_t i = tiles_.row(a);
        if (!pairs_.values(i, first - tile.column, values, call)) {
            tile.row = a;
            tile.row_end = a + 1;
            return take_one_by_one(tile, call);
        }
        for (std::ptrdiff_t b = first; b < tile.column_end; ++b) {
            const std::ptrdiff_t j = tiles_.columns()[b];
            const bool swap = tiles_.set() == PairSet::triangle && j < i;
            destination_.write(swap ? j : i, swap ? i : j, within_cutoff(values[b - first]));
        }
    }

    static constexpr std::int64_t no_giant = std::numeric_limits<std::int64_t>::max();

    const PairValues& pairs_;
    const PairTiles& tiles_;
    const PairDestination& destination_;
    std::ptrdiff_t workers_;
    double cutoff_;
    bool are_some_beside_;
    std::int64_t giant_ = no_giant;
};

}  // namespace

void run_pairs(const PairValues& pairs, const PairTiles& tiles, const PairDestination& destination,
               const BatchOptions& options, Poller& poller) {
    PairRun(pairs, tiles, destination, options).run(poller);
}

}  // namespace curvewise::pairwise
