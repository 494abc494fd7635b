#include "curves/owned_curve.hpp"

namespace curvewise::curves {

OwnedCurve::OwnedCurve(const CurveView& curve, runtime::Poller& poller)
    : is_flat_(curve.is_flat()), dim_(curve.dim()) {
    points_.reserve(static_cast<std::size_t>(curve.size() * dim_));
    poller.in_runs(curve.size(), dim_, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = first; i < end; ++i) {
            for (std::ptrdiff_t c = 0; c < dim_; ++c) points_.push_back(curve(i, c));
        }
    });
}

CurveView OwnedCurve::view() const noexcept {
    const auto n = static_cast<std::ptrdiff_t>(points_.size()) / dim_;
    return is_flat_ ? CurveView(points_.data(), n, 1, 1, 0) : CurveView(points_.data(), n, dim_);
}

}  // namespace curvewise::curves
