// A curve in the form that the free-space diagram reads: its points next to each other, and a tree
// of boxes around runs of 8, 16, 32, ... edges. Construction takes O(n); memory is about 1.5 n
// points. A run that is far from a point, or wholly near it, is then passed in one step. Bringmann,
// Künnemann & Nusser (2019) recurse over boxes of the diagram for the same purpose.
//
// A single point is a curve with one edge of length zero. Inner loops take the number of
// coordinates, Dim, if it is known at compile time, or 0.
#pragma once

#include <algorithm>
#include <cstddef>

#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

using curves::RangeScale;
using runtime::Poller;

class BoxedCurve {
   public:
    // Edges in a box of level 0; a box of any other level holds two of the level below.
    static constexpr std::ptrdiff_t leaf = 8;

    BoxedCurve(const CurveView& curve, const RangeScale& range, Poller& poller);
    // Refers to the points of a curve, which are row-major and must outlive this, unless there is
    // only one.
    BoxedCurve(const double* points, const CurveView& curve, Poller& poller);

    BoxedCurve(const BoxedCurve&) = delete;
    BoxedCurve(BoxedCurve&&) noexcept = default;
    BoxedCurve& operator=(const BoxedCurve&) = delete;
    BoxedCurve& operator=(BoxedCurve&&) = delete;
    ~BoxedCurve() = default;

    // Points, at least two.
    std::ptrdiff_t size() const noexcept { return n_; }
    std::ptrdiff_t dim() const noexcept { return dim_; }

    template <int Dim>
    const double* point(std::ptrdiff_t i) const noexcept {
        return data_ + i * (Dim > 0 ? Dim : dim_);
    }
    int levels() const noexcept { return static_cast<int>(first_number_.size()) - 1; }
    // The box around the edges from leaf 2^level b on: its least corner, then its greatest.
    template <int Dim>
    const double* box(int level, std::ptrdiff_t b) const noexcept {
        return boxes_.data() + first_number_[static_cast<std::size_t>(level)] +
               2 * b * (Dim > 0 ? Dim : dim_);
    }
    std::ptrdiff_t boxes(int level) const noexcept {
        const auto place = static_cast<std::size_t>(level);
        return (first_number_[place + 1] - first_number_[place]) / (2 * dim_);
    }

   private:
    void copy(const CurveView& curve, const RangeScale& range, Poller& poller);
    void add_boxes(Poller& poller);
    template <int Dim>
    void fill_leaves(Poller& poller);
    void fill_level(int level, Poller& poller);
    // Makes the box whose least corner is at `low` that of a point.
    void put_box_around(const double* x, double* low) const noexcept;
    // Grows the box whose least corner is at `low` to hold another.
    void grow(double* low, const double* least, const double* greatest) const noexcept;

    std::ptrdiff_t n_;
    std::ptrdiff_t dim_;
    runtime::ScratchVector<double> points_;  // none where these are another's
    const double* data_;
    runtime::ScratchVector<double> boxes_;                 // level by level
    runtime::ScratchVector<std::ptrdiff_t> first_number_;  // of each level, and the end of all
};

// The squares of distances, as rounded sums of rounded squares.
template <int Dim>
double square_distance(const double* x, const double* y, std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < (Dim > 0 ? Dim : dim); ++c) {
        const double delta = x[c] - y[c];
        sum += delta * delta;
    }
    return sum;
}

// From x to the nearest point of a box.
template <int Dim>
double square_distance_to_box(const double* x, const double* box, std::ptrdiff_t dim) noexcept {
    const std::ptrdiff_t d = Dim > 0 ? Dim : dim;
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < d; ++c) {
        const double delta = std::max(std::max(box[c] - x[c], x[c] - box[d + c]), 0.0);
        sum += delta * delta;
    }
    return sum;
}

// From x to the furthest point of a box.
template <int Dim>
double square_distance_across_box(const double* x, const double* box, std::ptrdiff_t dim) noexcept {
    const std::ptrdiff_t d = Dim > 0 ? Dim : dim;
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < d; ++c) {
        const double delta = std::max(x[c] - box[c], box[d + c] - x[c]);
        sum += delta * delta;
    }
    return sum;
}

}  // namespace curvewise::continuous
