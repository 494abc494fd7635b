#include "curves/box.hpp"

#include <algorithm>
#include <cmath>

namespace curvewise::curves {

BoxSide::BoxSide(const CurveView& curve, std::ptrdiff_t coordinate) noexcept
    : range_(0.0), low_(curve(0, coordinate)) {
    double high = low_;
    for (std::ptrdiff_t i = 1; i < curve.size(); ++i) {
        low_ = std::min(low_, curve(i, coordinate));
        high = std::max(high, curve(i, coordinate));
    }
    has_extent_ = high > low_;
    if (!has_extent_) return;
    range_ = RangeScale(std::max(std::abs(low_), std::abs(high)));
    low_ = range_.shrink(low_);
    extent_ = range_.shrink(high) - low_;
}

}  // namespace curvewise::curves
