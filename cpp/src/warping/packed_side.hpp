// One side of a pair as measures over tables prepare it (pairwise/measure.hpp): checked and packed,
// without scaling, which curves within the usual range do not need.
#pragma once

#include "curves/checks.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

template <PointOrder order>
struct PackedSide {
    PackedSide(const curves::CheckedCurve& curve, Poller& poller)
        : checked(curve),
          packed(PackedCurve::of(curve.curve, curve.on_sphere, RangeScale(1.0), order, poller)) {}
    // See pairwise/measure.hpp.
    bool holds_points() const noexcept { return !checked.on_sphere; }
    void look_at_own_points() noexcept { checked.curve = packed.points(order, checked.curve); }

    curves::CheckedCurve checked;
    PackedCurve packed;
};

}  // namespace curvewise::warping
