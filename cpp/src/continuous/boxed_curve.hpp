// A curve as the free-space diagram reads it: its points side by side, scaled into the safe range,
// and a tree of boxes around runs of 8, 16, 32, ... edges. Built in O(n), memory about 1.5 n points.
// A run far from a point, or wholly near it, is then passed in one step: Bringmann, Künnemann &
// Nusser (2019) recurse over boxes of the diagram for the same end.
//
// Dim is the number of coordinates where it is known when this is compiled, or 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "checks.hpp"
#include "curvewise/curve.hpp"

namespace curvewise::detail {

template <int Dim>
class BoxedCurve {
   public:
    // Edges in a box of the lowest level.
    static constexpr int leaf_bits = 3;
    static constexpr std::ptrdiff_t leaf = std::ptrdiff_t{1} << leaf_bits;

    // At least two points.
    BoxedCurve(const CurveView& curve, const RangeScale& range)
        : n_(curve.size()), dim_(static_cast<int>(curve.dim())) {
        points_.reserve(static_cast<std::size_t>(n_ * dim()));
        for (std::ptrdiff_t i = 0; i < n_; ++i) {
            for (int c = 0; c < dim(); ++c) points_.push_back(range.shrink(curve(i, c)));
        }
        add_leaves();
        while (levels_.back().size() > box_size()) add_level();
    }

    std::ptrdiff_t size() const noexcept { return n_; }
    int dim() const noexcept {
        if constexpr (Dim > 0) return Dim;
        return dim_;
    }
    const double* point(std::ptrdiff_t i) const noexcept { return points_.data() + i * dim(); }

    // Level 0 has the leaves; each box of a level holds two of the level below.
    int levels() const noexcept { return static_cast<int>(levels_.size()); }
    // The box around edges b * 2^(leaf_bits + level) and on: its least corner, then its greatest.
    const double* box(int level, std::ptrdiff_t b) const noexcept {
        return levels_[static_cast<std::size_t>(level)].data() + 2 * b * dim();
    }
    std::ptrdiff_t boxes(int level) const noexcept {
        const std::size_t all = levels_[static_cast<std::size_t>(level)].size();
        return static_cast<std::ptrdiff_t>(all / box_size());
    }

   private:
    using Boxes = std::vector<double>;

    std::size_t box_size() const noexcept { return static_cast<std::size_t>(2 * dim()); }

    void add_leaves() {
        Boxes boxes;
        for (std::ptrdiff_t first = 0; first < n_ - 1; first += leaf) {
            const double* const x = point(first);
            boxes.insert(boxes.end(), x, x + dim());
            boxes.insert(boxes.end(), x, x + dim());
            double* const low = boxes.data() + boxes.size() - box_size();
            for (std::ptrdiff_t i = first + 1; i <= std::min(first + leaf, n_ - 1); ++i) {
                grow(low, point(i), point(i));
            }
        }
        levels_.push_back(std::move(boxes));
    }

    void add_level() {
        const Boxes& below = levels_.back();
        Boxes boxes;
        boxes.reserve(below.size() / 2 + box_size());
        for (std::size_t at = 0; at < below.size(); at += 2 * box_size()) {
            const double* const one = below.data() + at;
            boxes.insert(boxes.end(), one, one + box_size());
            if (at + box_size() == below.size()) break;
            const double* const other = one + box_size();
            grow(boxes.data() + boxes.size() - box_size(), other, other + dim());
        }
        levels_.push_back(std::move(boxes));
    }

    // Grows the box whose least corner is at `low` to hold another, or a point.
    void grow(double* low, const double* least, const double* greatest) const noexcept {
        double* const high = low + dim();
        for (int c = 0; c < dim(); ++c) {
            low[c] = std::min(low[c], least[c]);
            high[c] = std::max(high[c], greatest[c]);
        }
    }

    std::ptrdiff_t n_;
    int dim_;
    std::vector<double> points_;
    std::vector<Boxes> levels_;
};

// The squares of distances, as rounded sums of rounded squares.
template <int Dim>
double square_distance(const double* x, const double* y, int dim) noexcept {
    double sum = 0.0;
    for (int c = 0; c < (Dim > 0 ? Dim : dim); ++c) {
        const double delta = x[c] - y[c];
        sum += delta * delta;
    }
    return sum;
}

// From x to the nearest point of a box.
template <int Dim>
double square_distance_to_box(const double* x, const double* box, int dim) noexcept {
    const int d = Dim > 0 ? Dim : dim;
    double sum = 0.0;
    for (int c = 0; c < d; ++c) {
        const double delta = std::max(std::max(box[c] - x[c], x[c] - box[d + c]), 0.0);
        sum += delta * delta;
    }
    return sum;
}

// From x to the furthest point of a box.
template <int Dim>
double square_distance_across_box(const double* x, const double* box, int dim) noexcept {
    const int d = Dim > 0 ? Dim : dim;
    double sum = 0.0;
    for (int c = 0; c < d; ++c) {
        const double delta = std::max(x[c] - box[c], box[d + c] - x[c]);
        sum += delta * delta;
    }
    return sum;
}

}  // namespace curvewise::detail
