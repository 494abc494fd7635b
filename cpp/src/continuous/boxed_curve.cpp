#include "continuous/boxed_curve.hpp"

namespace curvewise::continuous {

BoxedCurve::BoxedCurve(const CurveView& curve, const RangeScale& range, Poller& poller)
    : n_(std::max(curve.size(), std::ptrdiff_t{2})), dim_(curve.dim()) {
    copy(curve, range, poller);
    add_boxes(poller);
}

BoxedCurve::BoxedCurve(const double* points, const CurveView& curve, Poller& poller)
    : n_(std::max(curve.size(), std::ptrdiff_t{2})), dim_(curve.dim()), data_(points) {
    if (curve.size() < n_) copy(curve, RangeScale(1.0), poller);
    add_boxes(poller);
}

void BoxedCurve::copy(const CurveView& curve, const RangeScale& range, Poller& poller) {
    points_.reserve(static_cast<std::size_t>(n_ * dim_));
    poller.in_runs(n_, dim_, [&](std::ptrdiff_t run_first, std::ptrdiff_t run_end) {
        for (std::ptrdiff_t i = run_first; i < run_end; ++i) {
            const std::ptrdiff_t from = std::min(i, curve.size() - 1);
            for (std::ptrdiff_t c = 0; c < dim_; ++c) {
                points_.push_back(range.shrink(curve(from, c)));
            }
        }
    });
    data_ = points_.data();
}

void BoxedCurve::add_boxes(Poller& poller) {
    add_leaves(poller);
    while (boxes(levels() - 1) > 1) add_level(poller);
}

void BoxedCurve::add_leaves(Poller& poller) {
    Boxes boxes;
    boxes.reserve(static_cast<std::size_t>(2 * dim_ * ((n_ - 1 + leaf - 1) / leaf)));
    for (std::ptrdiff_t first = 0; first < n_ - 1; first += leaf) {
        poller.poll_in_loop(static_cast<std::size_t>(first / leaf));
        double* const low = add_box(boxes, point<0>(first));
        for (std::ptrdiff_t i = first + 1; i <= std::min(first + leaf, n_ - 1); ++i) {
            grow(low, point<0>(i), point<0>(i));
        }
    }
    levels_.push_back(std::move(boxes));
}

void BoxedCurve::add_level(Poller& poller) {
    const int below = levels() - 1;
    Boxes boxes;
    boxes.reserve(static_cast<std::size_t>(2 * dim_ * ((this->boxes(below) + 1) / 2)));
    for (std::ptrdiff_t b = 0; b < this->boxes(below); b += 2) {
        poller.poll_in_loop(static_cast<std::size_t>(b / 2));
        double* const low = add_box(boxes, box<0>(below, b));
        for (std::ptrdiff_t child = b; child < std::min(b + 2, this->boxes(below)); ++child) {
            grow(low, box<0>(below, child), box<0>(below, child) + dim_);
        }
    }
    levels_.push_back(std::move(boxes));
}

double* BoxedCurve::add_box(Boxes& boxes, const double* x) const {
    boxes.insert(boxes.end(), x, x + dim_);
    boxes.insert(boxes.end(), x, x + dim_);
    return boxes.data() + boxes.size() - 2 * dim_;
}

void BoxedCurve::grow(double* low, const double* least, const double* greatest) const noexcept {
    double* const high = low + dim_;
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        low[c] = std::min(low[c], least[c]);
        high[c] = std::max(high[c], greatest[c]);
    }
}

}  // namespace curvewise::continuous
