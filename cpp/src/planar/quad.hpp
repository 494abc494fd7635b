// The quadrilateral between two facing segments: its area, and the derivative of its area.
//
// Areas are half the cross product of the diagonals, Gauss's formula without its cancellation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "curves/polyline.hpp"
#include "curvewise/area.hpp"

namespace curvewise::planar {

using curves::Point;

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
    Quad first_swapped() const noexcept { return {b, a, c, d}; }
    Quad second_swapped() const noexcept { return {a, c, b, d}; }

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

// The quadrilateral between the segments from vertex i of facing or matched curves.
template <class Curves>
Quad quad_at(const Curves& curves, std::size_t i) noexcept {
    return {curves.A[i], curves.A[i + 1], curves.B[i + 1], curves.B[i]};
}

// How the area of a quadrilateral is taken.
enum class Figure { simple, first_swapped, second_swapped, split_ab_cd, split_bc_da };

// The quadrilateral as its area is taken, that area, and how.
struct Measured {
    Quad quad;
    double area;
    Figure figure;
};

Measured measure_complex(const Quad& quad, Crossing crossing) noexcept;

inline Measured measure(const Quad& quad, Crossing crossing) noexcept {
    if (quad.is_simple()) return {quad, quad.area(), Figure::simple};
    return measure_complex(quad, crossing);
}

// Of measure().
inline double measured_area(const Quad& quad, Crossing crossing) noexcept {
    return quad.is_simple() ? quad.area() : measure_complex(quad, crossing).area;
}

// The derivatives of an area by the corners A, B, C, D of the quadrilateral it was measured of.
using CornerGradient = std::array<Point, 4>;

// Of Quad::signed_area.
CornerGradient signed_area_gradient(const Quad& quad) noexcept;

CornerGradient area_gradient(const Quad& quad, Figure figure) noexcept;

}  // namespace curvewise::planar
