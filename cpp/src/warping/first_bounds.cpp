#include "warping/first_bounds.hpp"

#include "curves/range_scale.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"

namespace curvewise::warping {
namespace {

template <class Norm>
double distance(const double* a, const double* b, std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) sum = Norm::add(sum, a[c] - b[c]);
    return Norm::finish(sum);
}

template <class Norm>
double distance_to_box(const double* a, const double* least, const double* greatest,
                       std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        sum = Norm::add(sum, std::max(std::max(least[c] - a[c], a[c] - greatest[c]), 0.0));
    }
    return Norm::finish(sum);
}

}  // namespace

FirstBounds::FirstBounds(const WarpingOptions& options, const KeptBounds& kept,
                         const CheckedCurve& P, const BoxTree& tree)
    : options_(options),
      kept_(kept),
      metric_(canonical_metric(options.ground, tree.dim())),
      box_metric_(metric_of_boxes(metric_)),
      has_bounds_(has_box_bounds(box_metric_)),
      largest_(P.largest),
      n_(tree.size()),
      dim_(tree.dim()),
      summary_(static_cast<std::size_t>(4 * dim_)) {
    write_summary(tree, summary_.data());
}

bool FirstBounds::is_bounded(double largest) const noexcept {
    return has_bounds_ && RangeScale(std::max(largest_, largest)).is_identity();
}

void FirstBounds::finish(double* bounds, std::ptrdiff_t count) const noexcept {
    if (box_metric_ == metric_) return;
    active_level().kernels->arcs(bounds, count, options_.ground.parameter());
}

template <class Norm>
double FirstBounds::of_curve(const KeptCurve& curve) const noexcept {
    const std::ptrdiff_t dim = dim_;
    const double* const p = summary_.data();
    const double* const q = curve.summary();
    const double first = options_.open_begin ? 0.0 : distance<Norm>(p, q, dim);
    const double last = options_.open_end ? 0.0 : distance<Norm>(p + dim, q + dim, dim);
    // Some point of the one curve lies so far beyond all points of the other.
    double beyond = 0.0;
    for (std::ptrdiff_t c = 2 * dim; c < 3 * dim; ++c) {
        const double low = q[c] - p[c], high = p[c + dim] - q[c + dim];
        beyond = std::max(beyond, std::max(low, high));
        if (!is_open()) beyond = std::max(beyond, std::max(-low, -high));
    }
    const double side = Norm::finish(Norm::add(0.0, beyond));
    const bool is_one_cell = n_ == 1 && curve.points == 1;
    return bound_of(first, last, side, !is_frechet() && !is_one_cell) /
           options_.divisor(n_, curve.points);
}

double FirstBounds::bound_of(double first, double last, double beyond, bool is_sum) const noexcept {
    double bounds[] = {first, last, beyond};
    if (is_sum) {
        finish(bounds, 3);
        bounds[0] += bounds[1];
    }
    double bound = *std::max_element(bounds, bounds + 3);
    if (!is_sum) finish(&bound, 1);
    return bound;
}

// As of_curve(), with each number of a curve replaced by the nearest one in its interval. All
// operations are monotone. If the curves with the least and the greatest coordinates are bounded,
// all are: the usual range is an interval, and 0. If P and one of the curves are 0, the bound is.
template <class Norm>
double FirstBounds::of_box(const double* box) const noexcept {
    const std::ptrdiff_t dim = dim_;
    const double* const p = summary_.data();
    const double* const least = box;
    const double* const greatest = box + 4 * dim + 2;
    if (!is_bounded(least[4 * dim]) || !is_bounded(greatest[4 * dim])) return 0.0;
    const auto least_points = static_cast<std::ptrdiff_t>(least[4 * dim + 1]);
    const auto most_points = static_cast<std::ptrdiff_t>(greatest[4 * dim + 1]);
    const double first = options_.open_begin ? 0.0 : distance_to_box<Norm>(p, least, greatest, dim);
    const double last =
        options_.open_end ? 0.0 : distance_to_box<Norm>(p + dim, least + dim, greatest + dim, dim);
    double beyond = 0.0;
    for (std::ptrdiff_t c = 2 * dim; c < 3 * dim; ++c) {
        const double low = least[c] - p[c], high = p[c + dim] - greatest[c + dim];
        beyond = std::max(beyond, std::max(low, high));
        if (!is_open()) {
            beyond = std::max(beyond, std::max(p[c] - greatest[c], least[c + dim] - p[c + dim]));
        }
    }
    const double side = Norm::finish(Norm::add(0.0, beyond));
    const bool may_be_one_cell = n_ == 1 && least_points == 1;
    return bound_of(first, last, side, !is_frechet() && !may_be_one_cell) /
           options_.divisor(n_, most_points);
}

void FirstBounds::quick(std::ptrdiff_t first, std::ptrdiff_t count, double* bounds) const {
    std::fill_n(bounds, count, 0.0);
    with_norm(box_metric_, [&](auto norm) {
        kept_.in_parts(first, count, [&](const KeptCurve* curves, std::ptrdiff_t part) {
            for (std::ptrdiff_t k = 0; k < part; ++k) {
                if (is_bounded(curves[k].largest())) {
                    bounds[k] = of_curve<decltype(norm)>(curves[k]);
                }
            }
            bounds += part;
        });
    });
}

void FirstBounds::quick(std::ptrdiff_t first, const pairwise::BoundTree::Leaf& leaf,
                        double* bounds) const {
    // The curves of a leaf lie apart in memory. Loops that only read let the processor wait for
    // many of them at once.
    const KeptCurve* curves[pairwise::BoundTree::leaf_rows];
    double largest[pairwise::BoundTree::leaf_rows];
    for (std::ptrdiff_t k = 0; k < leaf.count; ++k) curves[k] = &kept_[first + leaf.places[k]];
    for (std::ptrdiff_t k = 0; k < leaf.count; ++k) largest[k] = curves[k]->largest();
    std::fill_n(bounds, leaf.count, 0.0);
    with_norm(box_metric_, [&](auto norm) {
        for (std::ptrdiff_t k = 0; k < leaf.count; ++k) {
            if (is_bounded(largest[k])) bounds[k] = of_curve<decltype(norm)>(*curves[k]);
        }
    });
}

void FirstBounds::of_boxes(const double* boxes, std::ptrdiff_t count, double* bounds) const {
    std::fill_n(bounds, count, 0.0);
    const std::ptrdiff_t numbers = 2 * (4 * dim_ + 2);
    with_norm(box_metric_, [&](auto norm) {
        for (std::ptrdiff_t k = 0; k < count; ++k) {
            bounds[k] = of_box<decltype(norm)>(boxes + k * numbers);
        }
    });
}

}  // namespace curvewise::warping
