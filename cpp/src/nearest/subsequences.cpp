// The best runs of one curve for another (see curvewise/subsequence.hpp).
//
// The table is swept with its paths' origins. In its last row, two paths never cross, since a path
// that meets another continues with it: the origins rise with the ends. So an answer from `start`
// to `stop` affects two kinds of ends. The ends from start to stop are removed. The ends behind
// them whose paths began no later than stop are swept again, as a separate section. All other ends
// remain the best of their section, with bitwise identical values: a minimum that is attained in a
// smaller set is also its minimum.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "curves/checks.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/subsequence.hpp"
#include "runtime/scratch.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/sweep.hpp"
#include "warping/warping_problem.hpp"

namespace curvewise {
namespace {

using runtime::Poller;
using warping::PackedCurve;
using warping::PointOrder;
using warping::Row;
using warping::WarpingOptions;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr WholeNumberRange count_range{1, "give a whole number >= 1"};

// The least value of a row, again and again, while some of its values change: by the least of every
// block. O(m) at first, then O(sqrt(m)) for a look or a change of one value.
class LeastOfRow {
   public:
    explicit LeastOfRow(std::ptrdiff_t size)
        : size_(size),
          block_(std::max<std::ptrdiff_t>(
              64, static_cast<std::ptrdiff_t>(std::sqrt(static_cast<double>(size))))),
          blocks_(static_cast<std::size_t>((size + block_ - 1) / block_)) {}

    void update(const Row& row, std::ptrdiff_t first, std::ptrdiff_t last) {
        for (std::ptrdiff_t b = first / block_; b <= last / block_; ++b) {
            const double* const begin = row.data() + b * block_;
            const double* const end = row.data() + std::min((b + 1) * block_, size_);
            blocks_[static_cast<std::size_t>(b)] = *std::min_element(begin, end);
        }
    }
    // The first among equals.
    std::ptrdiff_t find(const Row& row) const {
        const auto least = std::min_element(blocks_.begin(), blocks_.end());
        const std::ptrdiff_t first = (least - blocks_.begin()) * block_;
        const double* const begin = row.data() + first;
        return std::find(begin, row.data() + std::min(first + block_, size_), *least) - row.data();
    }

   private:
    std::ptrdiff_t size_;
    std::ptrdiff_t block_;
    runtime::ScratchVector<double> blocks_;
};

class SubsequenceSearch {
   public:
    SubsequenceSearch(const WarpingOptions& options, const warping::PackedPair& curves,
                      const curves::RangeScale& range, Poller& poller)
        : curves_(curves),
          range_(range),
          degree_(warping::degree(options.ground.metric)),
          cutoff_(options.cutoff),
          poller_(poller),
          problem_{*warping::active_level().kernels,
                   curves,
                   options.rule,
                   warping::canonical_cost(options.ground, curves),
                   options.ground.parameter(),
                   warping::Band(curves.rows(), curves.columns(), std::nullopt),
                   true,
                   options.workers,
                   poller,
                   memory_},
          least_(curves.columns()) {
        if (options.rule == kernels::Rule::frechet) {
            root_ = warping::put_off_root(problem_.cost, options.ground);
        }
    }

    std::vector<Subsequence> find(std::ptrdiff_t count) {
        const std::ptrdiff_t m = curves_.columns();
        sweep_piece(0, m, values_, origins_);
        least_.update(values_, 0, m - 1);
        poller_.set_counting(false);  // the pieces to come are not foreseen
        runtime::ScratchVector<Subsequence> found;
        while (static_cast<std::ptrdiff_t>(found.size()) < count) {
            const std::ptrdiff_t stop = least_.find(values_);
            const double distance = range_.restore(values_[stop], degree_);
            if (values_[stop] == infinity || distance > cutoff_) break;
            const auto start = static_cast<std::ptrdiff_t>(origins_[stop]);
            found.push_back({distance, start, stop});
            if (static_cast<std::ptrdiff_t>(found.size()) < count) remove(start, stop);
        }
        poller_.set_counting(true);
        return {found.begin(), found.end()};
    }

   private:
    // The distances in the last row of the table of columns from `first` on, and where its paths
    // began.
    void sweep_piece(std::ptrdiff_t first, std::ptrdiff_t columns, Row& values, Row& origins) {
        sweep_table(first, columns, values, origins);
        // Before any are compared: roots may be equal where squares are not.
        root_.take(values.data(), columns);
    }

    void sweep_table(std::ptrdiff_t first, std::ptrdiff_t columns, Row& values, Row& origins) {
        const std::ptrdiff_t n = curves_.rows();
        values.assign(columns, 0.0);
        origins.assign(columns, 0.0);
        sweep(problem_, {0, 1, first, columns}, false, values.data(), {});
        for (std::ptrdiff_t j = 0; j < columns; ++j) {
            origins[j] = static_cast<double>(first + j);
        }
        if (n == 1) return;
        warping::Destination destination;
        destination.origins = origins.data();
        sweep(problem_, {1, n - 1, first, columns}, false, values.data(), destination);
    }

    // Removes a run that is an answer, and updates the ends behind it.
    void remove(std::ptrdiff_t start, std::ptrdiff_t stop) {
        for (std::ptrdiff_t j = start; j <= stop; ++j) values_[j] = origins_[j] = infinity;
        const std::ptrdiff_t first = stop + 1;
        std::ptrdiff_t end = first;
        while (end < curves_.columns() && origins_[end] <= static_cast<double>(stop)) ++end;
        if (end > first) {
            Row values, origins;
            sweep_piece(first, end - first, values, origins);
            std::copy_n(values.data(), end - first, values_.data() + first);
            std::copy_n(origins.data(), end - first, origins_.data() + first);
        }
        least_.update(values_, start, std::max(stop, end - 1));
    }

    warping::PackedPair curves_;
    curves::RangeScale range_;
    int degree_;  // of homogeneity in the coordinates
    double cutoff_;
    warping::PutOffRoot root_;  // of the values that the table holds
    Poller& poller_;
    warping::SweepMemory memory_;
    warping::SweepProblem problem_;
    // By the column where a run ends: the distance of the best that is left, and where it begins.
    // Infinite where no run may end.
    Row values_;
    Row origins_;
    LeastOfRow least_;
};

std::vector<Subsequence> find_subsequences(const CurveView& P, const CurveView& Q,
                                           std::ptrdiff_t count, const WarpingOptions& options,
                                           Control* control) {
    curves::check_whole_number("k", count, count_range);
    const curves::Requirements needs = warping::requirements(options.measure, options.ground);
    curves::check_shapes(needs, {P, "P"}, {Q, "Q"});
    Poller poller(control);
    const curves::CheckedCurve checked_p(P, "P", poller, needs.on_sphere);
    const curves::CheckedCurve checked_q(Q, "Q", poller, needs.on_sphere);
    poller.begin(P.size() * Q.size());
    const curves::RangeScale range =
        warping::range_of(options.ground, std::max(checked_p.largest, checked_q.largest));
    const auto pack = [&](const CurveView& curve, PointOrder order) {
        return PackedCurve::of(curve, needs.on_sphere, range, order, poller);
    };
    const PackedCurve p = pack(P, PointOrder::forward);
    poller.poll_in_loop(0);
    const PackedCurve q = pack(Q, PointOrder::reversed);
    std::vector<Subsequence> found = SubsequenceSearch(options, {p, q}, range, poller).find(count);
    poller.finish();
    return found;
}

}  // namespace

std::vector<Subsequence> subsequences(const CurveView& P, const CurveView& Q, std::ptrdiff_t count,
                                      const DtwOptions& options, Control* control) {
    warping::refuse_own_distances(options.ground);
    DtwOptions open = options;
    open.open_begin = open.open_end = true;
    return find_subsequences(P, Q, count, warping::checked_options(open), control);
}

std::vector<Subsequence> subsequences(const CurveView& P, const CurveView& Q, std::ptrdiff_t count,
                                      const FrechetOptions& options, Control* control) {
    warping::refuse_own_distances(options.ground);
    return find_subsequences(P, Q, count, warping::checked_options(options), control);
}

}  // namespace curvewise
