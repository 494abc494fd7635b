#include "warping/box_tree.hpp"

#include <utility>

namespace curvewise::warping {
namespace {

// The smallest and the largest, in three steps of independent comparisons.
std::pair<double, double> range_of_eight(const double* x) noexcept {
    static_assert(BoxTree::leaf_points == 8);
    double low[4], high[4];
    for (int k = 0; k < 4; ++k) {
        low[k] = std::min(x[k], x[k + 4]);
        high[k] = std::max(x[k], x[k + 4]);
    }
    return {std::min(std::min(low[0], low[2]), std::min(low[1], low[3])),
            std::max(std::max(high[0], high[2]), std::max(high[1], high[3]))};
}

}  // namespace

BoxTree::BoxTree(const PackedCurve& curve, PointOrder order)
    : points_(curve, order), size_(curve.size()), dim_(curve.dim()) {
    std::ptrdiff_t boxes = (size_ + leaf_points - 1) / leaf_points;
    first_box_ = {0, boxes};
    while (boxes > 1) {
        boxes = (boxes + 1) / 2;
        first_box_.push_back(first_box_.back() + boxes);
    }
    bounds_.reserve(first_box_.back() * 2 * dim_);
    for (std::ptrdiff_t b = 0; b < first_box_[1]; ++b) enclose_points(b);
    for (std::ptrdiff_t level = 1; level < levels(); ++level) {
        for (std::ptrdiff_t b = 0; b < this->boxes(level); ++b) enclose_boxes(level, b);
    }
}

void BoxTree::enclose_points(std::ptrdiff_t box) noexcept {
    double* const low = bounds_.data() + box * 2 * dim_;
    double* const high = low + dim_;
    const std::ptrdiff_t first = box * leaf_points;
    const std::ptrdiff_t count = std::min(leaf_points, size_ - first);
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        const double* const x = points_.span(first, count, c);
        if (count == leaf_points) {
            const auto [lowest, highest] = range_of_eight(x);
            low[c] = lowest;
            high[c] = highest;
        } else {
            low[c] = *std::min_element(x, x + count);
            high[c] = *std::max_element(x, x + count);
        }
    }
}

void BoxTree::enclose_boxes(std::ptrdiff_t level, std::ptrdiff_t box) noexcept {
    const auto k = static_cast<std::size_t>(level);
    double* const to = bounds_.data() + (first_box_[k] + box) * 2 * dim_;
    const double* const a = this->box(level - 1, 2 * box);
    const double* const b = 2 * box + 1 < boxes(level - 1) ? a + 2 * dim_ : a;
    for (std::ptrdiff_t c = 0; c < dim_; ++c) to[c] = std::min(a[c], b[c]);
    for (std::ptrdiff_t c = dim_; c < 2 * dim_; ++c) to[c] = std::max(a[c], b[c]);
}

void nearest_distances(const PointAccess& from, std::ptrdiff_t count, const BoxTree& tree,
                       Metric metric, Poller& poller, double* distances) {
    constexpr double nothing_is_enough = -std::numeric_limits<double>::infinity();
    // Searches between two polls: a search of all points of a tree of 10^5 takes as
    // long as a few thousand short ones.
    constexpr std::ptrdiff_t searches = 64;
    with_norm(metric, [&](auto norm) {
        NearestSearch<decltype(norm)> search(from, tree);
        std::ptrdiff_t start = 0;
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const Nearest nearest = search(i, start, nothing_is_enough);
            distances[i] = nearest.distance;
            start = nearest.point;
            if (i % searches == 0 && poller.poll()) throw Stopped();
        }
    });
}

}  // namespace curvewise::warping
