// A curve with points of its own, row by row: a copy, for what outlives the caller's. Flat where
// the caller's is, for messages. O(n) time.
#pragma once

#include <cstddef>
#include <vector>

#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"

namespace curvewise::curves {

class OwnedCurve {
   public:
    // Throws Stopped where the poller says so.
    OwnedCurve(const CurveView& curve, runtime::Poller& poller);
    // Valid where this is moved to, too.
    CurveView view() const noexcept;

   private:
    bool is_flat_;
    std::ptrdiff_t dim_;
    std::vector<double> points_;
};

}  // namespace curvewise::curves
