#include "curves/owned_curve.hpp"

#include <utility>

namespace curvewise::curves {

OwnedCurve::OwnedCurve(const CurveView& curve, runtime::Poller& poller)
    : is_flat_(curve.is_flat()),
      dim_(curve.dim()),
      points_(static_cast<std::size_t>(curve.size() * dim_)) {
    const auto copy = [&](auto value) {
        poller.in_runs(curve.size(), dim_, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
            double* to = points_.data() + first * dim_;
            for (std::ptrdiff_t i = first; i < end; ++i) {
                for (std::ptrdiff_t c = 0; c < dim_; ++c) *to++ = value(i, c);
            }
        });
    };
    if (curve.has_floats()) {
        copy([&](std::ptrdiff_t i, std::ptrdiff_t c) { return double{curve.float_at(i, c)}; });
    } else {
        copy(curve);
    }
}

CurveView OwnedCurve::view() const noexcept {
    const auto n = static_cast<std::ptrdiff_t>(points_.size()) / dim_;
    return is_flat_ ? CurveView(points_.data(), n, 1, 1, 0) : CurveView(points_.data(), n, dim_);
}

CheckedCurve checked_listed(const CurveView& curve, std::string name, runtime::Poller& poller,
                            bool on_sphere) {
    const CurveInDoubles doubles(curve, poller);
    CheckedCurve checked(doubles.view(), std::move(name), poller, on_sphere);
    checked.curve = curve;
    return checked;
}

}  // namespace curvewise::curves
