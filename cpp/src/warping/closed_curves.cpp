// closed_dtw and closed_frechet: curves made rings, and least walks around them (closed_walk.hpp).
#include "curvewise/closed_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "curves/checks.hpp"
#include "curves/ring.hpp"
#include "warping/closed_maximum.hpp"
#include "warping/closed_walk.hpp"
#include "warping/ground_distance.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise {
namespace {

using curves::points_of_ring;
using curves::RangeScale;
using curves::RingPoints;
using curves::Turns;
using runtime::Poller;
using warping::LeastMaximum;
using warping::LeastMaximumSearch;
using warping::LeastSum;
using warping::PackedCurve;
using warping::PointOrder;
using warping::RowDistances;
using warping::Walk;
using warping::walk_between;
using warping::WalkSearch;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The points of a closed curve on its way around, packed.
PackedCurve around(const curves::CheckedCurve& checked, const Turns& turns, const RangeScale& range,
                   Poller& poller) {
    const RingPoints ring(checked.curve, turns, poller);
    return PackedCurve::of(ring.view(), checked.on_sphere, range, PointOrder::forward, poller);
}

struct Found {
    double value;
    Walk walk;
};

// By divide and conquer: sums of parts of a least walk are least, so that walks need not cross.
class LeastSumSearch {
   public:
    LeastSumSearch(std::ptrdiff_t n, std::ptrdiff_t m, RowDistances& distances, Poller& poller)
        : n_(n), m_(m), search_(n, m, distances, poller) {}

    Found run() {
        const auto rows = static_cast<std::size_t>(n_ + 1);
        const Walk low = look(0, walk_between(rows, 0, 0), walk_between(rows, m_, m_));
        Walk high = low;
        for (std::ptrdiff_t& column : high.first) column += m_;
        for (std::ptrdiff_t& column : high.last) column += m_;
        between(0, m_, low, high);
        return std::move(best_);
    }

   private:
    Walk look(std::ptrdiff_t start, const Walk& low, const Walk& high) {
        const double value = search_(start, low, high);
        if (best_.walk.first.empty() || value < best_.value) best_ = {value, search_.walk()};
        return search_.walk();
    }
    // All starts after `first` and before `end`, whose walks are given.
    void between(std::ptrdiff_t first, std::ptrdiff_t end, const Walk& low, const Walk& high) {
        if (end - first < 2) return;
        const std::ptrdiff_t middle = first + (end - first) / 2;
        const Walk walk = look(middle, low, high);
        between(first, middle, low, walk);
        between(middle, end, walk, high);
    }

    std::ptrdiff_t n_, m_;
    WalkSearch<LeastSum> search_;
    Found best_{infinity, {}};
};

// Two closed curves in the range of the kernels. Q begins so that the walks from its point that is
// nearest to P's first one lie in the middle of the table.
class ClosedPair {
   public:
    ClosedPair(const char* measure, const CurveView& P, const CurveView& Q,
               const ClosedOptions& options, Poller& poller)
        : options_(options), poller_(poller) {
        warping::check_ground_distance(options.ground);
        warping::refuse_own_distances(options.ground);
        curves::check_limit("cutoff", options.cutoff, false);
        const curves::Requirements needs = warping::requirements(measure, options.ground);
        check_shapes(needs, {P, "P"}, {Q, "Q"});
        const curves::CheckedCurve p(P, "P", poller, needs.on_sphere);
        const curves::CheckedCurve q(Q, "Q", poller, needs.on_sphere);
        n_ = points_of_ring(P);
        m_ = points_of_ring(Q);
        poller.begin(n_ * m_);
        range_ = warping::range_of(options.ground, std::max(p.largest, q.largest));
        rows_.emplace(around(p, {1, 0}, range_, poller));
        columns_.emplace(around(q, {2, 0}, range_, poller));
        cost_ = warping::canonical_cost(options.ground, {*rows_, *columns_});
        RowDistances first(*rows_, *columns_, options.ground, cost_);
        first.compute(0, 0, m_ - 1);
        std::ptrdiff_t nearest = 0;
        for (std::ptrdiff_t j = 1; j < m_; ++j) {
            if (first[j] < first[nearest]) nearest = j;
        }
        begin_ = (nearest - m_ / 2 + m_) % m_;
        columns_.emplace(around(q, {2, begin_}, range_, poller));
    }

    Alignment least_sum(bool with_path) {
        RowDistances distances(*rows_, *columns_, options_.ground, cost_);
        const Found found = LeastSumSearch(n_, m_, distances, poller_).run();
        return result(found.value, found.walk, with_path);
    }

    Alignment least_maximum(bool with_path) {
        const warping::PutOffRoot root = warping::put_off_root(cost_, options_.ground);
        RowDistances distances(*rows_, *columns_, options_.ground, cost_);
        LeastMaximumSearch search(n_, m_, distances, poller_);
        const bool is_cut = range_.is_identity() && options_.cutoff < infinity;
        const double value = search.run(is_cut ? root.most_under(options_.cutoff) : infinity);
        if (!with_path || value == infinity) return result(root(value), {}, false);
        WalkSearch<LeastMaximum> walks(n_, m_, distances, poller_);
        const auto rows = static_cast<std::size_t>(n_ + 1);
        walks(search.start(value), walk_between(rows, 0, 0), walk_between(rows, 2 * m_, 2 * m_));
        return result(root(value), walks.walk(), true);
    }

   private:
    Alignment result(double value, const Walk& walk, bool with_path) {
        poller_.finish();
        const double distance = range_.restore(value, warping::degree(options_.ground.metric));
        if (!(distance <= options_.cutoff)) return {infinity, {}};
        Alignment found{distance, {}};
        if (with_path) {
            for (std::size_t i = 0; i < walk.first.size(); ++i) {
                for (std::ptrdiff_t j = walk.first[i]; j <= walk.last[i]; ++j) {
                    found.path.push_back({static_cast<std::ptrdiff_t>(i) % n_, (begin_ + j) % m_});
                }
            }
            found.path.pop_back();  // the first pair, met again
        }
        return found;
    }

    ClosedOptions options_;
    Poller& poller_;
    std::ptrdiff_t n_ = 0, m_ = 0, begin_ = 0;
    RangeScale range_{1.0};
    std::optional<PackedCurve> rows_, columns_;
    kernels::Cost cost_{};
};

}  // namespace

double closed_dtw(const CurveView& P, const CurveView& Q, const ClosedOptions& options,
                  Control* control) {
    Poller poller(control);
    return ClosedPair("dtw", P, Q, options, poller).least_sum(false).distance;
}

Alignment closed_dtw_path(const CurveView& P, const CurveView& Q, const ClosedOptions& options,
                          Control* control) {
    Poller poller(control);
    return ClosedPair("dtw", P, Q, options, poller).least_sum(true);
}

double closed_frechet(const CurveView& P, const CurveView& Q, const ClosedOptions& options,
                      Control* control) {
    Poller poller(control);
    return ClosedPair("frechet", P, Q, options, poller).least_maximum(false).distance;
}

Alignment closed_frechet_path(const CurveView& P, const CurveView& Q, const ClosedOptions& options,
                              Control* control) {
    Poller poller(control);
    return ClosedPair("frechet", P, Q, options, poller).least_maximum(true);
}

}  // namespace curvewise
