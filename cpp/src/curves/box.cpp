#include "curves/box.hpp"

#include <algorithm>
#include <cmath>

namespace curvewise::curves {

BoxSide::BoxSide(const CurveView& curve, std::ptrdiff_t coordinate) noexcept
    : range_(0.0), low_(curve(0, coordinate)) {
    double low = low_, high = low_;  // in registers, in the loop
    const double* const row_major = curve.row_major();
    const std::ptrdiff_t size = curve.size(), dim = curve.dim();
    if (row_major != nullptr) {
        for (std::ptrdiff_t i = coordinate; i < size * dim; i += dim) {
            low = std::min(row_major[i], low);
            high = std::max(row_major[i], high);
        }
    } else {
        for (std::ptrdiff_t i = 1; i < size; ++i) {
            low = std::min(low, curve(i, coordinate));
            high = std::max(high, curve(i, coordinate));
        }
    }
    low_ = low;
    has_extent_ = high > low_;
    if (!has_extent_) return;
    range_ = RangeScale(std::max(std::abs(low_), std::abs(high)));
    low_ = range_.shrink(low_);
    extent_ = range_.shrink(high) - low_;
}

}  // namespace curvewise::curves
