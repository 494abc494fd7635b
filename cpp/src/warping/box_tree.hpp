// Boxes over the runs of points of a curve, as an implicit binary tree. A box of level 0 holds
// `leaf_points` consecutive points, a box of level k two boxes of level k - 1. Construction takes
// O(n d) time and n d / 2 doubles. The smallest and largest ground distance between two boxes bound
// the distances of all their points. They are computed by the operations of the kernels
// (kernels/metrics.inl.hpp). Each operation is monotone in floating point, too, so a bound holds
// exactly, without slack. Ground distances that are not such norms have no bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

// The points of a packed curve by their numbers, whichever way round it is stored.
class PointAccess {
   public:
    PointAccess(const PackedCurve& curve, PointOrder order) noexcept
        : first_(curve.data() + (order == PointOrder::reversed ? curve.size() - 1 : 0)),
          stride_(curve.stride()),
          step_(order == PointOrder::reversed ? -1 : 1) {}
    double operator()(std::ptrdiff_t point, std::ptrdiff_t coordinate) const noexcept {
        return first_[coordinate * stride_ + point * step_];
    }
    // A coordinate of `count` points from `point` on, in the order in which they are stored.
    const double* span(std::ptrdiff_t point, std::ptrdiff_t count,
                       std::ptrdiff_t coordinate) const noexcept {
        return first_ + coordinate * stride_ + (step_ > 0 ? point : 1 - point - count);
    }

   private:
    const double* first_;
    std::ptrdiff_t stride_;
    std::ptrdiff_t step_;
};

class BoxTree {
   public:
    static constexpr std::ptrdiff_t leaf_points = 8;

    BoxTree(const PackedCurve& curve, PointOrder order);

    std::ptrdiff_t size() const noexcept { return size_; }  // points
    std::ptrdiff_t dim() const noexcept { return dim_; }
    const PointAccess& points() const noexcept { return points_; }

    // The last level is a single box.
    std::ptrdiff_t levels() const noexcept {
        return static_cast<std::ptrdiff_t>(first_box_.size()) - 1;
    }
    std::ptrdiff_t boxes(std::ptrdiff_t level) const noexcept {
        const auto k = static_cast<std::size_t>(level);
        return first_box_[k + 1] - first_box_[k];
    }
    // Box `index` of a level holds the points from index << (level + 3) on: its lowest coordinates,
    // then its highest.
    const double* box(std::ptrdiff_t level, std::ptrdiff_t index) const noexcept {
        return bounds_.data() + (first_box_[static_cast<std::size_t>(level)] + index) * 2 * dim_;
    }

   private:
    void enclose_points(std::ptrdiff_t box) noexcept;
    void enclose_boxes(std::ptrdiff_t level, std::ptrdiff_t box) noexcept;

    PointAccess points_;
    std::ptrdiff_t size_;
    std::ptrdiff_t dim_;
    runtime::ScratchVector<std::ptrdiff_t> first_box_;  // of every level, and the number of all
    AlignedBuffer bounds_;
};

// No two points of the boxes are closer, in the norm's ground distance.
template <class Norm>
double smallest_distance(const double* a, const double* b, std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        sum = Norm::add(sum, std::max(std::max(a[c] - b[dim + c], b[c] - a[dim + c]), 0.0));
    }
    return Norm::finish(sum);
}

// No two are further apart.
template <class Norm>
double largest_distance(const double* a, const double* b, std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        sum = Norm::add(sum, std::max(a[dim + c] - b[c], b[dim + c] - a[c]));
    }
    return Norm::finish(sum);
}

template <class Norm>
double point_distance(const PointAccess& a, std::ptrdiff_t i, const PointAccess& b,
                      std::ptrdiff_t j, std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) sum = Norm::add(sum, a(i, c) - b(j, c));
    return Norm::finish(sum);
}

struct Nearest {
    double distance;
    std::ptrdiff_t point;
};

// The point of a curve that is nearest to a point of another. The search starts at a given point
// and climbs from there, so it is short if that point is near.
template <class Norm>
class NearestSearch {
   public:
    NearestSearch(const PointAccess& from, const BoxTree& tree) noexcept
        : from_(from), tree_(tree) {}

    // Searches from point i, starting at point `start` of the tree. Ends at the first point whose
    // distance is at most `enough`, which need not be the nearest.
    Nearest operator()(std::ptrdiff_t i, std::ptrdiff_t start, double enough) noexcept {
        const std::ptrdiff_t dim = tree_.dim();
        i_ = i;
        enough_ = enough;
        best_ = {point_distance<Norm>(from_, i, tree_.points(), start, dim), start};
        std::ptrdiff_t box = start / BoxTree::leaf_points;
        if (best_.distance <= enough_) return best_;
        look_at_points(box);
        for (std::ptrdiff_t level = 0; level + 1 < tree_.levels(); ++level, box /= 2) {
            if (best_.distance <= enough_) break;
            const std::ptrdiff_t sibling = box ^ 1;
            ++boxes_;
            if (sibling < tree_.boxes(level)) descend(level, sibling, distance_to(level, sibling));
        }
        return best_;
    }

    // The number of boxes that all searches have tested, a measure of their time.
    std::int64_t boxes() const noexcept { return boxes_; }

   private:
    double distance_to(std::ptrdiff_t level, std::ptrdiff_t box) const noexcept {
        const double* const bounds = tree_.box(level, box);
        const std::ptrdiff_t dim = tree_.dim();
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            const double x = from_(i_, c);
            sum = Norm::add(sum, std::max(std::max(bounds[c] - x, x - bounds[dim + c]), 0.0));
        }
        return Norm::finish(sum);
    }

    void descend(std::ptrdiff_t level, std::ptrdiff_t box, double distance) noexcept {
        if (!(distance < best_.distance) || best_.distance <= enough_) return;
        boxes_ += 2;
        if (level == 0) return look_at_points(box);
        std::ptrdiff_t near = 2 * box, far = near + 1;
        double to_near = distance_to(level - 1, near);
        if (far == tree_.boxes(level - 1)) return descend(level - 1, near, to_near);
        double to_far = distance_to(level - 1, far);
        if (to_far < to_near) {
            std::swap(near, far);
            std::swap(to_near, to_far);
        }
        descend(level - 1, near, to_near);
        descend(level - 1, far, to_far);
    }

    void look_at_points(std::ptrdiff_t box) noexcept {
        const std::ptrdiff_t first = box * BoxTree::leaf_points;
        const std::ptrdiff_t end = std::min(first + BoxTree::leaf_points, tree_.size());
        for (std::ptrdiff_t j = first; j < end; ++j) {
            const double d = point_distance<Norm>(from_, i_, tree_.points(), j, tree_.dim());
            if (d < best_.distance) best_ = {d, j};
        }
    }

    PointAccess from_;
    const BoxTree& tree_;
    std::ptrdiff_t i_ = 0;
    double enough_ = 0.0;
    Nearest best_{};
    std::int64_t boxes_ = 0;
};

// The distance of every point of a curve of `count` points to the nearest point of the tree:
// exactly the smallest entry of each row (or column) of the table of ground distances. Each search
// starts from the last one's result. Throws Stopped if the poller stops the call; counts no work as
// done.
void nearest_distances(const PointAccess& from, std::ptrdiff_t count, const BoxTree& tree,
                       Metric metric, Poller& poller, double* distances);

}  // namespace curvewise::warping
