// The Hausdorff distance between polygonal curves as a measure: curves boxed once, the search
// called for their number of coordinates.
#include "curvewise/hausdorff_continuous.hpp"

#include <algorithm>
#include <cstdint>

#include "continuous/boxed_side.hpp"
#include "continuous/farthest_point.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"

namespace curvewise {
namespace {

using continuous::BoxedCurve;
using continuous::FarthestPointSearch;
using continuous::FoundPoint;
using curves::RangeScale;

class HausdorffContinuousMeasure : public pairwise::Distance {
   public:
    struct Memory {};
    static constexpr bool is_swept = false;
    using PreparedP = continuous::BoxedSide;
    using PreparedQ = PreparedP;
    using Call = pairwise::Call<Memory>;

    explicit HausdorffContinuousMeasure(const HausdorffContinuousOptions& options)
        : options_(options) {}
    static curves::Requirements requirements() noexcept {
        return {HausdorffContinuousOptions::measure, 1, false};
    }
    static void check_sizes(std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/) noexcept {}
    static std::ptrdiff_t workers() noexcept { return 1; }
    static std::int64_t steps(std::int64_t n, std::int64_t count, std::int64_t points) noexcept {
        return n * count + points;
    }

    double operator()(const PreparedP& P, const PreparedQ& Q, const Call& call) const {
        return points(P, Q, call).distance;
    }

    // Where the cutoff ends the search early, some distance above it.
    HausdorffPoints points(const PreparedP& P, const PreparedQ& Q, const Call& call) const {
        const double largest = std::max(P.checked.largest, Q.checked.largest);
        const RangeScale range(largest);
        if (range.is_identity()) return scaled_points(P, Q, P.boxed, Q.boxed, range, call);
        const BoxedCurve p(P.checked.curve, range, call.poller);
        const BoxedCurve q(Q.checked.curve, range, call.poller);
        return scaled_points(P, Q, p, q, range, call);
    }

   private:
    HausdorffPoints scaled_points(const PreparedP& P, const PreparedQ& Q, const BoxedCurve& p,
                                  const BoxedCurve& q, const RangeScale& range,
                                  const Call& call) const {
        const double largest = range.shrink(std::max(P.checked.largest, Q.checked.largest));
        const double enough = range.shrink(call.cutoff);
        const auto from = [&](const PreparedP& one, const BoxedCurve& points,
                              const PreparedP& other, const BoxedCurve& edges) {
            const FoundPoint found = farthest(points, edges, largest, enough, call.poller);
            return FarthestPoint{range.restore(found.distance, 1),
                                 parameter(found.edge, found.at, one.checked.curve),
                                 parameter(found.nearest, found.nearest_at, other.checked.curve)};
        };
        HausdorffPoints found;
        found.from_p = from(P, p, Q, q);
        found.distance = found.from_p.distance;
        if (options_.directed || found.distance > call.cutoff) return found;
        found.from_q = from(Q, q, P, p);
        found.distance = std::max(found.distance, found.from_q.distance);
        return found;
    }

    // A single point is an edge of no length.
    static double parameter(std::ptrdiff_t edge, double at, const CurveView& curve) noexcept {
        return std::min(static_cast<double>(edge) + at, static_cast<double>(curve.size() - 1));
    }

    static FoundPoint farthest(const BoxedCurve& from, const BoxedCurve& to, double largest,
                               double enough, runtime::Poller& poller) {
        switch (from.dim()) {
            case 1:
                return FarthestPointSearch<1>(from, to, largest, poller).found(enough);
            case 2:
                return FarthestPointSearch<2>(from, to, largest, poller).found(enough);
            case 3:
                return FarthestPointSearch<3>(from, to, largest, poller).found(enough);
            default:
                return FarthestPointSearch<0>(from, to, largest, poller).found(enough);
        }
    }

    HausdorffContinuousOptions options_;
};

}  // namespace

double hausdorff_continuous(const CurveView& P, const CurveView& Q,
                            const HausdorffContinuousOptions& options, Control* control) {
    return pairwise::evaluate(HausdorffContinuousMeasure(options), P, Q, control);
}

HausdorffPoints hausdorff_continuous_points(const CurveView& P, const CurveView& Q,
                                            const HausdorffContinuousOptions& options,
                                            Control* control) {
    const HausdorffContinuousMeasure measure(options);
    return pairwise::with_pair(
        measure, P, Q, control,
        [&](const auto& p, const auto& q, const auto& call) { return measure.points(p, q, call); });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(
    const HausdorffContinuousOptions& options) {
    return std::make_unique<BatchOf<HausdorffContinuousMeasure>>(
        HausdorffContinuousMeasure(options));
}

}  // namespace curvewise
