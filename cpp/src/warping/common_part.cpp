// common_part: row by row, the earliest start from which each pair of points is reached.
#include "curvewise/common_part.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "curves/checks.hpp"
#include "curvewise/control.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"
#include "warping/closed_walk.hpp"
#include "warping/ground_distance.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise {
namespace {

using curves::RangeScale;
using runtime::Poller;
using warping::PackedCurve;
using warping::PointOrder;
using warping::RowDistances;

// Distances of rows with the root that is taken last.
class RootedRows {
   public:
    RootedRows(const PackedCurve& P, const PackedCurve& Q, const GroundDistance& ground,
               const RangeScale& range)
        : cost_(warping::canonical_cost(ground, {P, Q})),
          root_(warping::put_off_root(cost_, ground)),
          range_(range),
          degree_(warping::degree(ground.metric)),
          rows_(P, Q, ground, cost_) {}

    void compute(std::ptrdiff_t i, std::ptrdiff_t first, std::ptrdiff_t last) noexcept {
        rows_.compute(i, first, last);
    }
    double operator[](std::ptrdiff_t j) const noexcept {
        return range_.restore(root_(rows_[j]), degree_);
    }
    // Only values under it have a distance of at most `distance`.
    double most_under(double distance) const noexcept {
        return range_.is_identity() ? root_.most_under(distance)
                                    : std::numeric_limits<double>::infinity();
    }
    double under_root(std::ptrdiff_t j) const noexcept { return rows_[j]; }

   private:
    kernels::Cost cost_;
    warping::PutOffRoot root_;
    RangeScale range_;
    int degree_;
    RowDistances rows_;
};

// The edges of P, each as long as the distance of its points.
runtime::ScratchVector<double> lengths_of_edges(RootedRows& distances, std::ptrdiff_t n,
                                                Poller& poller) {
    runtime::ScratchVector<double> lengths;
    lengths.reserve(static_cast<std::size_t>(n));
    for (std::ptrdiff_t i = 0; i + 1 < n; ++i) {
        poller.poll_in_loop(static_cast<std::size_t>(i));
        distances.compute(i, i + 1, i + 1);
        lengths.push_back(distances[i + 1]);
    }
    return lengths;
}

// The starts (i, j) of one row as numbers i m + j: the smallest is the earliest on P, then on Q.
class EarliestStarts {
   public:
    EarliestStarts(std::ptrdiff_t m, double distance)
        : m_(m), distance_(distance), starts_(static_cast<std::size_t>(m), none) {}

    static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();

    // Moves on to row i. Returns the first column with the row's smallest start.
    std::ptrdiff_t next_row(std::ptrdiff_t i, const RootedRows& distances) noexcept {
        const double most = distances.most_under(distance_);
        std::int64_t across = none, left = none, least = none;
        std::ptrdiff_t column = 0;
        for (std::ptrdiff_t j = 0; j < m_; ++j) {
            std::int64_t& start = starts_[static_cast<std::size_t>(j)];
            const std::int64_t above = start;
            const bool is_free = distances.under_root(j) <= most && distances[j] <= distance_;
            start = is_free ? std::min({above, across, left, i * m_ + j}) : none;
            if (start < least) {
                least = start;
                column = j;
            }
            across = above;
            left = start;
        }
        return column;
    }
    std::int64_t at(std::ptrdiff_t j) const noexcept {
        return starts_[static_cast<std::size_t>(j)];
    }

   private:
    std::ptrdiff_t m_;
    double distance_;
    runtime::ScratchVector<std::int64_t> starts_;
};

}  // namespace

CommonPart common_part(const CurveView& P, const CurveView& Q, double distance,
                       const CommonPartOptions& options, Control* control) {
    warping::check_ground_distance(options.ground);
    warping::refuse_own_distances(options.ground);
    curves::check_limit("distance", distance, false);
    const curves::Requirements needs = warping::requirements("common_part", options.ground);
    check_shapes(needs, {P, "P"}, {Q, "Q"});
    const std::ptrdiff_t n = P.size(), m = Q.size();
    Poller poller(control);
    poller.begin(n * m);
    const curves::CheckedCurve p(P, "P", poller, needs.on_sphere);
    const curves::CheckedCurve q(Q, "Q", poller, needs.on_sphere);
    const RangeScale range = warping::range_of(options.ground, std::max(p.largest, q.largest));
    const auto packed = [&](const curves::CheckedCurve& one) {
        return PackedCurve::of(one.curve, one.on_sphere, range, PointOrder::forward, poller);
    };
    const PackedCurve rows = packed(p), columns = packed(q);
    RootedRows of_edges(rows, rows, options.ground, range);
    const runtime::ScratchVector<double> edges = lengths_of_edges(of_edges, n, poller);
    runtime::ScratchVector<double> along{0.0};
    for (const double edge : edges) along.push_back(along.back() + edge);

    RootedRows distances(rows, columns, options.ground, range);
    EarliestStarts starts(m, distance);
    CommonPart best;
    double longest = -1.0;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        distances.compute(i, 0, m - 1);
        const std::ptrdiff_t j = starts.next_row(i, distances);
        const std::int64_t start = starts.at(j);
        if (poller.count_steps(m)) throw Stopped();
        if (start == EarliestStarts::none) continue;
        const std::ptrdiff_t begin = start / m;
        const double length =
            along[static_cast<std::size_t>(i)] - along[static_cast<std::size_t>(begin)];
        if (!(length > longest)) continue;
        longest = length;
        best = {0.0, {begin, i + 1}, {start % m, j + 1}};
    }
    for (std::ptrdiff_t i = best.p.begin; i + 1 < best.p.end; ++i) {
        best.length += edges[static_cast<std::size_t>(i)];
    }
    poller.finish();
    return best;
}

}  // namespace curvewise
