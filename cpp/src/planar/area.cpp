// Algorithm 1 of Jekel et al. (2018): refinement, then the areas of the quadrilaterals between
// the curves (quad.hpp). With Spacing::matched the curves are matched by a warping path instead
// (matched_curves.hpp), and areas have signs, which cancel within a piece.
#include "curvewise/area.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "curves/arc_gradient.hpp"
#include "curves/arc_length.hpp"
#include "curves/polyline.hpp"
#include "curvewise/gradient.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "planar/function_strips.hpp"
#include "planar/matched_curves.hpp"
#include "planar/quad.hpp"
#include "planar/refinement.hpp"
#include "runtime/scratch.hpp"

namespace curvewise {
namespace {

using curves::Point;
using curves::Polyline;
using curves::RangeScale;
using planar::Measured;
using planar::Quad;

// For FacingCurves or MatchedCurves.
template <class Curves>
Quad quad_at(const Curves& curves, std::size_t i) noexcept {
    return {curves.A[i], curves.A[i + 1], curves.B[i + 1], curves.B[i]};
}

// Writes the gradient by a curve before its refinement, given the gradient by the vertices after
// it. A cut at a + h (b - a) passes 1 - h of its gradient to a and h to b.
void write_unrefined(const Polyline& by_vertex, const runtime::ScratchVector<planar::Cut>& cuts,
                     const RangeScale& range, int degree, double* gradient) {
    if (gradient == nullptr) return;
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

// Returns the gradient by the points in `range` of one of the matched curves, given the gradient by
// its vertices in MatchedCurves. A place between two vertices of the curve lies at a fixed share of
// its length. Adds the derivatives by the scaling of lengths to `by_slope`.
runtime::ScratchVector<Point> unmatched(const Polyline& by_vertex,
                                        const planar::PlacesOnCurve& on_curve,
                                        const std::array<double, 2>& slopes, const Polyline& points,
                                        const RangeScale& range, std::array<double, 2>& by_slope,
                                        runtime::Poller& poller) {
    runtime::ScratchVector<Point> gradient(points.size(), Point{0.0, 0.0});
    const runtime::ScratchVector<double> arc_lengths = curves::arc_lengths(on_curve.scaled, poller);
    curves::ArcGradient by_arc(arc_lengths);
    for (std::size_t i = 0; i < by_vertex.size(); ++i) {
        const auto& [is_vertex, k, h, share] = on_curve.places[i];
        const Point& by_point = by_vertex[i];
        gradient[k].x += (1.0 - h) * by_point.x;
        gradient[k].y += (1.0 - h) * by_point.y;
        if (is_vertex) continue;
        gradient[k + 1].x += h * by_point.x;
        gradient[k + 1].y += h * by_point.y;
        const Point edge = points[k + 1] - points[k];
        by_arc.add(k, h, share, by_point.x * edge.x + by_point.y * edge.y);
    }
    // By the coordinates in `range`, as everything up to here.
    const double dx = range.restore(slopes[0], 1), dy = range.restore(slopes[1], 1);
    by_arc.for_each_segment([&](std::size_t k, double length, double by_length) {
        const Point step = on_curve.scaled[k] - on_curve.scaled[k - 1];
        const Point by_step{by_length * step.x / length * dx, by_length * step.y / length * dy};
        gradient[k].x += by_step.x;
        gradient[k].y += by_step.y;
        gradient[k - 1].x -= by_step.x;
        gradient[k - 1].y -= by_step.y;
        by_slope[0] += by_length * step.x / length * (step.x / dx);
        by_slope[1] += by_length * step.y / length * (step.y / dy);
    });
    return gradient;
}

// Adds the derivatives by the scaling to the points that span the box: 1 over its extent.
void add_box_gradient(const Polyline& points, double slope, double by_slope,
                      double Point::*coordinate, runtime::ScratchVector<Point>& gradient) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(),
        [&](const Point& a, const Point& b) { return a.*coordinate < b.*coordinate; });
    const double by_extent = -slope * slope * by_slope;
    gradient[static_cast<std::size_t>(high - points.begin())].*coordinate += by_extent;
    gradient[static_cast<std::size_t>(low - points.begin())].*coordinate -= by_extent;
}

void write(const runtime::ScratchVector<Point>& gradient, const RangeScale& range, int degree,
           double* out) {
    if (out == nullptr) return;
    for (std::size_t k = 0; k < gradient.size(); ++k) {
        out[2 * k] = range.restore(gradient[k].x, degree);
        out[2 * k + 1] = range.restore(gradient[k].y, degree);
    }
}

class AreaMeasure : public pairwise::LinearMeasure {
   public:
    using PreparedP = pairwise::UnpreparedCurve;
    using PreparedQ = pairwise::UnpreparedCurve;

    explicit AreaMeasure(const AreaOptions& options) : options_(options) {}
    static curves::Requirements requirements() noexcept { return {AreaOptions::measure, 2, true}; }
    // A curve that is not a function of x has no area, not even to itself.
    bool is_zero_to_itself(const curves::CheckedCurve& /*checked*/) const noexcept {
        return options_.spacing != Spacing::function;
    }
    static constexpr bool checks_p = true;
    void check_p(const PreparedP& P, runtime::Poller& poller) const {
        if (options_.spacing == Spacing::function) planar::check_is_function(P.checked, poller);
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        if (options_.spacing == Spacing::function) {
            double integral = 0.0;
            planar::FunctionStrips strips(P.checked, Q.checked, range, call.poller);
            strips.for_each(call.poller, [&](const Quad& strip) {
                integral +=
                    options_.squared ? planar::strip_squares(strip) : planar::strip_area(strip);
            });
            return range.restore(integral, options_.squared ? 3 : 2);
        }
        double sum = 0.0;
        const auto add = [&](double area) { sum += options_.squared ? area * area : area; };
        if (options_.spacing == Spacing::matched) {
            for (const double piece :
                 planar::matched_areas(P.checked.curve, Q.checked.curve, range, call.poller)) {
                add(std::abs(piece));
            }
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
        if (options_.spacing == Spacing::function) {
            planar::FunctionStrips strips(P.checked, Q.checked, range, call.poller);
            strips.for_each(call.poller, [&](const Quad& strip) {
                add({strip, planar::strip_area(strip), planar::Figure::simple});
            });
        } else if (options_.spacing == Spacing::matched) {
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

    // The area, and its derivatives.
    double with_gradients(const PreparedP& P, const PreparedQ& Q, const Gradients& out,
                          const pairwise::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        const planar::FacingCurves curves =
            planar::face(P.checked.curve, Q.checked.curve, range, options_.spacing, call.poller);
        const bool q_is_a = P.checked.curve.size() < Q.checked.curve.size();
        double* const by_a = q_is_a ? out.by_q : out.by_p;
        double* const by_b = q_is_a ? out.by_p : out.by_q;
        ByVertex by(curves.A.size(), by_a != nullptr, by_b != nullptr);
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < curves.A.size(); ++i) {
            call.poller.poll_in_loop(i);
            const Quad quad = quad_at(curves, i);
            const Measured measured = measure(quad, options_.crossing);
            sum += options_.squared ? measured.area * measured.area : measured.area;
            by.add(i, area_gradient(quad, measured.figure),
                   options_.squared ? 2.0 * measured.area : 1.0);
        }
        const int degree = options_.squared ? 4 : 2;
        const runtime::ScratchVector<planar::Cut> none;
        write_unrefined(by.A, none, range, degree - 1, by_a);
        write_unrefined(by.B, curves.cuts, range, degree - 1, by_b);
        return range.restore(sum, degree);
    }

    // The same with Spacing::matched.
    double with_matched_gradients(const PreparedP& P, const PreparedQ& Q, const Gradients& out,
                                  const pairwise::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        planar::PlacesOnCurves on;
        const planar::MatchedCurves curves =
            planar::match(P.checked.curve, Q.checked.curve, range, call.poller, &on);
        // Both, because each moves the box that scales the lengths of the other.
        ByVertex by(curves.A.size(), true, true);
        double sum = 0.0;
        for_each_piece(curves, call.poller, [&](const auto&, auto first, auto end, double area) {
            sum += options_.squared ? area * area : std::abs(area);
            const double side = area < 0.0 ? -1.0 : static_cast<double>(area > 0.0);
            const double weight = options_.squared ? 2.0 * area : side;
            for (std::size_t i = first; i < end; ++i) {
                by.add(i, signed_area_gradient(quad_at(curves, i)), weight);
            }
        });
        const Polyline p = curves::polyline(P.checked.curve, range, call.poller);
        const Polyline q = curves::polyline(Q.checked.curve, range, call.poller);
        std::array<double, 2> by_slope{0.0, 0.0};
        auto by_p = unmatched(by.A, on.p, on.slopes, p, range, by_slope, call.poller);
        auto by_q = unmatched(by.B, on.q, on.slopes, q, range, by_slope, call.poller);
        constexpr std::array<double Point::*, 2> coordinates{&Point::x, &Point::y};
        for (std::size_t c = 0; c < 2; ++c) {
            const bool is_p = on.is_box_of_p[c];
            add_box_gradient(is_p ? p : q, range.restore(on.slopes[c], 1), by_slope[c],
                             coordinates[c], is_p ? by_p : by_q);
        }
        const int degree = options_.squared ? 4 : 2;
        write(by_p, range, degree - 1, out.by_p);
        write(by_q, range, degree - 1, out.by_q);
        return range.restore(sum, degree);
    }

   private:
    static RangeScale range_of(const PreparedP& P, const PreparedQ& Q) noexcept {
        return RangeScale(std::max(P.checked.largest, Q.checked.largest));
    }

    // By the vertices of the two curves between which the quadrilaterals lie, or of one of them.
    struct ByVertex {
        ByVertex(std::size_t size, bool of_a, bool of_b)
            : A(of_a ? size : 0, Point{0.0, 0.0}), B(of_b ? size : 0, Point{0.0, 0.0}) {}
        // Adds quadrilateral i, whose corners are A[i], A[i + 1], B[i + 1], B[i].
        void add(std::size_t i, const planar::CornerGradient& by_corner, double weight) noexcept {
            if (!A.empty()) {
                add_to(A[i], by_corner[0], weight);
                add_to(A[i + 1], by_corner[1], weight);
            }
            if (!B.empty()) {
                add_to(B[i], by_corner[3], weight);
                add_to(B[i + 1], by_corner[2], weight);
            }
        }
        static void add_to(Point& sum, const Point& slope, double weight) noexcept {
            sum.x += weight * slope.x;
            sum.y += weight * slope.y;
        }
        Polyline A, B;
    };

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

    // Calls visit(curves, first, end, area) for each piece of the matched curves in order. Its
    // quadrilaterals are those from `first` to before `end`; `area` is the sum of their signed
    // areas.
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

double value_and_gradients(const AreaOptions& options, const CurveView& P, const CurveView& Q,
                           const Gradients& out, Control* control) {
    if (options.spacing == Spacing::arc_length || options.spacing == Spacing::function) {
        throw std::invalid_argument(
            std::string("area has no gradient with spacing='") +
            choice_names(options.spacing)[static_cast<std::size_t>(options.spacing)] +
            "'; choose from distance, x, matched");
    }
    const AreaMeasure measure(options);
    return pairwise::with_pair(measure, P, Q, control,
                               [&](const auto& p, const auto& q, const auto& call) {
                                   return options.spacing == Spacing::matched
                                              ? measure.with_matched_gradients(p, q, out, call)
                                              : measure.with_gradients(p, q, out, call);
                               });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(const AreaOptions& options) {
    return std::make_unique<BatchOf<AreaMeasure>>(AreaMeasure(options));
}

}  // namespace curvewise
