#include "warping/packed_curve.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "curves/sphere.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {
namespace {

// The bits of 2 |x|, less one: in the order of |x|, with 0 behind all others.
std::uint64_t rank(double x) noexcept {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    return 2 * bits - 1;
}

// Writes count numbers, the first at `to`, the next `step` further; returns the smallest rank.
template <class Value>
std::uint64_t write(std::ptrdiff_t count, double* to, std::ptrdiff_t step, Value value) noexcept {
    std::uint64_t least = rank(0.0);
    for (std::ptrdiff_t i = 0; i < count; ++i, to += step) {
        const double x = value(i);
        least = std::min(least, rank(x));
        *to = x;
    }
    return least;
}

}  // namespace

PackedCurve::PackedCurve(const CurveView& curve, const RangeScale& range, PointOrder order,
                         Poller& poller)
    : n_(curve.size()),
      dim_(curve.dim()),
      stride_(AlignedBuffer::rounded(n_ + kernels::padding)),
      storage_(dim_ * stride_),
      data_(storage_.data()) {
    const double* const row_major = range.is_identity() ? curve.row_major() : nullptr;
    const std::ptrdiff_t step = order == PointOrder::reversed ? -1 : 1;
    std::uint64_t least = rank(0.0);
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        double* const begin = storage_.data() + c * stride_;
        poller.in_runs(n_, 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
            double* const to = begin + (step > 0 ? first : n_ - 1 - first);
            const auto strided = [&](std::ptrdiff_t i) {
                return range.shrink(curve(first + i, c));
            };
            const auto plain = [from = row_major, offset = first * dim_ + c,
                                dim = dim_](std::ptrdiff_t i) { return from[offset + i * dim]; };
            least = std::min(least, row_major != nullptr ? write(end - first, to, step, plain)
                                                         : write(end - first, to, step, strided));
        });
        std::fill_n(begin + n_, kernels::padding, 0.0);
    }
    squares_are_in_domain_ = least >= rank(0x1p-400);
}

PackedCurve::PackedCurve(const CurveView& curve, PointOrder order, Poller& poller)
    : n_(curve.size()),
      dim_(curves::sphere_dim),
      stride_(AlignedBuffer::rounded(n_ + kernels::padding)),
      storage_(dim_ * stride_),
      data_(storage_.data()) {
    std::uint64_t least = rank(0.0);
    poller.in_runs(n_, dim_, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = first; i < end; ++i) {
            const auto point = curves::on_sphere(curve(i, 0), curve(i, 1));
            double* to = storage_.data() + (order == PointOrder::reversed ? n_ - 1 - i : i);
            for (const double x : point) {
                least = std::min(least, rank(x));
                *to = x;
                to += stride_;
            }
        }
    });
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        std::fill_n(storage_.data() + c * stride_ + n_, kernels::padding, 0.0);
    }
    squares_are_in_domain_ = least >= rank(0x1p-400);
}

}  // namespace curvewise::warping
