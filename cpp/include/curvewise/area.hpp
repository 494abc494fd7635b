/// \file
/// The area between two curves in the plane: Algorithm 1 of Jekel, Venter, Venter, Stander & Haftka
/// (2018). The curve with fewer points is refined until both have the same number. Quadrilateral i
/// is (A[i], A[i+1], B[i+1], B[i]); the measure is the sum of their areas. Symmetric to rounding,
/// except with Spacing::arc_length and Spacing::matched.
///
/// Time O(n + m + |n - m| log m), memory O(n + m). Spacing::function takes O(n + m) time.
/// Spacing::matched takes O(n + m + (50 T)^2): P travels T widths and heights of its box, and T
/// counts as at most 280. Closed curves take at most m times as long. Crossing::polygon takes
/// O((n + m + k) a log a) time and O(n + m + a^2) memory: a edges lie above each other, and two of
/// them cross k times.
///
/// Throws std::invalid_argument for a curve that is not finite, has fewer than 2 points or not 2
/// coordinates; with Spacing::function also if x turns back, or if the curves do not share a span
/// of x; for Crossing::polygon of curves that are not closed, or with `squared`; for closed
/// functions of x. Throws std::bad_alloc and Stopped. Safe from any number of threads.
///
///     curvewise::AreaOptions options;
///     options.spacing = curvewise::Spacing::x;   // raw stress and strain
///     const double value = curvewise::area(experiment, simulation, options);
#pragma once

#include <array>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// The length of a segment in the refinement. For raw stress-strain loops use `x` (or scale the
/// curves by normalize()), for functions of x use `function`. With `distance`, stress is the larger
/// number and decides alone: 174 instead of the 45.1 in the paper's Table 4.
enum class Spacing {
    distance,    ///< sqrt(dx^2 + dy^2): the paper's text
    x,           ///< |dx|: the paper's Table 4 was computed with it (within 1.4 %)
    arc_length,  ///< a vertex wherever the other curve has one, by relative arc length, after
                 ///< scaling by P's box: independent of how either curve was sampled
    matched,  ///< not Algorithm 1: by a warping path, areas with their signs in pieces of a tenth
              ///< of P's box. Little moved by sampling, noise and outliers; Crossing does not act
    function  ///< not Algorithm 1: the integral of |f - g| over the x that both curves span, as
              ///< piecewise linear functions of x; Crossing does not act
};

/// The names of the enumerators, in their order.
constexpr auto choice_names(Spacing /*spacing*/) noexcept {
    return names_up_to<Spacing::function>("distance", "x", "arc_length", "matched", "function");
}

/// The treatment of a quadrilateral that intersects itself.
enum class Crossing {
    rearrange,  ///< two vertices are swapped until it is simple: the paper. Jumps where a
                ///< quadrilateral turns complex.
    split,      ///< the two triangles at the crossing point. Does not jump there.
    polygon     ///< not Algorithm 1, for closed curves: the exact area that exactly one of the two
                ///< polygons encloses. A point is inside a polygon that winds around it (the
                ///< nonzero rule). Spacing does not act
};

/// The names of the enumerators, in their order.
constexpr auto choice_names(Crossing /*crossing*/) noexcept {
    return names_up_to<Crossing::polygon>("rearrange", "split", "polygon");
}

/// How area() refines and adds up.
struct AreaOptions {
    static constexpr const char* measure = "area";
    static constexpr bool is_planar = true;  ///< for curves of two coordinates only

    Spacing spacing = Spacing::distance;
    Crossing crossing = Crossing::rearrange;
    /// Sum the squared areas (the paper's section 4, the analogue of sum-of-squares); with
    /// Spacing::function the integral of (f - g)^2.
    bool squared = false;
    /// Join the ends of both curves; a last point that equals the first one counts once. The value
    /// is the least over the points at which Q may begin.
    bool closed = false;

    constexpr bool is_symmetric() const noexcept {
        if (closed) return crossing == Crossing::polygon;
        return spacing != Spacing::arc_length && spacing != Spacing::matched;
    }
    /// The elementary steps, of some nanoseconds each, that curves of n and m points take, roughly.
    constexpr double work(double n, double m, double /*dim*/) const noexcept {
        if (crossing == Crossing::polygon) return 50.0 * (n + m);
        const double starts = closed ? m : 1.0;
        // For most loops, 250 to 300 samples are matched.
        if (spacing == Spacing::matched) return starts * (20.0 * (n + m) + 1e5);
        if (spacing == Spacing::function) return n + m;
        return starts * (n + m + 30.0 * (n > m ? n - m : m - n));
    }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(AreaOptions& options, Visit&& visit) {
    visit("spacing", options.spacing);
    visit("crossing", options.crossing);
    visit("squared", options.squared);
    visit("closed", options.closed);
}

/// The quadrilaterals between two curves, and their areas: quads[i] has areas[i].
struct AreaQuads {
    /// Vertices in the order that gives the area, or in the original order if a complex
    /// quadrilateral was split and with Spacing::matched. With Spacing::matched, an area is
    /// negative if its sign is opposite to its piece's. Of closed curves, those from the best point
    /// of Q on. With Crossing::polygon, trapezoids between two x.
    std::vector<std::array<std::array<double, 2>, 4>> quads;
    std::vector<double> areas;
};

/// In units of x times units of y; with options.squared, of that squared, or with
/// Spacing::function in units of x times units of y squared.
[[nodiscard]] CURVEWISE_EXPORT double area(const CurveView& P, const CurveView& Q,
                                           const AreaOptions& options = {},
                                           Control* control = nullptr);

/// The quadrilaterals behind area(); options.squared is not used.
[[nodiscard]] CURVEWISE_EXPORT AreaQuads area_quads(const CurveView& P, const CurveView& Q,
                                                    const AreaOptions& options = {},
                                                    Control* control = nullptr);

/// For code that treats all measures in the same way (measure.hpp).
[[nodiscard]] inline double evaluate(const AreaOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return area(P, Q, options, control);
}

}  // namespace curvewise
