// soft_dtw and its gradients: curves checked and packed, the table swept (soft_sweep.hpp).
#include "curvewise/soft_dtw.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "curves/checks.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/gradient.hpp"
#include "pairwise/evaluate.hpp"
#include "runtime/scratch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/soft_sweep.hpp"
#include "warping/warping_problem.hpp"

namespace curvewise {
namespace {

using curves::CheckedCurve;
using curves::RangeScale;
using runtime::Poller;
using warping::Band;
using warping::PackedCurve;
using warping::PointOrder;
using warping::SoftSweep;
using warping::WarpingOptions;

// The window, checked as for dtw, and gamma.
WarpingOptions checked_options(const SoftDtwOptions& options) {
    if (!(options.gamma > 0.0 && std::isfinite(options.gamma))) {
        std::ostringstream message;  // std::to_string writes 1e-9 as 0.000000
        message << "gamma is " << options.gamma << "; " << gamma_range.advice;
        throw std::invalid_argument(message.str());
    }
    DtwOptions like;
    like.ground.metric = Metric::sqeuclidean;
    like.window = options.window;
    like.window_fraction = options.window_fraction;
    WarpingOptions checked = warping::checked_options(like);
    checked.measure = SoftDtwOptions::measure;
    return checked;
}

class SoftDtwMeasure : public pairwise::SweptMeasure {
   public:
    struct Memory {};
    using PreparedP = pairwise::UnpreparedCurve;
    using PreparedQ = pairwise::UnpreparedCurve;

    explicit SoftDtwMeasure(const SoftDtwOptions& options)
        : options_(checked_options(options)), gamma_(options.gamma) {}
    curves::Requirements requirements() const noexcept { return {options_.measure, 1, false}; }
    void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const {
        options_.window.check_sizes(n, m);
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        return with_sweep(
            P.checked, Q.checked, call.poller,
            [](SoftSweep& sweep, const RangeScale& /*range*/) { return sweep.log_of_total(); });
    }

    double with_gradients(const CheckedCurve& P, const CheckedCurve& Q, const Gradients& out,
                          Poller& poller) const {
        return with_sweep(P, Q, poller, [&](SoftSweep& sweep, const RangeScale& range) {
            const std::ptrdiff_t dim = P.curve.dim();
            PackedGradient of_p(P.curve.size(), dim), of_q(Q.curve.size(), dim);
            const double result = sweep.log_of_total(of_p.data(), of_q.data());
            of_p.unpack(range, PointOrder::forward, out.by_p);
            of_q.unpack(range, PointOrder::reversed, out.by_q);
            return result;
        });
    }

   private:
    // One entry for each coordinate of a packed curve, in its place.
    class PackedGradient {
       public:
        PackedGradient(std::ptrdiff_t n, std::ptrdiff_t dim)
            : n_(n),
              dim_(dim),
              stride_(runtime::AlignedBuffer::rounded(n + kernels::padding)),
              entries_(static_cast<std::size_t>(dim * stride_)) {}
        double* data() noexcept { return entries_.data(); }
        void unpack(const RangeScale& range, PointOrder order, double* out) const noexcept {
            if (out == nullptr) return;
            for (std::ptrdiff_t i = 0; i < n_; ++i) {
                const std::ptrdiff_t place = order == PointOrder::reversed ? n_ - 1 - i : i;
                for (std::ptrdiff_t c = 0; c < dim_; ++c) {
                    const double entry = entries_[static_cast<std::size_t>(c * stride_ + place)];
                    out[i * dim_ + c] = range.restore(entry, 1);
                }
            }
        }

       private:
        std::ptrdiff_t n_, dim_, stride_;
        runtime::ScratchVector<double> entries_;
    };

    // Calls use(sweep, range), and returns -gamma times its result. If gamma is smaller than 2^-900
    // of the largest possible squared distance, only the cheapest path counts. Then a gamma of that
    // size, whose powers do not overflow, gives the same value to rounding.
    template <class Use>
    double with_sweep(const CheckedCurve& P, const CheckedCurve& Q, Poller& poller, Use use) const {
        const std::ptrdiff_t n = P.curve.size(), m = Q.curve.size();
        const double largest = std::max(P.largest, Q.largest);
        const RangeScale range = gamma_ < 0x1p-1000 ? RangeScale::to_unity(largest)
                                                    : warping::range_of(options_.ground, largest);
        // R / gamma does not depend on the unit of the coordinates.
        const double given = range.restore(gamma_, -2), side = 2.0 * range.shrink(largest);
        const double least = 0x1p-900 * side * side * static_cast<double>(P.curve.dim());
        const bool is_given = given >= least;
        const double gamma = is_given ? gamma_ : range.restore(least, 2);
        const double per_square = largest == 0.0 ? 1.0 : log2_of_e / (is_given ? given : least);
        const PackedCurve p(P.curve, range, PointOrder::forward, poller);
        const PackedCurve q(Q.curve, range, PointOrder::reversed, poller);
        SoftSweep sweep({p, q}, Band(n, m, options_.window.between(n, m)), per_square, poller);
        return -gamma * use(sweep, range);
    }

    static constexpr double log2_of_e = 1.44269504088896340736;
    WarpingOptions options_;
    double gamma_;
};

}  // namespace

double soft_dtw(const CurveView& P, const CurveView& Q, const SoftDtwOptions& options,
                Control* control) {
    return pairwise::evaluate(SoftDtwMeasure(options), P, Q, control);
}

double value_and_gradients(const SoftDtwOptions& options, const CurveView& P, const CurveView& Q,
                           const Gradients& out, Control* control) {
    const SoftDtwMeasure measure(options);
    return pairwise::with_pair(
        measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
            return measure.with_gradients(p.checked, q.checked, out, call.poller);
        });
}

}  // namespace curvewise
