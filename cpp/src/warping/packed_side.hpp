// One side of a pair as measures over tables prepare it (pairwise/measure.hpp): checked and packed,
// without scaling, which curves within the usual range do not need.
#pragma once

#include <cstddef>

#include "curves/checks.hpp"
#include "pairwise/stored_curve.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

template <PointOrder order>
struct PackedSide {
    PackedSide(const curves::CheckedCurve& curve, Poller& poller)
        : checked(curve),
          packed(PackedCurve::of(curve.curve, curve.on_sphere, RangeScale(1.0), order, poller)) {}
    // Of stored points, which are not on the sphere.
    static constexpr pairwise::PointLayout layout = order == PointOrder::forward
                                                        ? pairwise::PointLayout::columns
                                                        : pairwise::PointLayout::reversed_columns;
    PackedSide(const pairwise::StoredCurve& stored, std::ptrdiff_t dim) noexcept
        : checked(stored.view(dim, layout), stored.largest, false), packed(stored, dim) {}

    curves::CheckedCurve checked;
    PackedCurve packed;
};

}  // namespace curvewise::warping
