// Algorithm 1 of Jekel et al. (2018): refinement, then the areas of the quadrilaterals between
// the curves (quad.hpp). With Spacing::matched the curves are matched by a warping path instead
// (matched_curves.hpp), and areas have signs, which cancel within a piece.
#include "curvewise/area.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "curves/arc_gradient.hpp"
#include "curves/arc_length.hpp"
#include "curves/polyline.hpp"
#include "curvewise/gradient.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "planar/matched_curves.hpp"
#include "planar/quad.hpp"
#include "planar/refinement.hpp"

namespace curvewise {
namespace {

using curves::Point;
using curves::Polyline;
using curves::RangeScale;
using planar::Measured;
using planar::Quad;

// Of FacingCurves or of MatchedCurves.
template <class Curves>
Quad quad_at(const Curves& curves, std::size_t i) noexcept {
    return {curves.A[i], curves.A[i + 1], curves.B[i + 1], curves.B[i]};
}

// Of a curve before its refinement, given those by the vertices after it: a cut at a + h (b - a)
// hands 1 - h of its own to a and h to b.
void write_unrefined(const Polyline& by_vertex, const std::vector<planar::Cut>& cuts,
                     const RangeScale& range, int degree, double* gradient) {
    std::size_t vertex = 0;
    auto cut = cuts.begin();
    Point carried{0.0, 0.0};
    for (std::size_t i = 0; vertex < by_vertex.size(); ++i) {
        Point sum{by_vertex[vertex].x + carried.x, by_vertex[vertex].y + carried.y};
        carried = {0.0, 0.0};
        ++vertex;
        for (; cut != cuts.end() && cut->first == i; ++cut, ++vertex) {
            const double h = cut->second;
            sum = {sum.x + (1.0 - h) * by_vertex[vertex].x,
                   sum.y + (1.0 - h) * by_vertex[vertex].y};
            carried = {carried.x + h * by_vertex[vertex].x, carried.y + h * by_vertex[vertex].y};
        }
        gradient[2 * i] = range.restore(sum.x, degree);
        gradient[2 * i + 1] = range.restore(sum.y, degree);
    }
}

// Of Q, given those by the vertices of MatchedCurves::B: what is no vertex of Q lies at a fixed
// share of its length.
void write_unmatched(const Polyline& by_vertex, const planar::PlacesOnQ& on_q, const Polyline& q,
                     const RangeScale& range, int degree, double* gradient,
                     runtime::Poller& poller) {
    std::fill_n(gradient, 2 * q.size(), 0.0);
    const std::vector<double> arc_lengths = curves::arc_lengths(on_q.scaled, poller);
    curves::ArcGradient by_arc(arc_lengths);
    for (std::size_t i = 0; i < by_vertex.size(); ++i) {
        const auto& [is_vertex, k, h, share] = on_q.places[i];
        const Point& by_point = by_vertex[i];
        gradient[2 * k] += (1.0 - h) * by_point.x;
        gradient[2 * k + 1] += (1.0 - h) * by_point.y;
        if (is_vertex) continue;
        gradient[2 * k + 2] += h * by_point.x;
        gradient[2 * k + 3] += h * by_point.y;
        const Point edge = q[k + 1] - q[k];
        by_arc.add(k, h, share, by_point.x * edge.x + by_point.y * edge.y);
    }
    // By the coordinates in `range`, as everything up to here.
    const double dx = range.restore(on_q.slopes[0], 1), dy = range.restore(on_q.slopes[1], 1);
    by_arc.for_each_segment([&](std::size_t k, double length, double by_length) {
        const Point step = on_q.scaled[k] - on_q.scaled[k - 1];
        const Point by_step{by_length * step.x / length * dx, by_length * step.y / length * dy};
        gradient[2 * k] += by_step.x;
        gradient[2 * k + 1] += by_step.y;
        gradient[2 * k - 2] -= by_step.x;
        gradient[2 * k - 1] -= by_step.y;
    });
    for (std::size_t k = 0; k < 2 * q.size(); ++k) {
        gradient[k] = range.restore(gradient[k], degree);
    }
}

class AreaMeasure : public pairwise::LinearMeasure {
   public:
    using PreparedP = pairwise::UnpreparedCurve;
    using PreparedQ = pairwise::UnpreparedCurve;

    explicit AreaMeasure(const AreaOptions& options) : options_(options) {}
    static curves::Requirements requirements() noexcept { return {AreaOptions::measure, 2, true}; }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        double sum = 0.0;
        const auto add = [&](double area) { sum += options_.squared ? area * area : area; };
        if (options_.spacing == Spacing::matched) {
            for_each_piece(planar::match(P.checked.curve, Q.checked.curve, range, call.poller),
                           call.poller,
                           [&](const auto&, auto, auto, double area) { add(std::abs(area)); });
        } else {
            for_each_quad(P, Q, range, call.poller, [&](const Quad& quad) {
                add(planar::measured_area(quad, options_.crossing));
            });
        }
        return range.restore(sum, options_.squared ? 4 : 2);
    }

    // The quadrilaterals and their areas.
    AreaQuads quads(const PreparedP& P, const PreparedQ& Q,
                    const pairwise::Call<Memory>& call) const {
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
            const auto visit = [&](const auto& curves, auto first, auto end, double area) {
                for (std::size_t i = first; i < end; ++i) {
                    const Quad quad = quad_at(curves, i);
                    const double part = quad.signed_area();
                    add({quad, area < 0.0 ? -part : part, planar::Figure::simple});
                }
            };
            for_each_piece(planar::match(P.checked.curve, Q.checked.curve, range, call.poller),
                           call.poller, visit);
        } else {
            for_each_quad(P, Q, range, call.poller,
                          [&](const Quad& quad) { add(measure(quad, options_.crossing)); });
        }
        return result;
    }

    // The area, and its derivative by Q.
    double with_gradient(const PreparedP& P, const PreparedQ& Q, double* gradient,
                         const pairwise::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        const planar::FacingCurves curves =
            planar::face(P.checked.curve, Q.checked.curve, range, options_.spacing, call.poller);
        const bool q_is_a = P.checked.curve.size() < Q.checked.curve.size();
        Polyline by_vertex(curves.A.size(), Point{0.0, 0.0});
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < curves.A.size(); ++i) {
            call.poller.poll_in_loop(i);
            const Quad quad = quad_at(curves, i);
            const Measured measured = measure(quad, options_.crossing);
            sum += options_.squared ? measured.area * measured.area : measured.area;
            const planar::CornerGradient by_corner = area_gradient(quad, measured.figure);
            const double weight = options_.squared ? 2.0 * measured.area : 1.0;
            const Point& first = by_corner[q_is_a ? 0 : 3];
            const Point& second = by_corner[q_is_a ? 1 : 2];
            by_vertex[i].x += weight * first.x;
            by_vertex[i].y += weight * first.y;
            by_vertex[i + 1].x += weight * second.x;
            by_vertex[i + 1].y += weight * second.y;
        }
        const int degree = options_.squared ? 4 : 2;
        const std::vector<planar::Cut> none;
        write_unrefined(by_vertex, q_is_a ? none : curves.cuts, range, degree - 1, gradient);
        return range.restore(sum, degree);
    }

    // The same with Spacing::matched.
    double with_matched_gradient(const PreparedP& P, const PreparedQ& Q, double* gradient,
                                 const pairwise::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        planar::PlacesOnQ on_q;
        const planar::MatchedCurves curves =
            planar::match(P.checked.curve, Q.checked.curve, range, call.poller, &on_q);
        Polyline by_vertex(curves.B.size(), Point{0.0, 0.0});
        double sum = 0.0;
        for_each_piece(curves, call.poller, [&](const auto&, auto first, auto end, double area) {
            sum += options_.squared ? area * area : std::abs(area);
            const double side = area < 0.0 ? -1.0 : static_cast<double>(area > 0.0);
            const double weight = options_.squared ? 2.0 * area : side;
            for (std::size_t i = first; i < end; ++i) {
                const auto by_corner = signed_area_gradient(quad_at(curves, i));
                by_vertex[i].x += weight * by_corner[3].x;
                by_vertex[i].y += weight * by_corner[3].y;
                by_vertex[i + 1].x += weight * by_corner[2].x;
                by_vertex[i + 1].y += weight * by_corner[2].y;
            }
        });
        const int degree = options_.squared ? 4 : 2;
        write_unmatched(by_vertex, on_q, curves::polyline(Q.checked.curve, range, call.poller),
                        range, degree - 1, gradient, call.poller);
        return range.restore(sum, degree);
    }

   private:
    static RangeScale range_of(const PreparedP& P, const PreparedQ& Q) noexcept {
        return RangeScale(std::max(P.checked.largest, Q.checked.largest));
    }

    // Calls visit(quad) for one quadrilateral after the other, in the given range.
    template <class Visit>
    void for_each_quad(const PreparedP& P, const PreparedQ& Q, const RangeScale& range,
                       runtime::Poller& poller, Visit visit) const {
        const planar::FacingCurves curves =
            planar::face(P.checked.curve, Q.checked.curve, range, options_.spacing, poller);
        for (std::size_t i = 0; i + 1 < curves.A.size(); ++i) {
            poller.poll_in_loop(i);
            visit(quad_at(curves, i));
        }
    }

    // Calls visit(curves, first, end, area) for one piece of the matched curves after the other:
    // its quadrilaterals are those from `first` to before `end`, and their areas, with their signs,
    // make up `area`.
    template <class Visit>
    static void for_each_piece(const planar::MatchedCurves& curves, runtime::Poller& poller,
                               Visit visit) {
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
    return pairwise::evaluate(AreaMeasure(options), P, Q, control);
}

AreaQuads area_quads(const CurveView& P, const CurveView& Q, const AreaOptions& options,
                     Control* control) {
    const AreaMeasure measure(options);
    return pairwise::with_pair(
        measure, P, Q, control,
        [&](const auto& p, const auto& q, const auto& call) { return measure.quads(p, q, call); });
}

double value_and_gradient(const AreaOptions& options, const CurveView& P, const CurveView& Q,
                          double* gradient, Control* control) {
    if (options.spacing == Spacing::arc_length) {
        throw std::invalid_argument(
            "area has no gradient with spacing='arc_length'; choose from distance, x, matched");
    }
    const AreaMeasure measure(options);
    return pairwise::with_pair(measure, P, Q, control,
                               [&](const auto& p, const auto& q, const auto& call) {
                                   return options.spacing == Spacing::matched
                                              ? measure.with_matched_gradient(p, q, gradient, call)
                                              : measure.with_gradient(p, q, gradient, call);
                               });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(const AreaOptions& options) {
    return std::make_unique<BatchOf<AreaMeasure>>(AreaMeasure(options));
}

}  // namespace curvewise
