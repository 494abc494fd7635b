// closed_frechet_continuous: the curves once and twice around, from where a search needs few walks.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "continuous/closed_leash.hpp"
#include "continuous/nearest.hpp"
#include "continuous/plain_range.hpp"
#include "curves/checks.hpp"
#include "curves/ring.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "runtime/workers.hpp"

namespace curvewise {
namespace {

using continuous::BoxedCurve;
using continuous::Furthest;
using curves::RangeScale;
using curves::RingPoints;
using curves::Turns;
using runtime::Poller;

// A closed curve on its way around, boxed and scaled.
class BoxedRing {
   public:
    BoxedRing(const CurveView& curve, const Turns& turns, const RangeScale& range, Poller& poller)
        : ring_(curve, turns, poller), boxed_(ring_.view(), range, poller) {}
    const CurveView& view() const noexcept { return ring_.view(); }
    const BoxedCurve& boxed() const noexcept { return boxed_; }

   private:
    RingPoints ring_;
    BoxedCurve boxed_;
};

// The vertices of a closed curve that are nearest to a point, and furthest from it.
struct Extremes {
    std::ptrdiff_t nearest = 0, furthest = 0;
};

template <int Dim>
Extremes extremes(const BoxedCurve& ring, const double* z) noexcept {
    Extremes found;
    double least = std::numeric_limits<double>::infinity(), most = -1.0;
    for (std::ptrdiff_t j = 0; j < ring.size() - 1; ++j) {
        const double square = continuous::square_distance<Dim>(ring.point<Dim>(j), z, ring.dim());
        if (square < least) {
            least = square;
            found.nearest = j;
        }
        if (square > most) {
            most = square;
            found.furthest = j;
        }
    }
    return found;
}

// Two checked closed curves, once around from their first points.
struct ClosedPair {
    ClosedPair(const CurveView& P, const CurveView& Q, Poller& poller)
        : largest(std::max(curves::CheckedCurve(P, "P", poller).largest,
                           curves::CheckedCurve(Q, "Q", poller).largest)),
          range(continuous::plain_scale(largest)),
          p(P, {1, 0}, range, poller),
          q(Q, {1, 0}, range, poller) {}

    double largest;
    RangeScale range;
    BoxedRing p, q;
};

// Calls use(search), the first curve and the second beginning at these points.
template <int Dim, class Use>
auto with_search_from(const CurveView& P, std::ptrdiff_t begin_p, const CurveView& Q,
                      std::ptrdiff_t begin_q, const RangeScale& range, Poller& poller, Use use) {
    const BoxedRing first(P, {1, begin_p}, range, poller);
    const BoxedRing second(Q, {2, begin_q}, range, poller);
    continuous::ClosedLeashSearch<Dim> search(first.view(), second.view(), first.boxed(),
                                              second.boxed(), range, poller);
    return use(search);
}

// Calls use(search, square), as ClosedLeashSearch asks. The first curve is the one whose vertex is
// furthest from the other curve. The second begins far from that vertex, so that the free sections
// near it are not cut.
template <int Dim, class Use>
auto with_quick_search(const CurveView& P, const CurveView& Q, const ClosedPair& pair,
                       Poller& poller, Use use) {
    const BoxedCurve &p = pair.p.boxed(), &q = pair.q.boxed();
    const Furthest of_p = continuous::NearestEdges<Dim>(q, poller).furthest(p, {}),
                   of_q = continuous::NearestEdges<Dim>(p, poller).furthest(q, {});
    const bool swap = of_p.square < of_q.square;
    const Furthest& furthest = swap ? of_q : of_p;
    const double* const z = (swap ? q : p).template point<Dim>(furthest.vertex);
    const std::ptrdiff_t begin = extremes<Dim>(swap ? p : q, z).furthest;
    return with_search_from<Dim>(swap ? Q : P, furthest.vertex, swap ? P : Q, begin, pair.range,
                                 poller,
                                 [&](auto& search) { return use(search, furthest.square); });
}

// Calls use(pair, dim, poller) for checked curves.
template <class Use>
auto with_pair(const CurveView& P, const CurveView& Q, const FrechetContinuousOptions& options,
               Control* control, Use use) {
    runtime::resolve_workers(options.workers);
    curves::check_shapes({FrechetContinuousOptions::measure, 1, false}, {P, "P"}, {Q, "Q"});
    Poller poller(control);
    poller.begin(P.size() + Q.size());
    const ClosedPair pair(P, Q, poller);
    auto found =
        continuous::with_dimension(P.dim(), [&](auto dim) { return use(pair, dim, poller); });
    poller.finish();
    return found;
}

}  // namespace

double closed_frechet_continuous(const CurveView& P, const CurveView& Q,
                                 const FrechetContinuousOptions& options, Control* control) {
    const auto value = [](auto& search, double square) { return search.value(square); };
    return with_pair(P, Q, options, control, [&](const auto& pair, auto dim, Poller& poller) {
        return with_quick_search<dim>(P, Q, pair, poller, value);
    });
}

Interval closed_frechet_continuous_bounds(const CurveView& P, const CurveView& Q,
                                          const FrechetContinuousOptions& options,
                                          Control* control) {
    const auto bounds = [](auto& search, double square) {
        const double high = search.value(square);
        const bool is_exact = high < std::numeric_limits<double>::infinity() &&
                              !search.is_within(high, continuous::FreeSet::open);
        return Interval{is_exact ? high : continuous::next_below(high), high};
    };
    return with_pair(P, Q, options, control, [&](const auto& pair, auto dim, Poller& poller) {
        return with_quick_search<dim>(P, Q, pair, poller, bounds);
    });
}

Matching closed_frechet_continuous_path(const CurveView& P, const CurveView& Q,
                                        const FrechetContinuousOptions& options, Control* control) {
    const auto value = [](auto& search, double square) { return search.value(square); };
    return with_pair(P, Q, options, control, [&](const auto& pair, auto dim, Poller& poller) {
        const double distance = with_quick_search<dim>(P, Q, pair, poller, value);
        const double* const begin = pair.p.boxed().template point<dim>(0);
        const std::ptrdiff_t nearest = extremes<dim>(pair.q.boxed(), begin).nearest;
        return with_search_from<dim>(P, 0, Q, 0, pair.range, poller, [&](auto& search) {
            auto [longest, parameters] = search.matching(distance, nearest);
            return Matching{longest, std::move(parameters)};
        });
    });
}

}  // namespace curvewise
