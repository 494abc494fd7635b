// hausdorff: the distances of all pairs of points, one point of Q after another against a SIMD
// vector of P's. The least distances of every row and of every column are kept. Nothing can be
// skipped: all distances of a point must be known before it is clear that the point does not
// decide. O(n m) time, O(n + m) memory.
#include "curvewise/hausdorff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "runtime/scratch.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/packed_side.hpp"

namespace curvewise {
namespace {

using curves::RangeScale;
using runtime::Poller;
using warping::PackedCurve;
using warping::PointOrder;

constexpr double infinity = std::numeric_limits<double>::infinity();

class HausdorffMeasure : public pairwise::SweptMeasure {
   public:
    struct Memory {
        runtime::ScratchVector<double> point, distances, nearest;
    };
    using PreparedP = warping::PackedSide<PointOrder::forward>;
    using PreparedQ = PreparedP;

    explicit HausdorffMeasure(const HausdorffOptions& options) : options_(options) {
        warping::check_ground_distance(options_.ground);
        warping::refuse_own_distances(options_.ground);
        curves::check_limit("cutoff", options_.cutoff, false);
    }
    curves::Requirements requirements() const noexcept {
        return warping::requirements(HausdorffOptions::measure, options_.ground);
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        const RangeScale range =
            warping::range_of(options_.ground, std::max(P.checked.largest, Q.checked.largest));
        double found = 0.0;
        if (range.is_identity()) {
            found = between({P.packed, Q.packed}, call);
        } else {
            const PackedCurve p(P.checked.curve, range, PointOrder::forward, call.poller);
            const PackedCurve q(Q.checked.curve, range, PointOrder::forward, call.poller);
            found = range.restore(between({p, q}, call), warping::degree(options_.ground.metric));
        }
        return found > options_.cutoff ? infinity : found;
    }

   private:
    double between(const warping::PackedPair& curves, const pairwise::Call<Memory>& call) const {
        const std::ptrdiff_t n = curves.rows(), m = curves.columns(), dim = curves.dim();
        const auto room = static_cast<std::size_t>(n + kernels::padding);
        Memory& memory = call.memory;
        memory.distances.resize(room);
        memory.nearest.assign(room, infinity);
        kernels::Cost cost = warping::canonical_cost(options_.ground, curves);
        const warping::PutOffRoot root = warping::put_off_root(cost, options_.ground);
        const kernels::CostFunction fill = warping::active_level().kernels->fill(cost);
        kernels::Strip strip{};
        strip.p = curves.p.data();
        strip.p_stride = curves.p.stride();
        strip.q_stride = n + kernels::padding;
        strip.columns = 1;
        strip.dim = dim;
        strip.metric_parameter = options_.ground.parameter();
        strip.cost = memory.distances.data();
        memory.point.resize(static_cast<std::size_t>(dim * strip.q_stride));
        strip.q = memory.point.data();
        double* const nearest = memory.nearest.data();
        double farthest = 0.0;
        for (std::ptrdiff_t j = 0; j < m; ++j) {
            for (std::ptrdiff_t c = 0; c < dim; ++c) {
                std::fill_n(memory.point.data() + c * strip.q_stride, strip.q_stride,
                            curves.q.data()[c * curves.q.stride() + j]);
            }
            fill(strip, 0, 0, n - 1);
            double least = infinity;
            for (std::ptrdiff_t i = 0; i < n; ++i) {
                nearest[i] = std::min(nearest[i], strip.cost[i]);
                least = std::min(least, strip.cost[i]);
            }
            farthest = std::max(farthest, least);
            if (call.poller.count_steps(n, dim)) throw Stopped();
        }
        for (std::ptrdiff_t i = 0; i < n; ++i) farthest = std::max(farthest, nearest[i]);
        return root(farthest);
    }

    HausdorffOptions options_;
};

}  // namespace

double hausdorff(const CurveView& P, const CurveView& Q, const HausdorffOptions& options,
                 Control* control) {
    return pairwise::evaluate(HausdorffMeasure(options), P, Q, control);
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(
    const HausdorffOptions& options) {
    return std::make_unique<BatchOf<HausdorffMeasure>>(HausdorffMeasure(options));
}

}  // namespace curvewise
