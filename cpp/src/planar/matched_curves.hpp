// Two curves matched by a warping path, and cut into pieces: the basis of Spacing::matched.
//
// A simulation has other increments than the test, and a test has noise. Refinement compares
// corresponding points only if both curves were sampled in the same way. Arc length does so only if
// neither has noise, because noise adds length. Here both curves are resampled at equal shares of
// their own arc lengths, and the warping path of dynamic time warping finds the corresponding
// samples.
//
// Coordinates are scaled by P's box. The path is dtw's, with the ground distance |dx| + |dy|, on
// coordinates rounded to 30 bits. So no rounding error decides between two paths of the same cost.
// The path is cut into pieces of a tenth of the box, short but long compared with the spacing of
// noisy points. Areas within a piece are added with their signs, so that noise cancels. One walk
// along both curves adds up the areas of the pieces.
//
// Time O(n + m + k^2), memory O(n + m + k). k = 50 T samples are matched, and T is the number of
// widths and heights of its box that P travels. If T is above 280, only samples whose places differ
// by at most 1e8 / k are matched: O(n + m + k) then.
#pragma once

#include <array>
#include <cstddef>

#include "curves/polyline.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"
#include "planar/quad.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::planar {

using curves::Polyline;
using runtime::Poller;

// Two curves with as many vertices each, and the vertices at which their pieces end: the last one
// is the curves' last.
struct MatchedCurves {
    Polyline A;
    Polyline B;
    runtime::ScratchVector<std::size_t> ends;
};

// The places of the vertices of MatchedCurves::A on P, or of those of B on Q, for derivatives.
struct PlacesOnCurve {
    struct Place {
        bool is_vertex;  // of the curve itself, that at the beginning of the segment
        std::size_t segment;
        double fraction;
        double share;  // of the curve's length, before it
    };
    runtime::ScratchVector<Place> places;
    Polyline scaled;  // the curve, as its length is measured
};

struct PlacesOnCurves {
    PlacesOnCurve p;
    PlacesOnCurve q;
    std::array<double, 2> slopes;     // of the scaling
    std::array<bool, 2> is_box_of_p;  // that it is by, or else of Q
};

// The areas between the curves, with their signs, piece by piece: of the quadrilaterals between the
// segments of MatchedCurves, added up in their order. Throws Stopped where the poller says so.
runtime::ScratchVector<double> matched_areas(const CurveView& P, const CurveView& Q,
                                             const curves::RangeScale& range, Poller& poller);

// P and Q with a vertex at every vertex of the other, and at every end of a piece. Coordinates come
// out in `range`. Throws Stopped where the poller says so. `on_curves`, if given, is filled in.
MatchedCurves match(const CurveView& P, const CurveView& Q, const curves::RangeScale& range,
                    Poller& poller, PlacesOnCurves* on_curves = nullptr);

// Calls visit(curves, first, end, area) for each piece of the matched curves in order. Its
// quadrilaterals are those from `first` to before `end`; `area` is the sum of their signed
// areas.
template <class Visit>
void for_each_piece(const planar::MatchedCurves& curves, runtime::Poller& poller, Visit visit) {
    std::size_t first = 0;
    for (const std::size_t end : curves.ends) {
        double area = 0.0;
        for (std::size_t i = first; i < end; ++i) {
            poller.poll_in_loop(i);
            area += quad_at(curves, i).signed_area();
        }
        visit(curves, first, end, area);
        first = end;
    }
}

}  // namespace curvewise::planar
