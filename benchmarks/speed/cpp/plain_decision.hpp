// A yardstick for frechet_within: the decision of Alt & Godau (1995) in plain doubles, with the
// filters and the recursion over boxes of Bringmann, Künnemann & Nusser (2019), written from their
// papers. It is not exact: every comparison takes the rounded numbers. Boxes of the diagram are
// bounded by the distance of their middle vertices and by arc lengths, as in the paper.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace plain {

template <int Dim>
class Curve {
   public:
    Curve(const double* points, std::ptrdiff_t n) : x_(points, points + n * Dim), length_(1, 0.0) {
        for (std::ptrdiff_t i = 1; i < n; ++i) {
            length_.push_back(length_.back() + distance(point(i - 1), point(i)));
        }
    }
    std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(length_.size()); }
    const double* point(std::ptrdiff_t i) const { return x_.data() + i * Dim; }
    // No point of vertices i to k is further from vertex (i + k) / 2.
    double reach(std::ptrdiff_t i, std::ptrdiff_t k) const {
        const double middle = at((i + k) / 2);
        return std::max(middle - at(i), at(k) - middle);
    }
    static double distance(const double* x, const double* y) {
        double sum = 0.0;
        for (int c = 0; c < Dim; ++c) sum += (x[c] - y[c]) * (x[c] - y[c]);
        return std::sqrt(sum);
    }

   private:
    double at(std::ptrdiff_t i) const { return length_[static_cast<std::size_t>(i)]; }
    std::vector<double> x_;
    std::vector<double> length_;  // up to each vertex
};

template <int Dim>
class Decision {
   public:
    Decision(const Curve<Dim>& p, const Curve<Dim>& q, double radius)
        : p_(p), q_(q), radius_(radius), rows_(p.size() - 1), columns_(q.size() - 1) {}

    bool is_within() {
        if (between(0, 0) > radius_ || between(rows_, columns_) > radius_) return false;
        std::ptrdiff_t i = 0, j = 0;
        if (walk(i, j)) return true;
        if (is_alone(p_, i, q_) || is_alone(q_, j, p_)) return false;
        return has_path();
    }

   private:
    struct Interval {
        double low, high;
    };
    using Intervals = std::vector<Interval>;
    struct Box {
        std::ptrdiff_t i0, i1, j0, j1;
    };
    struct Halves {
        Intervals first, second, between;
    };

    double between(std::ptrdiff_t i, std::ptrdiff_t j) const {
        return Curve<Dim>::distance(p_.point(i), q_.point(j));
    }

    // The greedy walk, with steps that double while whole boxes are free.
    bool walk(std::ptrdiff_t& i, std::ptrdiff_t& j) const {
        std::ptrdiff_t step = 1;
        while (i < rows_ || j < columns_) {
            const std::ptrdiff_t k = std::min(i + step, rows_), l = std::min(j + step, columns_);
            if (step > 1) {
                const bool is_free =
                    between((i + k) / 2, (j + l) / 2) + p_.reach(i, k) + q_.reach(j, l) <= radius_;
                if (is_free) i = k, j = l;
                step = is_free ? 2 * step : step / 2;
                continue;
            }
            const double both = between(k, l);
            const double up = k > i ? between(k, j) : INFINITY;
            const double right = l > j ? between(i, l) : INFINITY;
            const double least = std::min(std::min(up, right), both);
            if (least > radius_) return false;
            if (least == both || least == up) i = k;
            if (least == both || least != up) j = l;
            step = 2;
        }
        return true;
    }

    // Whether a vertex from `from` on, in steps that double, is far from the whole other curve.
    bool is_alone(const Curve<Dim>& curve, std::ptrdiff_t from, const Curve<Dim>& other) const {
        for (std::ptrdiff_t step = 1; from + step - 1 < curve.size(); step *= 2) {
            if (is_far(curve.point(from + step - 1), other)) return true;
        }
        return false;
    }
    bool is_far(const double* z, const Curve<Dim>& curve) const {
        const std::ptrdiff_t last = curve.size() - 1;
        std::ptrdiff_t step = 1;
        for (std::ptrdiff_t k = 0; k < last;) {
            const std::ptrdiff_t end = std::min(k + step, last);
            if (step == 1) {
                const Interval part = free_part(curve, k, z);
                if (part.low <= part.high) return false;
                k = end;
                step = 2;
            } else if (Curve<Dim>::distance(z, curve.point((k + end) / 2)) - curve.reach(k, end) >
                       radius_) {
                k = end;
                step *= 2;
            } else {
                step /= 2;
            }
        }
        return true;
    }

    // The free part of an edge, in units of its curve's vertices.
    Interval free_part(const Curve<Dim>& curve, std::ptrdiff_t edge, const double* z) const {
        const double* const x = curve.point(edge);
        const double* const y = curve.point(edge + 1);
        double uu = 0.0, uw = 0.0, ww = 0.0;
        for (int c = 0; c < Dim; ++c) {
            const double u = y[c] - x[c], w = z[c] - x[c];
            uu += u * u, uw += u * w, ww += w * w;
        }
        const double margin = uw * uw - uu * (ww - radius_ * radius_);
        const Interval nothing{1.0, 0.0};
        if (margin < 0.0) return nothing;
        if (uu == 0.0) return ww > radius_ * radius_ ? nothing : whole(edge, edge + 1);
        const double root = std::sqrt(margin);
        const double low = std::max((uw - root) / uu, 0.0), high = std::min((uw + root) / uu, 1.0);
        if (low > high) return nothing;
        return {static_cast<double>(edge) + low, static_cast<double>(edge) + high};
    }
    static Interval whole(std::ptrdiff_t from, std::ptrdiff_t to) {
        return {static_cast<double>(from), static_cast<double>(to)};
    }

    // Whether a path leads through the diagram.
    bool has_path() {
        Intervals left, bottom, right, top;
        grow_along(p_, q_.point(0), left);
        grow_along(q_, p_.point(0), bottom);
        pass({0, rows_, 0, columns_}, left, bottom, right, top, 0);
        return !top.empty() && top.back().high == static_cast<double>(columns_);
    }
    void grow_along(const Curve<Dim>& curve, const double* z, Intervals& reached) const {
        for (std::ptrdiff_t k = 0; k + 1 < curve.size(); ++k) {
            const Interval part = free_part(curve, k, z);
            if (part.low > part.high || part.low != static_cast<double>(k)) return;
            append(part, reached);
            if (part.high != static_cast<double>(k + 1)) return;
        }
    }
    static void append(const Interval& part, Intervals& to) {
        if (part.low > part.high) return;
        if (!to.empty() && to.back().high == part.low) {
            to.back().high = part.high;
        } else {
            to.push_back(part);
        }
    }

    // Appends what is reached of the right and upper sides of a box to `right` and `top`.
    void pass(const Box& b, const Intervals& left, const Intervals& bottom, Intervals& right,
              Intervals& top, std::size_t depth) {
        if (left.empty() && bottom.empty()) return;
        const double middle = between((b.i0 + b.i1) / 2, (b.j0 + b.j1) / 2);
        const double reach = p_.reach(b.i0, b.i1) + q_.reach(b.j0, b.j1);
        if (middle - reach > radius_) return;
        const bool is_cell = b.i1 - b.i0 == 1 && b.j1 - b.j0 == 1;
        if (is_cell || middle + reach <= radius_) {
            Interval up = is_cell ? free_part(p_, b.i0, q_.point(b.j1)) : whole(b.i0, b.i1);
            Interval along = is_cell ? free_part(q_, b.j0, p_.point(b.i1)) : whole(b.j0, b.j1);
            if (bottom.empty()) up.low = std::max(up.low, left.front().low);
            if (left.empty()) along.low = std::max(along.low, bottom.front().low);
            append(up, right);
            append(along, top);
            return;
        }
        if (is_shut(p_, b.i0, b.i1, q_.point(b.j1)) && is_shut(q_, b.j0, b.j1, p_.point(b.i1))) {
            return;
        }
        split(b, left, bottom, right, top, depth);
    }
    // Whether a side is surely blocked, by one bound.
    bool is_shut(const Curve<Dim>& curve, std::ptrdiff_t from, std::ptrdiff_t to,
                 const double* z) const {
        return Curve<Dim>::distance(z, curve.point((from + to) / 2)) - curve.reach(from, to) >
               radius_;
    }
    void split(const Box& b, const Intervals& left, const Intervals& bottom, Intervals& right,
               Intervals& top, std::size_t depth) {
        if (halves_.size() <= depth) halves_.resize(depth + 32);
        Halves& halves = halves_[depth];
        halves.between.clear();
        if (b.i1 - b.i0 >= b.j1 - b.j0) {
            const std::ptrdiff_t middle = (b.i0 + b.i1) / 2;
            cut(left, middle, halves);
            pass({b.i0, middle, b.j0, b.j1}, halves.first, bottom, right, halves.between,
                 depth + 1);
            pass({middle, b.i1, b.j0, b.j1}, halves_[depth].second, halves_[depth].between, right,
                 top, depth + 1);
        } else {
            const std::ptrdiff_t middle = (b.j0 + b.j1) / 2;
            cut(bottom, middle, halves);
            pass({b.i0, b.i1, b.j0, middle}, left, halves.first, halves.between, top, depth + 1);
            pass({b.i0, b.i1, middle, b.j1}, halves_[depth].between, halves_[depth].second, right,
                 top, depth + 1);
        }
    }
    static void cut(const Intervals& all, std::ptrdiff_t place, Halves& halves) {
        const auto middle = static_cast<double>(place);
        halves.first.clear();
        halves.second.clear();
        for (const Interval& part : all) {
            if (part.low <= middle) {
                halves.first.push_back({part.low, std::min(part.high, middle)});
            }
            if (part.high >= middle) {
                halves.second.push_back({std::max(part.low, middle), part.high});
            }
        }
    }

    const Curve<Dim>& p_;
    const Curve<Dim>& q_;
    double radius_;
    std::ptrdiff_t rows_, columns_;  // edges
    std::vector<Halves> halves_;     // by depth
};

// Whether two curves of n and m points, row by row, are within a distance. Prepared from scratch.
template <int Dim>
bool is_within(const double* p, std::ptrdiff_t n, const double* q, std::ptrdiff_t m,
               double radius) {
    const Curve<Dim> first(p, n), second(q, m);
    return Decision<Dim>(first, second, radius).is_within();
}

}  // namespace plain
