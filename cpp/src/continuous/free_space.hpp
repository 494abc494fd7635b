// The free-space diagram of two curves (Alt & Godau 1995) at one radius: which points of the edges
// of one curve lie within the radius of a vertex of the other. Answers are exact. Each is first
// computed in plain doubles with an error bound. If the bound leaves it undecided, it is computed
// in whole numbers (exact_signs.hpp).
//
// Error bounds. With eps = 2^-53, the difference of two coordinates has a relative error of at most
// eps, however large both are. So nothing is lost far from the origin. A sum of d products has an
// error of at most g = (d + 4) eps times the sum of magnitudes. `slack` below is 8 g. Coordinates
// are between 2^-100 and 2^100 or scaled to at most 1 (plain_scale), so that nothing overflows.
// Underflow adds less than `tiny`.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "continuous/boxed_curve.hpp"
#include "continuous/exact_signs.hpp"
#include "continuous/least_double.hpp"
#include "curves/range_scale.hpp"

namespace curvewise::continuous {

// Whether a point at the very radius is free. Open: whether the distance is below the radius;
// closed: whether it is at most the radius.
enum class FreeSet { closed, open };

// A radius and the bounds that the filters need, in units of the scaled curves.
class Radius {
   public:
    Radius(double given, const RangeScale& range, std::ptrdiff_t dim, FreeSet set) noexcept
        : given_(given),
          scaled_(range.shrink(given)),
          square_(scaled_ * scaled_),
          slack_(slack_of(dim)),
          tiny_(tiny_of(dim)),
          holds_below_(square_ * (1.0 - slack_) - tiny_),
          misses_above_(square_ * (1.0 + slack_) + tiny_),
          set_(set) {}

    static double slack_of(std::ptrdiff_t dim) noexcept {
        return 8.0 * static_cast<double>(dim + 4) * 0x1p-53;
    }
    static double tiny_of(std::ptrdiff_t dim) noexcept {
        return static_cast<double>(dim * dim) * 0x1p-1056;
    }

    double given() const noexcept { return given_; }
    double scaled() const noexcept { return scaled_; }
    double square() const noexcept { return square_; }
    double slack() const noexcept { return slack_; }
    double tiny() const noexcept { return tiny_; }
    // Takes the rounded square of a distance.
    bool surely_holds(double square) const noexcept { return square <= holds_below_; }
    bool surely_misses(double square) const noexcept { return square > misses_above_; }
    // Takes the exact sign of a distance minus the radius.
    bool holds(int sign) const noexcept { return set_ == FreeSet::closed ? sign <= 0 : sign < 0; }

   private:
    double given_, scaled_, square_, slack_, tiny_, holds_below_, misses_above_;
    FreeSet set_;
};

// An end of an interval on an edge: the point where the edge enters, or leaves, the reach of vertex
// `index` of the other curve, or the edge's own end. Its place along the edge is computed on first
// use: 0 is the first vertex and 1 the second.
struct Bound {
    static constexpr std::ptrdiff_t own_end = -1;
    static constexpr double unknown = -1.0;

    bool is_own_end() const noexcept { return index == own_end; }
    bool is_placed() const noexcept { return error != unknown; }

    std::ptrdiff_t index = own_end;
    double radius = 0.0;
    double scaled_radius = 0.0;
    double t = 0.0;
    double error = unknown;  // of t
};

// What of an edge is free: everything from low to high, or nothing.
struct FreePart {
    bool is_empty;
    Bound low;
    Bound high;
};

// The edges of one curve as seen from the vertices of the other.
template <int Dim>
class EdgeFamily {
   public:
    EdgeFamily(const BoxedCurve& edges, const BoxedCurve& points, const ExactSigns& exact)
        : edges_(edges), points_(points), exact_(exact) {}

    std::ptrdiff_t vertices() const noexcept { return edges_.size(); }
    std::ptrdiff_t dim() const noexcept { return edges_.dim(); }

    // Whether a vertex is within the radius of point k of the other curve.
    bool vertex_is_free(std::ptrdiff_t vertex, std::ptrdiff_t k, const Radius& radius) const {
        const double square =
            square_distance<Dim>(edges_.point<Dim>(vertex), points_.point<Dim>(k), edges_.dim());
        if (radius.surely_holds(square)) return true;
        if (radius.surely_misses(square)) return false;
        return radius.holds(exact_.distance(vertex, {k, radius.given()}));
    }

    // Whether an edge has a free section inside, if neither of its ends is free. X and Y are the
    // ends, Z the point, u = Y - X, w = Z - X. The square distance of Z to the line is below r^2 if
    //
    //   (u.w)^2 - u.u (w.w - r^2) > 0.
    //
    // This expression has an error of at most 6 g u.u (w.w + r^2). The foot of Z lies inside if 0 <
    // u.w < u.u. The signs of both differences are right if the expression exceeds its error, since
    // w.w > r^2.
    bool inside_is_free(std::ptrdiff_t edge, std::ptrdiff_t k, const Radius& radius) const {
        const double* const x = edges_.point<Dim>(edge);
        const double* const y = edges_.point<Dim>(edge + 1);
        const double* const z = points_.point<Dim>(k);
        double uu = 0.0, uw = 0.0, ww = 0.0;
        for (std::ptrdiff_t c = 0; c < edges_.dim(); ++c) {
            const double u = y[c] - x[c], w = z[c] - x[c];
            uu += u * u;
            uw += u * w;
            ww += w * w;
        }
        const double margin = uw * uw - uu * (ww - radius.square());
        const double error = radius.slack() * uu * (ww + radius.square()) + radius.tiny();
        if (margin < -error) return false;
        if (margin > error) return uw > 0.0 && uw < uu;
        return radius.holds(exact_.inside(edge, {k, radius.given()}));
    }

    // The free part of an edge, given which of its ends are free.
    FreePart free_part(std::ptrdiff_t edge, std::ptrdiff_t k, bool first_is_free,
                       bool second_is_free, const Radius& radius) const {
        const Bound reach{k, radius.given(), radius.scaled()};
        const bool is_empty = !first_is_free && !second_is_free && !inside_is_free(edge, k, radius);
        return {is_empty, first_is_free ? Bound{} : reach, second_is_free ? Bound{} : reach};
    }

    // The rest of a free part, which is not empty, from a lower bound on.
    FreePart from(std::ptrdiff_t edge, Bound low, FreePart part, const Radius& radius) const {
        if (low.is_own_end()) return part;
        if (part.low.is_own_end() && part.high.is_own_end()) return {false, low, part.high};
        const Roots roots = roots_of(edge, part.low.is_own_end() ? part.high : part.low);
        if (!low.is_placed()) place(low, roots_of(edge, low), -1);
        if (!part.high.is_own_end()) {
            place(part.high, roots, 1);
            if (!is_in_order(edge, low, part.high, radius)) return {true, {}, {}};
        }
        if (!part.low.is_own_end()) {
            place(part.low, roots, -1);
            if (!is_later(edge, low, part.low)) return part;
        }
        part.low = low;
        return part;
    }

    // Whether a lower bound on an edge lies behind another.
    bool is_behind(std::ptrdiff_t edge, Bound low, Bound other) const {
        if (low.is_own_end() || other.is_own_end()) return !low.is_own_end();
        place(low, roots_of(edge, low), -1);
        place(other, roots_of(edge, other), -1);
        return is_later(edge, low, other);
    }

    // The ends of a part as parameters of its edge, rounded.
    std::pair<double, double> ends(std::ptrdiff_t edge, FreePart part) const noexcept {
        const auto end = [&](Bound& bound, double own_end, int side) {
            if (bound.is_own_end()) return own_end;
            if (!bound.is_placed()) place(bound, roots_of(edge, bound), side);
            return std::min(std::max(bound.t, 0.0), 1.0);
        };
        const double low = end(part.low, 0.0, -1), high = end(part.high, 1.0, 1);
        return {low, std::max(low, high)};
    }
    // The parameter of the point of an edge that is nearest to point k, rounded.
    double nearest(std::ptrdiff_t edge, std::ptrdiff_t k) const noexcept {
        const Roots roots = roots_of(edge, {k, 0.0, 0.0});
        return std::min(std::max(roots.middle, 0.0), 1.0);
    }
    double square_distance_at(std::ptrdiff_t edge, double t, std::ptrdiff_t k) const noexcept {
        const double* const x = edges_.point<Dim>(edge);
        const double* const y = edges_.point<Dim>(edge + 1);
        const double* const z = points_.point<Dim>(k);
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < edges_.dim(); ++c) {
            const double h = (z[c] - x[c]) - t * (y[c] - x[c]);
            sum += h * h;
        }
        return sum;
    }
    // Whether point t of an edge is within the radius of point k. Both terms of a difference h are
    // right to 2 eps of their magnitudes, which is more than all of h where they nearly cancel.
    bool point_is_free(std::ptrdiff_t edge, double t, std::ptrdiff_t k,
                       const Radius& radius) const {
        const double* const x = edges_.point<Dim>(edge);
        const double* const y = edges_.point<Dim>(edge + 1);
        const double* const z = points_.point<Dim>(k);
        double most = 0.0;
        for (std::ptrdiff_t c = 0; c < edges_.dim(); ++c) {
            const double w = z[c] - x[c], v = t * (y[c] - x[c]);
            const double h = std::abs(w - v) + 0x1p-51 * (std::abs(w) + std::abs(v));
            most += h * h;
        }
        return radius.surely_holds(most) ||
               radius.holds(exact_.distance_at(edge, t, {k, radius.given()}));
    }
    // The least double above `least` that is not below the distance of these, which is above it; in
    // units of the given curves.
    double distance_at(std::ptrdiff_t edge, double t, std::ptrdiff_t k, double least) const {
        const auto suffices = [&](double x) { return exact_.distance_at(edge, t, {k, x}) <= 0; };
        return least_double(least, std::numeric_limits<double>::infinity(), 1, 1, suffices);
    }

    // The first vertex from `from` to `last` that is not free, or last + 1.
    std::ptrdiff_t first_blocked_vertex(std::ptrdiff_t from, std::ptrdiff_t last, std::ptrdiff_t k,
                                        const Radius& radius) const {
        const auto is_free = [&](const double* box) {
            return radius.surely_holds(
                square_distance_across_box<Dim>(points_.point<Dim>(k), box, edges_.dim()));
        };
        const auto is_blocked = [&](std::ptrdiff_t i) { return !vertex_is_free(i, k, radius); };
        return first_where(from, last, is_free, is_blocked);
    }

    // The first vertex from `from` to `last` that is free, or last + 1.
    std::ptrdiff_t first_free_vertex(std::ptrdiff_t from, std::ptrdiff_t last, std::ptrdiff_t k,
                                     const Radius& radius) const {
        const auto is_free = [&](std::ptrdiff_t i) { return vertex_is_free(i, k, radius); };
        return first_where(from, last, blocked_box(k, radius), is_free);
    }

    // The first edge from `from` to `last` with a free point, or last + 1. Vertex `from` is not
    // free.
    std::ptrdiff_t first_free_edge(std::ptrdiff_t from, std::ptrdiff_t last, std::ptrdiff_t k,
                                   const Radius& radius) const {
        const auto is_free = [&](std::ptrdiff_t edge) {
            return vertex_is_free(edge + 1, k, radius) || inside_is_free(edge, k, radius);
        };
        return first_where(from, last, blocked_box(k, radius), is_free);
    }

    // Whether no edge has a free point. `near` is the edge where the search begins, and then one
    // that has a free point.
    bool is_blocked(std::ptrdiff_t k, const Radius& radius, std::ptrdiff_t& near) const {
        const std::ptrdiff_t edges = vertices() - 1, begin = near;
        if (vertex_is_free(begin, k, radius)) return false;
        near = first_free_edge(begin, edges - 1, k, radius);
        if (near < edges) return false;
        near = 0;
        if (vertex_is_free(0, k, radius)) return false;
        near = first_free_edge(0, begin - 1, k, radius);
        return near == begin;
    }

   private:
    // Where the line through an edge enters and leaves the reach of a point, middle -+ half.
    struct Roots {
        double middle, half, error;
    };

    static void place(Bound& bound, const Roots& roots, int side) noexcept {
        bound.t = roots.middle + side * roots.half;
        bound.error = roots.error;
    }

    // Whether the lower end of one reach is behind the lower end of another.
    bool is_later(std::ptrdiff_t edge, const Bound& one, const Bound& other) const {
        const double difference = one.t - other.t;
        const double error = one.error + other.error;
        if (difference > error) return true;
        if (difference < -error || is_same(one, other)) return false;
        return exact_.low_to_low(edge, reach_of(one), reach_of(other)) > 0;
    }

    // Whether the lower end of one reach comes before the upper end of another.
    bool is_in_order(std::ptrdiff_t edge, const Bound& low, const Bound& high,
                     const Radius& radius) const {
        const double difference = high.t - low.t;
        const double error = low.error + high.error;
        if (difference > error) return true;
        if (difference < -error) return false;
        if (is_same(low, high)) return true;
        return radius.holds(exact_.low_to_high(edge, reach_of(low), reach_of(high)));
    }

    // h = w - (u.w / u.u) u leads from the line to the point. If any of the edge is free, |w| <= r
    // + |u|. So r^2 - h.h has an error of at most 15 g (r + |u|)^2, and the middle one of at most 6
    // g (r + |u|) / |u|.
    Roots roots_of(std::ptrdiff_t edge, const Bound& bound) const noexcept {
        const double* const x = edges_.point<Dim>(edge);
        const double* const y = edges_.point<Dim>(edge + 1);
        const double* const z = points_.point<Dim>(bound.index);
        double uu = 0.0, uw = 0.0;
        for (std::ptrdiff_t c = 0; c < edges_.dim(); ++c) {
            const double u = y[c] - x[c];
            uu += u * u;
            uw += u * (z[c] - x[c]);
        }
        constexpr double infinity = std::numeric_limits<double>::infinity();
        // The square of so short an edge has no correct digits.
        if (uu < 0x1p-960) return {0.5, 0.0, infinity};
        const double inverse = 1.0 / uu;
        const double middle = uw * inverse;
        double hh = 0.0;
        for (std::ptrdiff_t c = 0; c < edges_.dim(); ++c) {
            const double h = (z[c] - x[c]) - middle * (y[c] - x[c]);
            hh += h * h;
        }
        const double radius = bound.scaled_radius;
        const double slack = Radius::slack_of(edges_.dim());
        const double margin = std::max(radius * radius - hh, 0.0);
        const double wrong = 8.0 * slack * (radius * radius + uu) + Radius::tiny_of(edges_.dim());
        const double half = std::sqrt(margin * inverse);
        const double half_error = margin > 2.0 * wrong
                                      ? half * (wrong / margin)
                                      : 2.0 * std::sqrt((wrong + margin) * inverse);
        return {middle, half, slack * (radius * std::sqrt(inverse) + 1.0) + half_error};
    }

    // Tells whether nothing in a box is within the radius of point k.
    auto blocked_box(std::ptrdiff_t k, const Radius& radius) const noexcept {
        return [this, k, &radius](const double* box) {
            return radius.surely_misses(
                square_distance_to_box<Dim>(points_.point<Dim>(k), box, edges_.dim()));
        };
    }

    static Reach reach_of(const Bound& bound) noexcept { return {bound.index, bound.radius}; }

    bool is_same(const Bound& one, const Bound& other) const noexcept {
        if (one.radius != other.radius) return false;
        return one.index == other.index || exact_.same_point(one.index, other.index);
    }

    // The first index from `from` to `last` for which `found` holds, or last + 1. If `passes` holds
    // for a run's box, no index of the run is found. Runs of any size are passed in O(log n) steps.
    template <class Passes, class Found>
    std::ptrdiff_t first_where(std::ptrdiff_t from, std::ptrdiff_t last, Passes passes,
                               Found found) const {
        constexpr std::ptrdiff_t leaf = BoxedCurve::leaf;
        std::ptrdiff_t at = from;
        const std::ptrdiff_t ragged = std::min((from + leaf - 1) / leaf * leaf, last + 1);
        for (; at < ragged; ++at) {
            if (found(at)) return at;
        }
        int level = 0;
        while (at <= last && at / leaf < edges_.boxes(0)) {
            const std::ptrdiff_t b = at / leaf;
            while ((b & ((std::ptrdiff_t{1} << level) - 1)) != 0) --level;
            while (level >= 0 && !passes(edges_.box<Dim>(level, b >> level))) --level;
            if (level >= 0) {
                at += leaf << level;
                level = std::min(level + 1, edges_.levels() - 1);
                continue;
            }
            level = 0;
            const std::ptrdiff_t end = std::min(at + leaf, last + 1);
            for (; at < end; ++at) {
                if (found(at)) return at;
            }
        }
        for (; at <= last; ++at) {
            if (found(at)) return at;
        }
        return last + 1;
    }

    const BoxedCurve& edges_;
    const BoxedCurve& points_;
    ExactSigns exact_;
};

}  // namespace curvewise::continuous
