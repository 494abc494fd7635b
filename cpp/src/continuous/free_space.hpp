// The free-space diagram of two curves (Alt & Godau 1995) at one radius: which points of the edges
// of one curve lie within it of a vertex of the other. Answers are exact. Each is first sought in
// plain doubles with a bound on their error, and where that bound leaves it open, in whole numbers
// (exact_signs.hpp).
//
// Error bounds. With eps = 2^-53, a difference of two coordinates is right to eps relatively,
// however large both are, so that nothing is lost far from the origin; a sum of d products to
// (d + 4) eps of the sum of magnitudes. `slack` below is eight times that. Underflow adds at most
// 2^-1074 a product: `tiny`.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "checks.hpp"
#include "continuous/boxed_curve.hpp"
#include "continuous/exact_signs.hpp"
#include "curvewise/curve.hpp"

namespace curvewise::detail {

// Whether a point at the very radius is free. Open: whether the distance is below the radius;
// closed: whether it is at most the radius.
enum class FreeSet { closed, open };

// A radius with what the filters need of it, in units of the scaled curves.
class Radius {
   public:
    Radius(double given, double scaled, int dim, FreeSet set) noexcept
        : given_(given),
          scaled_(scaled),
          square_(scaled * scaled),
          slack_(8 * (dim + 4) * 0x1p-53),
          tiny_(dim * 0x1p-1066),
          set_(set) {}

    double given() const noexcept { return given_; }
    double scaled() const noexcept { return scaled_; }
    double square() const noexcept { return square_; }
    double slack() const noexcept { return slack_; }
    double tiny() const noexcept { return tiny_; }
    // Of a rounded square of a distance.
    bool surely_holds(double square) const noexcept {
        return square <= square_ * (1.0 - slack_) - tiny_;
    }
    bool surely_misses(double square) const noexcept {
        return square > square_ * (1.0 + slack_) + tiny_;
    }
    // From the exact sign of a distance minus the radius.
    bool holds(int sign) const noexcept { return set_ == FreeSet::closed ? sign <= 0 : sign < 0; }

   private:
    double given_, scaled_, square_, slack_, tiny_;
    FreeSet set_;
};

// An end of an interval on an edge: the edge's own end, or where it enters or leaves the reach of a
// vertex. `t` is right to within `error`.
struct Bound {
    double t = 0.0;
    double error = 0.0;
    Reach of{-1, 0.0};

    bool at_vertex() const noexcept { return of.index < 0; }
};

// What of an edge is free: everything from low to high, or nothing.
struct FreePart {
    bool empty = true;
    Bound low;
    Bound high;
};

// The edges of one curve as seen from the vertices of the other.
template <int Dim>
class EdgeFamily {
   public:
    EdgeFamily(const BoxedCurve<Dim>& edges, const BoxedCurve<Dim>& points, const ExactSigns& exact)
        : edges_(edges), points_(points), exact_(exact) {}

    std::ptrdiff_t vertices() const noexcept { return edges_.size(); }

    // Whether a vertex is within the radius of point k of the other curve.
    bool vertex_is_free(std::ptrdiff_t vertex, std::ptrdiff_t k, const Radius& radius) const {
        const double square =
            square_distance<Dim>(edges_.point(vertex), points_.point(k), edges_.dim());
        if (radius.surely_holds(square)) return true;
        if (radius.surely_misses(square)) return false;
        return radius.holds(exact_.distance(vertex, {k, radius.given()}));
    }

    // The free part of an edge, of whose ends it is known whether they are free.
    FreePart free_part(std::ptrdiff_t edge, std::ptrdiff_t k, bool first_is_free,
                       bool second_is_free, const Radius& radius) const {
        FreePart part;
        const Bound second_vertex{1.0, 0.0, {-1, 0.0}};
        if (first_is_free && second_is_free) return {false, {}, second_vertex};
        const Roots roots = roots_of(edge, k, radius);
        if (!first_is_free && !second_is_free && !roots.open_inside(*this, edge, k, radius)) {
            return part;
        }
        const Reach reach{k, radius.given()};
        part.empty = false;
        if (!first_is_free) part.low = roots.low(reach);
        part.high = second_is_free ? second_vertex : roots.high(reach);
        return part;
    }

    // The same question for an edge of which neither end is free.
    bool inside_is_free(std::ptrdiff_t edge, std::ptrdiff_t k, const Radius& radius) const {
        return !is_beside(edge, k, radius) &&
               roots_of(edge, k, radius).open_inside(*this, edge, k, radius);
    }

    // The greater of two lower bounds.
    const Bound& later(std::ptrdiff_t edge, const Bound& one, const Bound& other) const {
        if (one.at_vertex()) return other;
        if (other.at_vertex()) return one;
        const double difference = one.t - other.t;
        const double error = one.error + other.error;
        if (difference > error) return one;
        if (difference < -error || same_reach(one.of, other.of)) return other;
        return exact_.low_to_low(edge, one.of, other.of) > 0 ? one : other;
    }

    // Whether anything of the edge lies between a lower and an upper bound.
    bool in_order(std::ptrdiff_t edge, const Bound& low, const Bound& high,
                  const Radius& radius) const {
        if (low.at_vertex() || high.at_vertex()) return true;
        const double difference = high.t - low.t;
        const double error = low.error + high.error;
        if (difference > error) return true;
        if (difference < -error) return false;
        if (same_reach(low.of, high.of)) return true;
        return radius.holds(exact_.low_to_high(edge, low.of, high.of));
    }

    // The first vertex from `from` to `last` that is not free, or last + 1.
    std::ptrdiff_t first_blocked_vertex(std::ptrdiff_t from, std::ptrdiff_t last, std::ptrdiff_t k,
                                        const Radius& radius) const {
        const auto free_box = [&](const double* box) {
            return radius.surely_holds(
                square_distance_across_box<Dim>(points_.point(k), box, edges_.dim()));
        };
        const auto blocked = [&](std::ptrdiff_t i) { return !vertex_is_free(i, k, radius); };
        return first_where(from, last, free_box, blocked);
    }

    // The first edge from `from` to `last` with a free point, or last + 1. Vertex `from` is not
    // free.
    std::ptrdiff_t first_free_edge(std::ptrdiff_t from, std::ptrdiff_t last, std::ptrdiff_t k,
                                   const Radius& radius) const {
        const auto blocked_box = [&](const double* box) {
            return radius.surely_misses(
                square_distance_to_box<Dim>(points_.point(k), box, edges_.dim()));
        };
        const auto is_free = [&](std::ptrdiff_t edge) {
            return vertex_is_free(edge + 1, k, radius) || inside_is_free(edge, k, radius);
        };
        return first_where(from, last, blocked_box, is_free);
    }

   private:
    // Where the line through an edge enters and leaves the reach of a point, t = middle -+ half.
    struct Roots {
        double middle;     // A / D
        double half;       // sqrt(margin / D), 0 where that is negative
        double margin;     // r^2 minus the square of the distance from the point to the line
        double threshold;  // how wrong the margin may be
        double error;      // of either root

        // Whether a piece of the inside is free, where neither end is. A margin beyond the
        // threshold puts the ends so far from the middle that its sides are right, too.
        bool open_inside(const EdgeFamily& family, std::ptrdiff_t edge, std::ptrdiff_t k,
                         const Radius& radius) const {
            if (margin < -threshold) return false;
            if (margin > threshold) return middle > 0.0 && middle < 1.0;
            return radius.holds(family.exact_.inside(edge, {k, radius.given()}));
        }
        Bound low(const Reach& of) const noexcept { return {clamped(middle - half), error, of}; }
        Bound high(const Reach& of) const noexcept { return {clamped(middle + half), error, of}; }
        static double clamped(double t) noexcept { return std::min(std::max(t, 0.0), 1.0); }
    };

    // Whether a point surely lies before the first or behind the second end of an edge, so that
    // one of them is the nearest to it.
    bool is_beside(std::ptrdiff_t edge, std::ptrdiff_t k, const Radius& radius) const noexcept {
        const double* const x = edges_.point(edge);
        const double* const y = edges_.point(edge + 1);
        const double* const z = points_.point(k);
        double uu = 0.0, uw = 0.0, ww = 0.0;
        for (int c = 0; c < edges_.dim(); ++c) {
            const double u = y[c] - x[c], w = z[c] - x[c];
            uu += u * u;
            uw += u * w;
            ww += w * w;
        }
        const double error = radius.slack() * (uu + ww) + radius.tiny();
        return uw < -error || uw > uu + error;
    }

    // With w = Z - X and h the distance of Z to the line: |w| <= r + |u| where any of the edge is
    // free, the middle is right to slack |w| / |u|, h^2 to slack |w|^2.
    Roots roots_of(std::ptrdiff_t edge, std::ptrdiff_t k, const Radius& radius) const noexcept {
        const double* const x = edges_.point(edge);
        const double* const y = edges_.point(edge + 1);
        const double* const z = points_.point(k);
        double uu = 0.0, uw = 0.0;
        for (int c = 0; c < edges_.dim(); ++c) {
            const double u = y[c] - x[c];
            uu += u * u;
            uw += u * (z[c] - x[c]);
        }
        if (uu < 0x1p-960) {  // nothing is left of its square: only exact numbers can tell
            constexpr double infinity = std::numeric_limits<double>::infinity();
            return {0.5, 0.0, 0.0, infinity, infinity};
        }
        const double middle = uw / uu;
        double hh = 0.0;
        for (int c = 0; c < edges_.dim(); ++c) {
            const double h = (z[c] - x[c]) - middle * (y[c] - x[c]);
            hh += h * h;
        }
        const double length = std::sqrt(uu);
        const double margin = radius.square() - hh;
        const double span = radius.scaled() + length;
        const double threshold = 4.0 * radius.slack() * span * span + radius.tiny();
        const double half = std::sqrt(std::max(margin, 0.0)) / length;
        const double middle_error = radius.slack() * span / length;
        const double half_error = margin > 2.0 * threshold
                                      ? half * (threshold / margin)
                                      : 2.0 * std::sqrt(threshold + std::max(margin, 0.0)) / length;
        return {middle, half, margin, threshold, middle_error + half_error};
    }

    bool same_reach(const Reach& one, const Reach& other) const noexcept {
        if (one.radius != other.radius) return false;
        if (one.index == other.index) return true;
        // The scaled points may be equal where the given ones are not: those are few, and tiny.
        return exact_.same_point(one.index, other.index);
    }

    // The first index from `from` to `last` where `found` holds, or last + 1, where no index of a
    // run whose box `passes` is one. Runs of any size are passed in O(log n) steps.
    template <class Passes, class Found>
    std::ptrdiff_t first_where(std::ptrdiff_t from, std::ptrdiff_t last, Passes passes,
                               Found found) const {
        constexpr std::ptrdiff_t leaf = BoxedCurve<Dim>::leaf;
        std::ptrdiff_t at = from;
        int level = 0;
        while (at <= last) {
            const std::ptrdiff_t leaf_index = at / leaf;
            if (at % leaf != 0 || leaf_index >= edges_.boxes(0)) {
                if (found(at)) return at;
                ++at;
                continue;
            }
            while ((leaf_index & ((std::ptrdiff_t{1} << level) - 1)) != 0) --level;
            while (level >= 0 && !passes(edges_.box(level, leaf_index >> level))) --level;
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
        return last + 1;
    }

    const BoxedCurve<Dim>& edges_;
    const BoxedCurve<Dim>& points_;
    ExactSigns exact_;
};

}  // namespace curvewise::detail
