#include "warping/kept_bounds.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "warping/ground_distance.hpp"

namespace curvewise::warping {
namespace {

// Of a kept curve.
constexpr std::ptrdiff_t numbers_of(std::ptrdiff_t dim) noexcept { return 1 + 4 * dim; }

}  // namespace

void write_summary(const BoxTree& tree, double* summary) noexcept {
    const PointAccess& points = tree.points();
    const std::ptrdiff_t dim = tree.dim();
    for (std::ptrdiff_t c = 0; c < dim; ++c) *summary++ = points(0, c);
    for (std::ptrdiff_t c = 0; c < dim; ++c) *summary++ = points(tree.size() - 1, c);
    std::copy_n(tree.box(tree.levels() - 1, 0), 2 * dim, summary);
}

void KeptBounds::reserve(const std::vector<CurveView>& curves, std::ptrdiff_t dim) {
    const auto count = static_cast<std::ptrdiff_t>(curves.size());
    std::ptrdiff_t boxes = 0;
    for (const CurveView& curve : curves) boxes += KeptBoxes::count(curve.size(), dim);
    curves_.make_room(count);
    numbers_.make_room(count * numbers_of(dim));
    boxes_.make_room(boxes);
}

void KeptBounds::keep(const CheckedCurve& Q, const PackedCurve& packed, PointOrder order) {
    const BoxTree tree(packed, order);
    dim_ = packed.dim();
    const std::ptrdiff_t box_numbers = KeptBoxes::count(packed.size(), dim_);
    numbers_.make_room(numbers_of(dim_));
    boxes_.make_room(box_numbers);
    double* const numbers = numbers_.append(numbers_of(dim_));
    std::uint16_t* const boxes = boxes_.append(box_numbers);
    numbers[0] = Q.largest;
    write_summary(tree, numbers + 1);
    KeptBoxes::write(tree, boxes);
    curves_.push_back({packed.size(), numbers, boxes});
}

std::ptrdiff_t KeptBounds::stored_size(std::ptrdiff_t points, std::ptrdiff_t dim) noexcept {
    return numbers_of(dim) + (KeptBoxes::count(points, dim) + 3) / 4;
}

void KeptBounds::write(std::ptrdiff_t j, double* to) const noexcept {
    const KeptCurve& curve = curves_[j];
    std::fill_n(to, stored_size(curve.points, dim_), 0.0);
    to = std::copy_n(curve.numbers, numbers_of(dim_), to);
    const auto count = static_cast<std::size_t>(KeptBoxes::count(curve.points, dim_));
    if (count > 0) std::memcpy(to, curve.boxes, count * sizeof(std::uint16_t));
}

void KeptBounds::look_at(std::ptrdiff_t points, std::ptrdiff_t dim, const double* stored) {
    dim_ = dim;
    const auto* const boxes = reinterpret_cast<const std::uint16_t*>(stored + numbers_of(dim));
    curves_.push_back({points, stored, boxes});
}

void KeptBounds::make_room(const KeptBounds& others) {
    if (curves_.size() == 0) return;
    curves_.make_room(others.curves_.size());
    numbers_.make_room(others.numbers_.size());
    boxes_.make_room(others.boxes_.size());
}

pairwise::RowShape KeptBounds::row_shape(const GroundDistance& ground) const noexcept {
    if (!has_box_bounds(metric_of_boxes(canonical_metric(ground, dim_)))) return {};
    return {4 * dim_ + 2, 4 * dim_};
}

void KeptBounds::write_row(std::ptrdiff_t j, double* row) const noexcept {
    const KeptCurve& curve = curves_[j];
    row = std::copy_n(curve.summary(), 4 * dim_, row);
    row[0] = curve.largest();
    row[1] = static_cast<double>(curve.points);
}

void KeptBounds::take(KeptBounds& others) noexcept {
    if (curves_.size() == 0) {
        dim_ = others.dim_;
        curves_.take(others.curves_);
        std::swap(numbers_, others.numbers_);
        std::swap(boxes_, others.boxes_);
        return;
    }
    for (std::ptrdiff_t j = 0; j < others.curves_.size(); ++j) {
        const KeptCurve& curve = others.curves_[j];
        const std::ptrdiff_t box_numbers = KeptBoxes::count(curve.points, others.dim_);
        double* const numbers = numbers_.append(numbers_of(others.dim_));
        std::uint16_t* const boxes = boxes_.append(box_numbers);
        std::copy_n(curve.numbers, numbers_of(others.dim_), numbers);
        std::copy_n(curve.boxes, box_numbers, boxes);
        curves_.push_back({curve.points, numbers, boxes});
    }
    others.curves_.clear();
    others.numbers_ = {};
    others.boxes_ = {};
}

}  // namespace curvewise::warping
