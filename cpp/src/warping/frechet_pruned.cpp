#include "warping/frechet_pruned.hpp"

#include <algorithm>
#include <chrono>

#include "warping/block_values.hpp"
#include "warping/coarse_table.hpp"
#include "warping/hausdorff.hpp"
#include "warping/reach.hpp"

namespace curvewise::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The time of a cell in a block that is swept, in that of a cell of the full sweep.
constexpr double reach_cost = 0.45;
constexpr double value_cost = 2.5;

constexpr double block_cost = 64.0;  // of one that is looked at, besides

// Shares of the full sweep's time: what may be lost where it has to be done after all, always and
// where success is likely; and what a search may take that succeeds.
constexpr double small_share = 0.02;
constexpr double risked_share = 0.25;
constexpr double worthwhile_share = 0.8;

class Stopwatch {
   public:
    double lap() {
        const Clock::time_point now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - start_).count();
        start_ = now;
        return seconds;
    }

   private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

template <class Norm>
class FrechetSearch {
   public:
    FrechetSearch(const kernels::KernelSet& kernels, const PackedPair& curves, Metric metric,
                  double cutoff, Poller& poller, PruningRecord& record, Persistence persistence)
        : kernels_(kernels),
          curves_(curves),
          metric_(metric),
          cutoff_(cutoff),
          poller_(poller),
          record_(record),
          gives_up_(persistence == Persistence::while_it_pays),
          cells_(static_cast<double>(curves.rows()) * static_cast<double>(curves.columns())),
          P_(curves.p, PointOrder::forward),
          Q_(curves.q, PointOrder::reversed),
          coarse_(P_, Q_, metric, most_boxes()) {}

    std::optional<double> value() {
        const bool is_promising = find_bounds();
        record_.bound_seconds += stopwatch_.lap();
        if (record_.lower > cutoff_) return infinity;
        const std::optional<double> found =
            is_promising ? search() : std::optional<double>(std::nullopt);
        record_.search_seconds += stopwatch_.lap();
        return found;
    }

   private:
    double& lower() noexcept { return record_.lower; }
    double& upper() noexcept { return record_.upper; }

    // Blocks of `block_side`, which say exactly what a recursion will sweep, or larger ones.
    std::ptrdiff_t most_boxes() const noexcept {
        constexpr std::ptrdiff_t most = 1 << 16;
        return std::min(runs_of(P_.size()) * runs_of(Q_.size()), most);
    }

    double reach_share(double threshold) const {
        return reach_cost * coarse_.undecided_share(threshold, threshold);
    }
    double value_share(double from, double to) const {
        return value_cost * coarse_.undecided_share(from, to);
    }

    // Whether to go on.
    bool find_bounds() {
        const std::ptrdiff_t dim = P_.dim();
        lower() = std::max(coarse_.lower(),
                           std::max(point_distance<Norm>(P_.points(), 0, Q_.points(), 0, dim),
                                    point_distance<Norm>(P_.points(), P_.size() - 1, Q_.points(),
                                                         Q_.size() - 1, dim)));
        upper() = coarse_.upper();
        // As on noise, whose boxes all lie over each other.
        if (gives_up_ && coarse_.undecided_share(lower(), lower()) > 0.8) return false;
        lower() = hausdorff_bound(P_, Q_, metric_, lower(), cells_ * small_share / 2, poller_);
        return true;
    }

    // Whether the last cell is reached over ground distances of at most `threshold`.
    bool is_within(double threshold) {
        const PointArray p{curves_.p.data(), curves_.p.stride(), 1};
        const PointArray q{curves_.q.data() + Q_.size() - 1, curves_.q.stride(), -1};
        ReachFront front(p, P_.size(), q, Q_.size(), P_.dim(), threshold,
                         kernels_.reach(metric_, P_.dim()));
        run(front, threshold, threshold, true);
        ++record_.reach_passes;
        return front.is_reached();
    }

    // The last cell, which must be above `lower` or at it, and at most `upper`.
    double value_between(double lower, double upper) {
        ValueFront front(curves_, upper, kernels_.values(metric_, P_.dim()));
        run(front, lower, upper, lower);
        ++record_.value_passes;
        return front.last_cell();
    }

    template <class Front>
    void run(Front& front, double lower, double upper, typename Front::Value corner) {
        BlockRecursion<Norm, Front> recursion(P_, Q_, lower, upper, front, poller_);
        recursion.run(corner);
        record_.blocks += recursion.counts().blocks;
        record_.swept_cells += recursion.counts().swept_cells;
    }

    // Raises the lower bound until the distance is found.
    std::optional<double> search() {
        double factor = first_factor;
        double threshold = std::min(lower(), cutoff_);
        while (lower() < upper()) {
            if (!is_worth_trying(threshold)) return std::nullopt;
            if (is_within(threshold)) {
                upper() = threshold;
                break;
            }
            if (threshold >= cutoff_) return infinity;
            lower() = threshold;
            threshold = lower() > 0.0 ? lower() * factor : upper() * smallest_step;
            threshold = std::min(std::min(threshold, upper()), cutoff_);
            factor *= factor;
        }
        if (lower() < upper()) {
            if (gives_up_ && value_share(lower(), upper()) > 1.0) return std::nullopt;
            lower() = upper() = value_between(lower(), upper());
        }
        return lower() > cutoff_ ? infinity : lower();
    }

    // What the search has taken, as a share of the full sweep.
    double spent() const noexcept {
        return (reach_cost * static_cast<double>(record_.swept_cells) +
                block_cost * static_cast<double>(record_.blocks)) /
               cells_;
    }

    // Whether to find out if the distance is at most `threshold`, and to go on from there.
    bool is_worth_trying(double threshold) const {
        if (!gives_up_) return true;
        const double share = reach_share(threshold);
        if (spent() + share <= small_share) return true;
        return spent() + share <= risked_share &&
               share + value_share(threshold, threshold * first_factor) <= worthwhile_share;
    }

    // Steps of the bound, in squares for the Euclidean distance.
    static constexpr double first_factor = 1.04;
    static constexpr double smallest_step = 0x1p-20;

    const kernels::KernelSet& kernels_;
    PackedPair curves_;
    Metric metric_;
    double cutoff_;
    Poller& poller_;
    PruningRecord& record_;
    bool gives_up_;
    Stopwatch stopwatch_;
    double cells_;
    BoxTree P_;
    BoxTree Q_;
    CoarseTable coarse_;
};

}  // namespace

std::optional<double> frechet_pruned(const kernels::KernelSet& kernels, const PackedPair& curves,
                                     Metric metric, double cutoff, Poller& poller,
                                     PruningRecord& record, Persistence persistence) {
    // Below, trees and bounds take longer than they save.
    constexpr std::ptrdiff_t fewest_cells = 1 << 19;
    const bool is_short = curves.rows() * curves.columns() < fewest_cells;
    if (kernels.reach(metric, curves.dim()) == nullptr) return std::nullopt;
    if (is_short && persistence == Persistence::while_it_pays) return std::nullopt;
    return with_norm(metric, [&](auto norm) {
        return FrechetSearch<decltype(norm)>(kernels, curves, metric, cutoff, poller, record,
                                             persistence)
            .value();
    });
}

}  // namespace curvewise::detail
