#include "warping/packed_curve.hpp"

#include <algorithm>
#include <cmath>

#include "warping/kernels/strip.hpp"

namespace curvewise::warping {

PackedCurve::PackedCurve(const CurveView& curve, const RangeScale& range, PointOrder order,
                         Poller& poller)
    : n_(curve.size()),
      dim_(curve.dim()),
      stride_(AlignedBuffer::rounded(n_ + kernels::padding)),
      storage_(dim_ * stride_) {
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        double* const to = storage_.data() + c * stride_;
        poller.in_runs(n_, 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
            for (std::ptrdiff_t i = first; i < end; ++i) {
                const double x = range.shrink(curve(i, c));
                squares_are_in_domain_ &= std::abs(x) >= 0x1p-400 || x == 0.0;
                to[order == PointOrder::reversed ? n_ - 1 - i : i] = x;
            }
        });
        std::fill_n(to + n_, kernels::padding, 0.0);
    }
}

}  // namespace curvewise::warping
