#include "continuous/boxed_curve.hpp"

#include <algorithm>

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
    points_.resize(static_cast<std::size_t>(n_ * dim_));
    poller.in_runs(n_, dim_, [&](std::ptrdiff_t run_first, std::ptrdiff_t run_end) {
        double* to = points_.data() + run_first * dim_;
        for (std::ptrdiff_t i = run_first; i < run_end; ++i) {
            const std::ptrdiff_t from = std::min(i, curve.size() - 1);
            for (std::ptrdiff_t c = 0; c < dim_; ++c) *to++ = range.shrink(curve(from, c));
        }
    });
    data_ = points_.data();
}

void BoxedCurve::add_boxes(Poller& poller) {
    std::ptrdiff_t count = (n_ - 1 + leaf - 1) / leaf;
    first_number_.push_back(0);
    for (;; count = (count + 1) / 2) {
        first_number_.push_back(first_number_.back() + 2 * dim_ * count);
        if (count == 1) break;
    }
    boxes_.resize(static_cast<std::size_t>(first_number_.back()));
    switch (dim_) {
        case 1:
            fill_leaves<1>(poller);
            break;
        case 2:
            fill_leaves<2>(poller);
            break;
        case 3:
            fill_leaves<3>(poller);
            break;
        default:
            fill_leaves<0>(poller);
    }
    for (int level = 1; level < levels(); ++level) fill_level(level, poller);
}

template <int Dim>
void BoxedCurve::fill_leaves(Poller& poller) {
    const std::ptrdiff_t dim = Dim > 0 ? Dim : dim_;
    double* low = boxes_.data();
    for (std::ptrdiff_t first = 0; first < n_ - 1; first += leaf, low += 2 * dim) {
        poller.poll_in_loop(static_cast<std::size_t>(first / leaf));
        const std::ptrdiff_t steps = std::min(leaf, n_ - 1 - first);
        const double* x = point<Dim>(first);
        for (std::ptrdiff_t c = 0; c < dim; ++c, ++x) {
            double least = *x, greatest = *x;
            for (std::ptrdiff_t i = 1; i <= steps; ++i) {
                least = std::min(x[i * dim], least);  // in this order an instruction each
                greatest = std::max(x[i * dim], greatest);
            }
            low[c] = least;
            low[dim + c] = greatest;
        }
    }
}

void BoxedCurve::fill_level(int level, Poller& poller) {
    const int below = level - 1;
    double* low = boxes_.data() + first_number_[static_cast<std::size_t>(level)];
    for (std::ptrdiff_t b = 0; b < boxes(below); b += 2, low += 2 * dim_) {
        poller.poll_in_loop(static_cast<std::size_t>(b / 2));
        put_box_around(box<0>(below, b), low);
        for (std::ptrdiff_t child = b; child < std::min(b + 2, boxes(below)); ++child) {
            grow(low, box<0>(below, child), box<0>(below, child) + dim_);
        }
    }
}

void BoxedCurve::put_box_around(const double* x, double* low) const noexcept {
    for (std::ptrdiff_t c = 0; c < dim_; ++c) low[c] = low[dim_ + c] = x[c];
}

void BoxedCurve::grow(double* low, const double* least, const double* greatest) const noexcept {
    double* const high = low + dim_;
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        low[c] = std::min(low[c], least[c]);
        high[c] = std::max(high[c], greatest[c]);
    }
}

}  // namespace curvewise::continuous
