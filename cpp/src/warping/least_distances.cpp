#include "warping/least_distances.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/scratch.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// `fixed_dim`: the number of coordinates, or 0 where it is known at run time only.
template <class Norm, int fixed_dim>
class LeafSearch {
   public:
    LeafSearch(const BoxTree& from, const BoxTree& to)
        : from_(from), to_(to), points_(static_cast<std::size_t>(lanes * from.dim())) {}

    // Writes a bound for each point of a leaf of `from`.
    void operator()(std::ptrdiff_t leaf, double* bounds) {
        own_ = from_.box(0, leaf);
        found_.clear();
        descents_left_ = most_descents;
        std::ptrdiff_t box = nearest_;
        nearest_distance_ = infinity;
        look_at(0, box, distance_to(0, box));
        for (std::ptrdiff_t level = 0; level + 1 < to_.levels(); ++level, box /= 2) {
            const std::ptrdiff_t sibling = box ^ 1;
            if (sibling < to_.boxes(level)) look_at(level, sibling, distance_to(level, sibling));
        }
        bound_points(leaf, bounds);
    }

   private:
    static constexpr std::ptrdiff_t lanes = BoxTree::leaf_points;
    // Enough for curves that cross themselves many times; noise would have all boxes looked into.
    static constexpr int most_descents = 32;

    struct Found {
        const double* box;
        double distance;
    };

    std::ptrdiff_t dim() const noexcept { return fixed_dim > 0 ? fixed_dim : to_.dim(); }

    double distance_to(std::ptrdiff_t level, std::ptrdiff_t box) const noexcept {
        return smallest_distance<Norm>(own_, to_.box(level, box), dim());
    }

    void look_at(std::ptrdiff_t level, std::ptrdiff_t box, double distance) {
        if (level == 0 || distance >= nearest_distance_ || descents_left_ == 0) {
            found_.push_back({to_.box(level, box), distance});
            if (level == 0 && distance < nearest_distance_) {
                nearest_distance_ = distance;
                nearest_ = box;
            }
            return;
        }
        --descents_left_;
        std::ptrdiff_t near = 2 * box, far = near + 1;
        double to_near = distance_to(level - 1, near);
        if (far == to_.boxes(level - 1)) return look_at(level - 1, near, to_near);
        double to_far = distance_to(level - 1, far);
        if (to_far < to_near) {
            std::swap(near, far);
            std::swap(to_near, to_far);
        }
        look_at(level - 1, near, to_near);
        look_at(level - 1, far, to_far);
    }

    void bound_points(std::ptrdiff_t leaf, double* bounds) noexcept {
        const std::ptrdiff_t begin = leaf * lanes;
        const std::ptrdiff_t end = std::min(begin + lanes, from_.size());
        for (std::ptrdiff_t c = 0; c < dim(); ++c) {
            for (std::ptrdiff_t k = 0; k < lanes; ++k) {
                points_[static_cast<std::size_t>(c * lanes + k)] =
                    from_.points()(std::min(begin + k, end - 1), c);
            }
        }
        // A box farther away than every point of the nearest box contains no nearest point.
        const double most = largest_distance<Norm>(own_, to_.box(0, nearest_), dim());
        double least[lanes];
        std::fill_n(least, lanes, infinity);
        for (const Found& found : found_) {
            if (found.distance <= most) take_smaller(found.box, least);
        }
        for (std::ptrdiff_t k = 0; k < end - begin; ++k) bounds[begin + k] = Norm::finish(least[k]);
    }

    // Without the norm's finish, which is monotone.
    void take_smaller(const double* box, double* least) const noexcept {
        double sum[lanes] = {};
        for (std::ptrdiff_t c = 0; c < dim(); ++c) {
            const double low = box[c], high = box[dim() + c];
            const double* const points = points_.data() + c * lanes;
            for (std::ptrdiff_t k = 0; k < lanes; ++k) {
                const double beyond = std::max(std::max(low - points[k], points[k] - high), 0.0);
                sum[k] = Norm::add(sum[k], beyond);
            }
        }
        for (std::ptrdiff_t k = 0; k < lanes; ++k) least[k] = std::min(least[k], sum[k]);
    }

    const BoxTree& from_;
    const BoxTree& to_;
    runtime::ScratchVector<double> points_;  // of the leaf, coordinate by coordinate
    runtime::ScratchVector<Found> found_;
    const double* own_ = nullptr;
    int descents_left_ = 0;
    std::ptrdiff_t nearest_ = 0;
    double nearest_distance_ = infinity;
};

template <class Norm, int fixed_dim>
void search_leaves(const BoxTree& from, const BoxTree& to, Poller& poller, double* bounds) {
    constexpr std::ptrdiff_t searches_between_polls = 64;
    LeafSearch<Norm, fixed_dim> search(from, to);
    for (std::ptrdiff_t leaf = 0; leaf < from.boxes(0); ++leaf) {
        search(leaf, bounds);
        if (leaf % searches_between_polls == 0 && poller.poll()) throw Stopped();
    }
}

}  // namespace

void least_distances(const BoxTree& from, const BoxTree& to, Metric metric, Poller& poller,
                     double* bounds) {
    with_norm(metric, [&](auto norm) {
        using Norm = decltype(norm);
        switch (from.dim()) {
            case 1:
                return search_leaves<Norm, 1>(from, to, poller, bounds);
            case 2:
                return search_leaves<Norm, 2>(from, to, poller, bounds);
            case 3:
                return search_leaves<Norm, 3>(from, to, poller, bounds);
            default:
                return search_leaves<Norm, 0>(from, to, poller, bounds);
        }
    });
}

}  // namespace curvewise::warping
