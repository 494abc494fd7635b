// One side of a pair as measures of polygonal curves prepare it (pairwise/measure.hpp): checked and
// boxed, without scaling, which curves within the usual range do not need.
#pragma once

#include "continuous/boxed_curve.hpp"
#include "curves/checks.hpp"

namespace curvewise::continuous {

struct BoxedSide {
    BoxedSide(const curves::CheckedCurve& curve, Poller& poller)
        : checked(curve), boxed(curve.curve, RangeScale(1.0), poller) {}
    static bool holds_points() noexcept { return true; }
    void look_at_own_points() noexcept {
        const CurveView& given = checked.curve;
        const double* const points = boxed.point<0>(0);
        checked.curve = given.is_flat() ? CurveView(points, given.size(), 1, 1, 0)
                                        : CurveView(points, given.size(), given.dim());
    }
    curves::CheckedCurve checked;
    BoxedCurve boxed;
};

}  // namespace curvewise::continuous
