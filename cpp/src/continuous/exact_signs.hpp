// The comparisons of the free-space diagram without rounding. free_space.hpp uses them if its error
// bounds leave a comparison undecided. All are about one edge X Y, with u = Y - X, and points Z
// near it, each with w = Z - X and a radius r. X + t u lies within r of Z for t between
//
//   (A -+ sqrt(R)) / D,   D = u.u,   A = u.w,   R = A^2 - D (w.w - r^2).
//
// Coordinates and radii are doubles, that is, whole numbers times a power of two. D is the same for
// every Z. So each comparison compares numbers a + b sqrt(c) in whole numbers, and squaring decides
// it. Each takes some microseconds; a decision needs about five.
#pragma once

#include <cstddef>

#include "curvewise/curve.hpp"

namespace curvewise::continuous {

// The part of an edge within `radius` of the vertex `index` of the other curve.
struct Reach {
    std::ptrdiff_t index;
    double radius;
};

class ExactSigns {
   public:
    // `edges` is the curve that the edges are of, `points` the other one.
    ExactSigns(const CurveView& edges, const CurveView& points) noexcept
        : edges_(edges), points_(points) {}

    // The sign of |Z - X| - r, X being a vertex of the curve of the edges.
    int distance(std::ptrdiff_t vertex, const Reach& z) const;
    // The same of X + t (Y - X), a point of an edge.
    int distance_at(std::ptrdiff_t edge, double t, const Reach& z) const;
    // For an edge whose ends are both farther than r from Z. -1 if a section inside it is closer
    // than r, 0 if one point of it is at r, 1 otherwise.
    int inside(std::ptrdiff_t edge, const Reach& z) const;
    // The sign of the difference of the lower parameter of one and the lower, or the upper,
    // parameter of the other; both must have them.
    int low_to_low(std::ptrdiff_t edge, const Reach& one, const Reach& other) const;
    int low_to_high(std::ptrdiff_t edge, const Reach& low, const Reach& high) const;
    bool same_point(std::ptrdiff_t one, std::ptrdiff_t other) const noexcept;

   private:
    CurveView edges_;
    CurveView points_;
};

}  // namespace curvewise::continuous
