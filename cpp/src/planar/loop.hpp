// A closed curve as open ones that begin and end at one of its points, for areas of closed curves.
#pragma once

#include <cstddef>

#include "curves/checks.hpp"
#include "curves/polyline.hpp"
#include "runtime/poller.hpp"

namespace curvewise::planar {

// A copy of the points, twice around. A last point that equals the first one is left out.
class Loop {
   public:
    // Throws Stopped where the poller says so.
    Loop(const curves::CheckedCurve& checked, runtime::Poller& poller);
    // The number of points.
    std::ptrdiff_t size() const noexcept { return size_; }
    // From point i around to it again. Refers to this loop.
    curves::CheckedCurve from(std::ptrdiff_t i) const noexcept {
        return {CurveView(&points_[static_cast<std::size_t>(i)].x, size_ + 1, 2), largest_, false};
    }

   private:
    std::ptrdiff_t size_;
    double largest_;
    curves::Polyline points_;
};

}  // namespace curvewise::planar
