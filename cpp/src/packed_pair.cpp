#include "packed_pair.hpp"

#include <algorithm>

#include "kernels/strip.hpp"

namespace curvewise::detail {
namespace {

// Point i of coordinate c goes to to[i], or to[n - 1 - i] in reverse.
void pack(const CurveView& curve, std::ptrdiff_t c, bool reverse, const RangeScale& range,
          double* to) {
    const std::ptrdiff_t n = curve.size();
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        to[reverse ? n - 1 - i : i] = range.shrink(curve(i, c));
    }
    std::fill_n(to + n, kernels::padding, 0.0);
}

}  // namespace

PackedPair::PackedPair(const CurveView& P, const CurveView& Q, const RangeScale& range)
    : n_(P.size()),
      m_(Q.size()),
      dim_(P.dim()),
      p_stride_(AlignedBuffer::rounded(n_ + kernels::padding)),
      q_stride_(AlignedBuffer::rounded(m_ + kernels::padding)),
      storage_(dim_ * (p_stride_ + q_stride_)) {
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        pack(P, c, false, range, storage_.data() + c * p_stride_);
        pack(Q, c, true, range, storage_.data() + dim_ * p_stride_ + c * q_stride_);
    }
}

}  // namespace curvewise::detail
