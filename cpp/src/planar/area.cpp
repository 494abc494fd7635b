// Algorithm 1 of Jekel et al. (2018): refinement, then the areas of the quadrilaterals between
// the curves. Areas are half the cross product of the diagonals, Gauss's formula without its
// cancellation. With Spacing::matched the curves are matched by a warping path instead
// (matching.hpp), and areas have signs, which cancel within a piece.
#include "curvewise/area.hpp"

#include <algorithm>
#include <cmath>

#include "curves/polyline.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "planar/matching.hpp"
#include "planar/refinement.hpp"

namespace curvewise {
namespace {

using detail::cross;
using detail::Point;
using detail::RangeScale;

struct Quad {
    Point a, b, c, d;

    // By the signs of the cross products of consecutive edges (the paper's Eq. 6, where CD is
    // misprinted): two of each in a quadrilateral that intersects itself.
    bool is_simple() const noexcept {
        const Point ab = b - a, bc = c - b, cd = d - c, da = a - d;
        const double turns[] = {cross(ab, bc), cross(bc, cd), cross(cd, da), cross(da, ab)};
        int left = 0;
        int right = 0;
        for (const double turn : turns) {
            left += turn >= 0.0;
            right += turn <= 0.0;
        }
        return left >= 3 || right >= 3;
    }

    // Positive if the corners turn left.
    double signed_area() const noexcept { return 0.5 * cross(c - a, d - b); }
    double area() const noexcept { return std::abs(signed_area()); }

    // For a complex quadrilateral: its first two vertices swapped, or its second and third.
    Quad rearranged() const noexcept {
        const Quad swapped{b, a, c, d};
        return swapped.is_simple() ? swapped : Quad{a, c, b, d};
    }

    // Where AB crosses CD: the areas of the two triangles at the crossing point, which divides
    // CD as |ABC| : |ABD|. Negative where they do not cross.
    double split_area() const noexcept {
        const double abc = cross(b - a, c - a), abd = cross(b - a, d - a);
        const double cda = cross(d - c, a - c), cdb = cross(d - c, b - c);
        if (!opposite(abc, abd) || !opposite(cda, cdb)) return -1.0;
        const double sum = std::abs(abc) + std::abs(abd);
        return 0.5 * (std::abs(abc) / sum * std::abs(cdb) + std::abs(abd) / sum * std::abs(cda));
    }

   private:
    static bool opposite(double s, double t) noexcept {
        return (s <= 0.0 && t >= 0.0 && s != t) || (s >= 0.0 && t <= 0.0 && s != t);
    }
};

// The quadrilateral as its area is taken, and that area.
struct Measured {
    Quad quad;
    double area;
};

Measured measure(const Quad& quad, Crossing crossing) noexcept {
    if (quad.is_simple()) return {quad, quad.area()};
    if (crossing == Crossing::split) {
        const double area = quad.split_area();
        if (area >= 0.0) return {quad, area};
        const double other = Quad{quad.b, quad.c, quad.d, quad.a}.split_area();
        if (other >= 0.0) return {quad, other};
    }
    const Quad simple = quad.rearranged();
    return {simple, simple.area()};
}

// Of FacingCurves or of a Matching.
template <class Curves>
Quad quad_at(const Curves& curves, std::size_t i) noexcept {
    return {curves.A[i], curves.A[i + 1], curves.B[i + 1], curves.B[i]};
}

class AreaMeasure : public detail::LinearMeasure {
   public:
    using PreparedP = detail::UnpreparedCurve;
    using PreparedQ = detail::UnpreparedCurve;

    explicit AreaMeasure(const AreaOptions& options) : options_(options) {}
    static detail::Requirements requirements() noexcept { return {AreaOptions::measure, 2, true}; }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const detail::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        double sum = 0.0;
        const auto add = [&](double area) { sum += options_.squared ? area * area : area; };
        if (options_.spacing == Spacing::matched) {
            for_each_piece(P, Q, range, call.poller,
                           [&](const auto&, auto, auto, double area) { add(std::abs(area)); });
        } else {
            for_each_quad(P, Q, range, call.poller, [&](const Measured& quad) { add(quad.area); });
        }
        return range.restore(sum, options_.squared ? 4 : 2);
    }

    // The quadrilaterals and their areas.
    AreaQuads quads(const PreparedP& P, const PreparedQ& Q,
                    const detail::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        const auto restored = [&](const Point& point) -> std::array<double, 2> {
            return {range.restore(point.x, 1), range.restore(point.y, 1)};
        };
        AreaQuads result;
        // So that nothing is copied to make room, which takes long where there are millions.
        const auto most = static_cast<std::size_t>(P.checked.curve.size() + Q.checked.curve.size());
        result.quads.reserve(most);
        result.areas.reserve(most);
        const auto add = [&](const Measured& measured) {
            const Quad& quad = measured.quad;
            result.quads.push_back(
                {restored(quad.a), restored(quad.b), restored(quad.c), restored(quad.d)});
            result.areas.push_back(range.restore(measured.area, 2));
        };
        if (options_.spacing == Spacing::matched) {
            for_each_piece(P, Q, range, call.poller,
                           [&](const auto& curves, auto first, auto end, double area) {
                               for (std::size_t i = first; i < end; ++i) {
                                   const Quad quad = quad_at(curves, i);
                                   const double part = quad.signed_area();
                                   add({quad, area < 0.0 ? -part : part});
                               }
                           });
        } else {
            for_each_quad(P, Q, range, call.poller, add);
        }
        return result;
    }

   private:
    static RangeScale range_of(const PreparedP& P, const PreparedQ& Q) noexcept {
        return RangeScale(std::max(P.checked.largest, Q.checked.largest));
    }

    // Calls visit(measured) for one quadrilateral after the other, in the given range.
    template <class Visit>
    void for_each_quad(const PreparedP& P, const PreparedQ& Q, const RangeScale& range,
                       detail::Poller& poller, Visit visit) const {
        const detail::FacingCurves curves =
            detail::face(P.checked.curve, Q.checked.curve, range, options_.spacing, poller);
        for (std::size_t i = 0; i + 1 < curves.A.size(); ++i) {
            poller.poll_in_loop(i);
            visit(measure(quad_at(curves, i), options_.crossing));
        }
    }

    // Calls visit(curves, first, end, area) for one piece of a matching after the other: its
    // quadrilaterals are those from `first` to before `end`, and their areas, with their signs,
    // make up `area`.
    template <class Visit>
    void for_each_piece(const PreparedP& P, const PreparedQ& Q, const RangeScale& range,
                        detail::Poller& poller, Visit visit) const {
        const detail::Matching curves =
            detail::match(P.checked.curve, Q.checked.curve, range, poller);
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

    AreaOptions options_;
};

}  // namespace

double area(const CurveView& P, const CurveView& Q, const AreaOptions& options, Control* control) {
    return detail::evaluate(AreaMeasure(options), P, Q, control);
}

AreaQuads area_quads(const CurveView& P, const CurveView& Q, const AreaOptions& options,
                     Control* control) {
    const AreaMeasure measure(options);
    return detail::with_pair(
        measure, P, Q, control,
        [&](const auto& p, const auto& q, const auto& call) { return measure.quads(p, q, call); });
}

std::unique_ptr<const detail::BatchMeasure> detail::batch_measure(const AreaOptions& options) {
    return std::make_unique<BatchOf<AreaMeasure>>(AreaMeasure(options));
}

}  // namespace curvewise
