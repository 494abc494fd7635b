// Derivatives of area: of the quadrilaterals between refined curves, and of the pieces of matched
// ones.
#include "planar/area_gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "curves/arc_gradient.hpp"
#include "curves/arc_length.hpp"
#include "planar/matched_curves.hpp"
#include "planar/quad.hpp"
#include "planar/refinement.hpp"

namespace curvewise::planar {
namespace {

using curves::Point;
using curves::Polyline;
using curves::RangeScale;

// Writes the gradient by a curve before its refinement, given the gradient by the vertices after
// it. A cut at a + h (b - a) passes 1 - h of its gradient to a and h to b.
void write_unrefined(const Polyline& by_vertex, const runtime::ScratchVector<Cut>& cuts,
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
runtime::ScratchVector<Point> unmatched(const Polyline& by_vertex, const PlacesOnCurve& on_curve,
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

// The area, and its derivatives.
double of_facing(const CurveView& P, const CurveView& Q, const AreaOptions& options,
                 const RangeScale& range, const Gradients& out, runtime::Poller& poller) {
    const FacingCurves curves = face(P, Q, range, options.spacing, poller);
    const bool q_is_a = P.size() < Q.size();
    double* const by_a = q_is_a ? out.by_q : out.by_p;
    double* const by_b = q_is_a ? out.by_p : out.by_q;
    ByVertex by(curves.A.size(), by_a != nullptr, by_b != nullptr);
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < curves.A.size(); ++i) {
        poller.poll_in_loop(i);
        const Quad quad = quad_at(curves, i);
        const Measured measured = measure(quad, options.crossing);
        sum += options.squared ? measured.area * measured.area : measured.area;
        by.add(i, area_gradient(quad, measured.figure),
               options.squared ? 2.0 * measured.area : 1.0);
    }
    const int degree = options.squared ? 4 : 2;
    const runtime::ScratchVector<Cut> none;
    write_unrefined(by.A, none, range, degree - 1, by_a);
    write_unrefined(by.B, curves.cuts, range, degree - 1, by_b);
    return range.restore(sum, degree);
}

// The same with Spacing::matched.
double of_matched(const CurveView& P, const CurveView& Q, const AreaOptions& options,
                  const RangeScale& range, const Gradients& out, runtime::Poller& poller) {
    PlacesOnCurves on;
    const MatchedCurves curves = match(P, Q, range, poller, &on);
    // Both, because each moves the box that scales the lengths of the other.
    ByVertex by(curves.A.size(), true, true);
    double sum = 0.0;
    for_each_piece(curves, poller, [&](const auto&, auto first, auto end, double area) {
        sum += options.squared ? area * area : std::abs(area);
        const double side = area < 0.0 ? -1.0 : static_cast<double>(area > 0.0);
        const double weight = options.squared ? 2.0 * area : side;
        for (std::size_t i = first; i < end; ++i) {
            by.add(i, signed_area_gradient(quad_at(curves, i)), weight);
        }
    });
    const Polyline p = curves::polyline(P, range, poller);
    const Polyline q = curves::polyline(Q, range, poller);
    std::array<double, 2> by_slope{0.0, 0.0};
    auto by_p = unmatched(by.A, on.p, on.slopes, p, range, by_slope, poller);
    auto by_q = unmatched(by.B, on.q, on.slopes, q, range, by_slope, poller);
    constexpr std::array<double Point::*, 2> coordinates{&Point::x, &Point::y};
    for (std::size_t c = 0; c < 2; ++c) {
        const bool is_p = on.is_box_of_p[c];
        add_box_gradient(is_p ? p : q, range.restore(on.slopes[c], 1), by_slope[c], coordinates[c],
                         is_p ? by_p : by_q);
    }
    const int degree = options.squared ? 4 : 2;
    write(by_p, range, degree - 1, out.by_p);
    write(by_q, range, degree - 1, out.by_q);
    return range.restore(sum, degree);
}

}  // namespace

double area_and_gradients(const CurveView& P, const CurveView& Q, const AreaOptions& options,
                          const RangeScale& range, const Gradients& out, runtime::Poller& poller) {
    return options.spacing == Spacing::matched ? of_matched(P, Q, options, range, out, poller)
                                               : of_facing(P, Q, options, range, out, poller);
}

}  // namespace curvewise::planar
