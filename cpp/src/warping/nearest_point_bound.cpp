#include "warping/nearest_point_bound.hpp"

#include <algorithm>

namespace curvewise::warping {
namespace {

// The points of one curve against those of the other.
template <class Norm>
class DirectedBound {
   public:
    DirectedBound(const BoxTree& from, const BoxTree& to, double bound, double most_cells,
                  Poller& poller) noexcept
        : from_(from),
          to_(to),
          search_(from.points(), to),
          bound_(bound),
          most_boxes_(static_cast<std::int64_t>(most_cells / cells_per_box)),
          poller_(poller) {}

    double raise() {
        // First a few points from all along the curve: the sooner the bound is high, the less is
        // searched.
        for (std::ptrdiff_t i = 0; i < from_.size(); i += from_.size() / samples + 1) {
            if (search_.boxes() > most_boxes_ / 2) break;
            start_ = i * to_.size() / from_.size();
            look_at(i);
        }
        const std::ptrdiff_t level = std::min(run_level, from_.levels() - 1);
        start_ = 0;
        for (std::ptrdiff_t run = 0; run < from_.boxes(level); ++run) {
            if (search_.boxes() > most_boxes_) break;
            cover(level, run);
            if (run % runs_per_poll == 0 && poller_.poll()) throw Stopped();
        }
        return bound_;
    }

   private:
    static constexpr std::ptrdiff_t samples = 64;
    static constexpr std::ptrdiff_t run_level = 3;
    static constexpr std::ptrdiff_t runs_per_poll = 8;
    // The time that a search needs for a box, in cells of a sweep.
    static constexpr double cells_per_box = 20.0;

    void look_at(std::ptrdiff_t i) noexcept {
        const Nearest nearest = search_(i, start_, bound_);
        bound_ = std::max(bound_, nearest.distance);
        start_ = nearest.point;
    }

    void cover(std::ptrdiff_t level, std::ptrdiff_t box) noexcept {
        const std::ptrdiff_t first = box * BoxTree::leaf_points << level;
        const std::ptrdiff_t end = std::min(first + (BoxTree::leaf_points << level), from_.size());
        if (level == run_level) look_at((first + end) / 2);
        if (largest_to_start(level, box) <= bound_) return;
        if (level == 0) {
            for (std::ptrdiff_t i = first; i < end; ++i) look_at(i);
            return;
        }
        cover(level - 1, 2 * box);
        if (2 * box + 1 < from_.boxes(level - 1)) cover(level - 1, 2 * box + 1);
    }

    // The distance of the point found last to the farthest corner of a box.
    double largest_to_start(std::ptrdiff_t level, std::ptrdiff_t box) const noexcept {
        const double* const bounds = from_.box(level, box);
        const std::ptrdiff_t dim = from_.dim();
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            const double x = to_.points()(start_, c);
            sum = Norm::add(sum, std::max(bounds[dim + c] - x, x - bounds[c]));
        }
        return Norm::finish(sum);
    }

    const BoxTree& from_;
    const BoxTree& to_;
    NearestSearch<Norm> search_;
    double bound_;
    std::int64_t most_boxes_;
    Poller& poller_;
    std::ptrdiff_t start_ = 0;  // the point found last
};

}  // namespace

double nearest_point_bound(const BoxTree& P, const BoxTree& Q, Metric metric, double bound,
                           double most_cells, Poller& poller) {
    return with_norm(metric, [&](auto norm) {
        using Norm = decltype(norm);
        const double raised = DirectedBound<Norm>(P, Q, bound, most_cells / 2, poller).raise();
        return DirectedBound<Norm>(Q, P, raised, most_cells / 2, poller).raise();
    });
}

}  // namespace curvewise::warping
