// One side of a pair as measures of polygonal curves prepare it (pairwise/measure.hpp): checked and
// boxed, without scaling, which curves within the usual range do not need.
#pragma once

#include "continuous/boxed_curve.hpp"
#include "curves/checks.hpp"
#include "pairwise/measure.hpp"

namespace curvewise::continuous {

struct BoxedSide {
    BoxedSide(const curves::CheckedCurve& curve, Poller& poller)
        : checked(curve), boxed(curve.curve, RangeScale(1.0), poller) {}
    BoxedSide(const curves::CheckedCurve& curve, Poller& poller, pairwise::PointsStay /*tag*/)
        : checked(curve), boxed(curve.curve.row_major(), curve.curve, poller) {}
    curves::CheckedCurve checked;
    BoxedCurve boxed;
};

}  // namespace curvewise::continuous
