#include "continuous/exact_signs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuous/integer.hpp"

namespace curvewise::continuous {
namespace {

// A single point is a curve of one edge of no length.
double coordinate(const CurveView& curve, std::ptrdiff_t i, std::ptrdiff_t c) noexcept {
    return curve(std::min(i, curve.size() - 1), c);
}

constexpr int no_exponent = std::numeric_limits<int>::max();

// x = mantissa 2^exponent.
struct Parts {
    explicit Parts(double x) {
        if (x == 0.0) return;
        mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
        exponent -= 53;
    }
    std::int64_t mantissa = 0;
    int exponent = no_exponent;
};

// The largest power of two that divides several numbers.
class Unit {
   public:
    void admit(double x) { exponent_ = std::min(exponent_, Parts(x).exponent); }
    void admit(const CurveView& curve, std::ptrdiff_t i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) admit(coordinate(curve, i, c));
    }
    Integer count(double x) const {
        const Parts parts(x);
        if (parts.mantissa == 0) return {};
        return {parts.mantissa, parts.exponent - exponent_};
    }

   private:
    int exponent_ = no_exponent;
};

// The numbers A and R of a point and its radius, see the header.
struct Quadratic {
    Integer a, r;
};

// One edge in whole numbers.
class WholeEdge {
   public:
    WholeEdge(const CurveView& edges, std::ptrdiff_t edge, const CurveView& points,
              const Unit& unit)
        : edges_(edges), edge_(edge), points_(points), unit_(unit) {
        for (std::ptrdiff_t c = 0; c < edges.dim(); ++c) {
            const Integer u = component(c);
            d_ = d_ + u * u;
        }
    }

    const Integer& d() const noexcept { return d_; }

    Quadratic quadratic(const Reach& z) const {
        Integer a, square;
        for (std::ptrdiff_t c = 0; c < edges_.dim(); ++c) {
            const Integer w = unit_.count(coordinate(points_, z.index, c)) -
                              unit_.count(coordinate(edges_, edge_, c));
            a = a + component(c) * w;
            square = square + w * w;
        }
        const Integer radius = unit_.count(z.radius);
        return {a, a * a - d_ * (square - radius * radius)};
    }

   private:
    Integer component(std::ptrdiff_t c) const {
        return unit_.count(coordinate(edges_, edge_ + 1, c)) -
               unit_.count(coordinate(edges_, edge_, c));
    }

    const CurveView& edges_;
    std::ptrdiff_t edge_;
    const CurveView& points_;
    const Unit& unit_;
    Integer d_;
};

Unit unit_of(const CurveView& edges, std::ptrdiff_t edge, const CurveView& points, const Reach& one,
             const Reach& other) {
    Unit unit;
    unit.admit(edges, edge);
    unit.admit(edges, edge + 1);
    for (const Reach& z : {one, other}) {
        unit.admit(points, z.index);
        unit.admit(z.radius);
    }
    return unit;
}

// The sign of x - 2 sqrt(r).
int compare_to_root(const Integer& x, const Integer& r) {
    if (x.sign() <= 0) return x.sign() == 0 && r.sign() == 0 ? 0 : -1;
    return (x * x - r.times_power_of_two(2)).sign();
}

}  // namespace

int ExactSigns::distance(std::ptrdiff_t vertex, const Reach& z) const {
    Unit unit;
    unit.admit(edges_, vertex);
    unit.admit(points_, z.index);
    unit.admit(z.radius);
    const Integer radius = unit.count(z.radius);
    Integer difference = -(radius * radius);
    for (std::ptrdiff_t c = 0; c < edges_.dim(); ++c) {
        const Integer w =
            unit.count(coordinate(points_, z.index, c)) - unit.count(coordinate(edges_, vertex, c));
        difference = difference + w * w;
    }
    return difference.sign();
}

// With t = k 2^-l: of |2^l w - k u|^2 and (2^l r)^2.
int ExactSigns::distance_at(std::ptrdiff_t edge, double t, const Reach& z) const {
    const Parts parts(t);
    if (parts.mantissa == 0) return distance(edge, z);
    const Unit unit = unit_of(edges_, edge, points_, z, z);
    // A t below 1 has a negative exponent.
    const int shift = -parts.exponent;
    const Integer k(parts.mantissa, 0);
    const Integer radius = unit.count(z.radius).times_power_of_two(shift);
    Integer difference = -(radius * radius);
    for (std::ptrdiff_t c = 0; c < edges_.dim(); ++c) {
        const Integer x = unit.count(coordinate(edges_, edge, c));
        const Integer u = unit.count(coordinate(edges_, edge + 1, c)) - x;
        const Integer w = unit.count(coordinate(points_, z.index, c)) - x;
        const Integer h = w.times_power_of_two(shift) - k * u;
        difference = difference + h * h;
    }
    return difference.sign();
}

int ExactSigns::inside(std::ptrdiff_t edge, const Reach& z) const {
    const Unit unit = unit_of(edges_, edge, points_, z, z);
    const WholeEdge whole(edges_, edge, points_, unit);
    const Quadratic q = whole.quadratic(z);
    if (q.a.sign() <= 0 || (whole.d() - q.a).sign() <= 0) return 1;
    return -q.r.sign();
}

bool ExactSigns::same_point(std::ptrdiff_t one, std::ptrdiff_t other) const noexcept {
    for (std::ptrdiff_t c = 0; c < points_.dim(); ++c) {
        if (coordinate(points_, one, c) != coordinate(points_, other, c)) return false;
    }
    return true;
}

// With x = A1 - A2: x - sqrt(R1) + sqrt(R2).
int ExactSigns::low_to_low(std::ptrdiff_t edge, const Reach& one, const Reach& other) const {
    const Unit unit = unit_of(edges_, edge, points_, one, other);
    const WholeEdge whole(edges_, edge, points_, unit);
    const Quadratic first = whole.quadratic(one), second = whole.quadratic(other);
    const Integer x = first.a - second.a;
    // Both sides of x + sqrt(R2) <> sqrt(R1) are squared, or of sqrt(R2) <> sqrt(R1) - x.
    if (x.sign() >= 0) {
        return -compare_to_root(first.r - second.r - x * x, x * x * second.r);
    }
    return compare_to_root(second.r - first.r - x * x, x * x * first.r);
}

// With x = A1 - A2: x - sqrt(R1) - sqrt(R2).
int ExactSigns::low_to_high(std::ptrdiff_t edge, const Reach& low, const Reach& high) const {
    const Unit unit = unit_of(edges_, edge, points_, low, high);
    const WholeEdge whole(edges_, edge, points_, unit);
    const Quadratic first = whole.quadratic(low), second = whole.quadratic(high);
    const Integer x = first.a - second.a;
    if (x.sign() < 0) return -1;
    return compare_to_root(x * x - first.r - second.r, first.r * second.r);
}

}  // namespace curvewise::continuous
