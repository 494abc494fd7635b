#include "pairwise/pair_run.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "pairwise/bounded.hpp"
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
          beside_(pairs.most_beside(1, 1)) {}

    void run(Poller& poller) {
        if (pairs_.is_swept() && workers_ > 1) run_giants(poller);
        runtime::for_each(tiles_.tiles().size(), workers_, poller, [this](Poller& own) {
            return [this, &own, &beside = new_beside()](std::size_t t) {
                const PairCall call{cutoff_, 1, own, *beside.memory};
                if (beside_ > 1) {
                    take_columns_beside(tiles_.tiles()[t], call, beside);
                } else {
                    take_one_by_one(tiles_.tiles()[t], call);
                }
            };
        });
        for (const std::unique_ptr<Beside>& beside : besides_) {
            take_candidates({cutoff_, 1, poller, *beside->memory}, *beside);
        }
    }

   private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    // What a thread needs, from one tile to the next.
    struct Beside : runtime::InScratch {
        std::unique_ptr<ThreadMemory> memory;
        runtime::ScratchVector<double> values;
        runtime::ScratchVector<std::ptrdiff_t> places;
        // Pairs whose bounds are within the cutoff, all of the same sizes.
        runtime::ScratchVector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> candidates;
        Trial trial{4.0, 1};
    };

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

    // Of a row and a column. In a triangle each curve is both: a measure that is not swept takes
    // the first of the list as P.
    double value(std::ptrdiff_t i, std::ptrdiff_t j, const PairCall& call) const {
        if (tiles_.set() == PairSet::triangle && !pairs_.are_bounded()) {
            // The transposed table holds the same values, to the bit, and fewer, longer rows are
            // swept faster.
            const bool swap =
                pairs_.is_swept() ? pairs_.row_points(i) > pairs_.column_points(j) : j < i;
            if (swap) std::swap(i, j);
        }
        return within_cutoff(pairs_.value(i, j, call));
    }
    void write(std::ptrdiff_t i, std::ptrdiff_t j, double value) const noexcept {
        const bool swap = tiles_.set() == PairSet::triangle && j < i;
        destination_.write(swap ? j : i, swap ? i : j, value);
    }
    double within_cutoff(double found) const noexcept { return found > cutoff_ ? infinity : found; }

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
            write(i, j, value(i, j, {cutoff_, workers_, poller, *memory}));
        }
    }

    // By a thread. It lives until all threads have ended.
    Beside& new_beside() {
        auto beside = std::make_unique<Beside>();
        beside->memory = pairs_.make_memory();
        const std::lock_guard<std::mutex> lock(mutex_);
        besides_.push_back(std::move(beside));
        return *besides_.back();
    }

    void take_one_by_one(const Tile& tile, const PairCall& call) const {
        tiles_.for_each(tile, [&](std::ptrdiff_t i, std::ptrdiff_t j) {
            if (is_giant(i, j)) return true;
            write(i, j, value(i, j, call));
            if (pairs_.is_swept() ? call.poller.stopped() : call.poller.count_steps(steps(i, j))) {
                throw Stopped();
            }
            return true;
        });
    }

    void take_columns_beside(Tile tile, const PairCall& call, Beside& beside) const {
        const std::ptrdiff_t end = tile.column_end, rows = tile.row_end - tile.row;
        // Columns are not gathered for bounds alone if no row is due to have bounds.
        const bool rests = cutoff_ < infinity && beside.trial.rests(rows);
        const PairCall gathering{rests ? infinity : cutoff_, 1, call.poller, call.memory};
        bool are_apart = true;
        for (; tile.column < end; tile.column = tile.column_end) {
            const std::ptrdiff_t count =
                pairs_.gather(tiles_.columns() + tile.column, end - tile.column, gathering);
            tile.column_end = tile.column + std::max<std::ptrdiff_t>(count, 1);
            if (count < 2) {
                take_one_by_one(tile, call);
                continue;
            }
            are_apart = false;
            for (std::ptrdiff_t a = tile.row; a < tile.row_end; ++a)
                take_row(tile, a, call, beside);
        }
        if (rests && are_apart) beside.trial.pass(rows);
    }

    // A row with the columns of the tile, all of which have been gathered.
    void take_row(Tile tile, std::ptrdiff_t a, const PairCall& call, Beside& beside) const {
        const std::ptrdiff_t first = tiles_.first_column(tile, a);
        if (first >= tile.column_end) return;
        if (cutoff_ < infinity && beside.trial.is_due() && are_few(tile, a, call, beside)) return;
        const std::ptrdiff_t i = tiles_.row(a);
        beside.values.resize(static_cast<std::size_t>(tile.column_end - first));
        if (!pairs_.values(i, first - tile.column, beside.values.data(), call)) {
            tile.row = a;
            tile.row_end = a + 1;
            return take_one_by_one(tile, call);
        }
        for (std::ptrdiff_t b = first; b < tile.column_end; ++b) {
            const double found = beside.values[static_cast<std::size_t>(b - first)];
            write(i, tiles_.columns()[b], within_cutoff(found));
        }
    }

    // Whether the bounds of most pairs of a row are above the cutoff. These are written, the others
    // are candidates.
    bool are_few(const Tile& tile, std::ptrdiff_t a, const PairCall& call, Beside& beside) const {
        const std::ptrdiff_t i = tiles_.row(a), first = tiles_.first_column(tile, a);
        beside.places.resize(static_cast<std::size_t>(tile.column_end - first + 1));
        std::ptrdiff_t* place = beside.places.data();
        double saved = 0.0;
        const std::ptrdiff_t found = pairs_.candidates(i, first - tile.column, place, saved, call);
        constexpr double trust = 2.0;  // the estimate is a low one, most of all for frechet
        beside.trial.record(found < 0 ? -1.0 : trust * saved);
        if (found < 0) return false;
        place[found] = -1;
        for (std::ptrdiff_t b = first; b < tile.column_end; ++b) {
            const std::ptrdiff_t j = tiles_.columns()[b];
            if (*place == b - first) {
                ++place;
                add_candidate(i, j, call, beside);
            } else {
                write(i, j, infinity);
            }
        }
        return true;
    }

    void add_candidate(std::ptrdiff_t i, std::ptrdiff_t j, const PairCall& call,
                       Beside& beside) const {
        auto& candidates = beside.candidates;
        if (!candidates.empty()) {
            const auto [k, l] = candidates.front();
            if (pairs_.row_points(k) != pairs_.row_points(i) ||
                pairs_.column_points(l) != pairs_.column_points(j)) {
                take_candidates(call, beside);
            }
        }
        candidates.emplace_back(i, j);
        if (static_cast<std::ptrdiff_t>(candidates.size()) == beside_)
            take_candidates(call, beside);
    }

    void take_candidates(const PairCall& call, Beside& beside) const {
        const auto& candidates = beside.candidates;
        if (candidates.empty()) return;
        beside.values.resize(candidates.size());
        const bool are_found =
            pairs_.pair_values(candidates.data(), static_cast<std::ptrdiff_t>(candidates.size()),
                               beside.values.data(), call);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const auto [i, j] = candidates[k];
            write(i, j, are_found ? within_cutoff(beside.values[k]) : value(i, j, call));
        }
        beside.candidates.clear();
        call.poller.throw_if_stopped();
    }

    static constexpr std::int64_t no_giant = std::numeric_limits<std::int64_t>::max();

    const PairValues& pairs_;
    const PairTiles& tiles_;
    const PairDestination& destination_;
    std::ptrdiff_t workers_;
    double cutoff_;
    std::ptrdiff_t beside_;  // the most pairs at once
    std::int64_t giant_ = no_giant;
    std::mutex mutex_;
    runtime::ScratchVector<std::unique_ptr<Beside>> besides_;
};

}  // namespace

void run_pairs(const PairValues& pairs, const PairTiles& tiles, const PairDestination& destination,
               const BatchOptions& options, Poller& poller) {
    PairRun(pairs, tiles, destination, options).run(poller);
}

}  // namespace curvewise::pairwise
