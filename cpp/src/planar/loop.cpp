#include "planar/loop.hpp"

namespace curvewise::planar {

Loop::Loop(const curves::CheckedCurve& checked, runtime::Poller& poller)
    : size_(checked.curve.size()),
      largest_(checked.largest),
      points_(polyline(checked.curve, curves::RangeScale(1.0), poller)) {
    const curves::Point first = points_.front(), last = points_.back();
    if (size_ > 1 && first.x == last.x && first.y == last.y) {
        points_.pop_back();
        --size_;
    }
    points_.reserve(2 * points_.size());
    for (std::ptrdiff_t i = 0; i < size_; ++i) {
        points_.push_back(points_[static_cast<std::size_t>(i)]);
    }
}

}  // namespace curvewise::planar
