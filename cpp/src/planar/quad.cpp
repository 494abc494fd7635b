#include "planar/quad.hpp"

#include <utility>

namespace curvewise::planar {
namespace {

double sign(double x) noexcept { return static_cast<double>((x > 0.0) - (x < 0.0)); }

// Of Quad::area.
CornerGradient diagonals_gradient(const Quad& quad) noexcept {
    CornerGradient gradient = signed_area_gradient(quad);
    const double side = sign(quad.signed_area());
    for (Point& by_corner : gradient) by_corner = {side * by_corner.x, side * by_corner.y};
    return gradient;
}

// Twice the area of a triangle, with its sign, as a function of three of a quadrilateral's corners.
struct Triangle {
    Triangle(const std::array<Point, 4>& all, std::array<std::size_t, 3> chosen) noexcept
        : corners(all),
          which(chosen),
          twice_area(cross(all[chosen[1]] - all[chosen[0]], all[chosen[2]] - all[chosen[0]])) {}

    // Adds weight times the derivative of |twice_area|.
    void add_gradient(double weight, CornerGradient& gradient) const noexcept {
        for (std::size_t k = 0; k < 3; ++k) {
            const Point opposite = corners[which[(k + 2) % 3]] - corners[which[(k + 1) % 3]];
            gradient[which[k]].x -= weight * sign(twice_area) * opposite.y;
            gradient[which[k]].y += weight * sign(twice_area) * opposite.x;
        }
    }

    const std::array<Point, 4>& corners;
    std::array<std::size_t, 3> which;
    double twice_area;
};

// The gradient of Quad::split_area, (abc cdb + abd cda) / 2 (abc + abd) in absolute values.
CornerGradient split_gradient(const Quad& quad) noexcept {
    const std::array<Point, 4> corners{quad.a, quad.b, quad.c, quad.d};
    const Triangle abc(corners, {0, 1, 2}), abd(corners, {0, 1, 3});
    const Triangle cda(corners, {2, 3, 0}), cdb(corners, {2, 3, 1});
    const double sum = std::abs(abc.twice_area) + std::abs(abd.twice_area);
    const double share = std::abs(abc.twice_area) / sum, rest = std::abs(abd.twice_area) / sum;
    const double slope = (std::abs(cdb.twice_area) - std::abs(cda.twice_area)) / sum;
    CornerGradient gradient{};
    abc.add_gradient(0.5 * rest * slope, gradient);
    abd.add_gradient(-0.5 * share * slope, gradient);
    cdb.add_gradient(0.5 * share, gradient);
    cda.add_gradient(0.5 * rest, gradient);
    return gradient;
}

}  // namespace

Measured measure_complex(const Quad& quad, Crossing crossing) noexcept {
    if (crossing == Crossing::split) {
        const double area = quad.split_area();
        if (area >= 0.0) return {quad, area, Figure::split_ab_cd};
        const double other = Quad{quad.b, quad.c, quad.d, quad.a}.split_area();
        if (other >= 0.0) return {quad, other, Figure::split_bc_da};
        // A corner lies on a side but for rounding: the area of one of the two triangles is zero,
        // and the other triangle has the area of the quadrilateral.
        return {quad, quad.area(), Figure::simple};
    }
    const Quad first = quad.first_swapped();
    if (first.is_simple()) return {first, first.area(), Figure::first_swapped};
    const Quad second = quad.second_swapped();
    return {second, second.area(), Figure::second_swapped};
}

CornerGradient signed_area_gradient(const Quad& quad) noexcept {
    const Point u = quad.c - quad.a, v = quad.d - quad.b;  // half their cross product
    return {Point{-0.5 * v.y, 0.5 * v.x}, Point{0.5 * u.y, -0.5 * u.x},
            Point{0.5 * v.y, -0.5 * v.x}, Point{-0.5 * u.y, 0.5 * u.x}};
}

CornerGradient area_gradient(const Quad& quad, Figure figure) noexcept {
    CornerGradient gradient{};
    switch (figure) {
        case Figure::simple:
            return diagonals_gradient(quad);
        case Figure::first_swapped:
            gradient = diagonals_gradient(quad.first_swapped());
            std::swap(gradient[0], gradient[1]);
            return gradient;
        case Figure::second_swapped:
            gradient = diagonals_gradient(quad.second_swapped());
            std::swap(gradient[1], gradient[2]);
            return gradient;
        case Figure::split_ab_cd:
            return split_gradient(quad);
        case Figure::split_bc_da:
            break;
    }
    gradient = split_gradient({quad.b, quad.c, quad.d, quad.a});
    return {gradient[3], gradient[0], gradient[1], gradient[2]};
}

}  // namespace curvewise::planar
