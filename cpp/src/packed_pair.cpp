#include "packed_pair.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/strip.hpp"

namespace curvewise::detail {
namespace {

// Point i of coordinate c goes to to[i], or to[n - 1 - i] in reverse. Returns whether none of
// them is too close to 0, but not 0, for the fast square root.
bool pack(const CurveView& curve, std::ptrdiff_t c, bool reverse, const RangeScale& range,
          double* to) {
    const std::ptrdiff_t n = curve.size();
    bool in_domain = true;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const double x = range.shrink(curve(i, c));
        in_domain &= std::abs(x) >= 0x1p-400 || x == 0.0;
        to[reverse ? n - 1 - i : i] = x;
    }
    std::fill_n(to + n, kernels::padding, 0.0);
    return in_domain;
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
        squares_are_in_domain_ &= pack(P, c, false, range, storage_.data() + c * p_stride_);
        squares_are_in_domain_ &=
            pack(Q, c, true, range, storage_.data() + dim_ * p_stride_ + c * q_stride_);
    }
}

}  // namespace curvewise::detail
