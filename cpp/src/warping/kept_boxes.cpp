#include "warping/kept_boxes.hpp"

#include <algorithm>

#include "runtime/room.hpp"

namespace curvewise::warping {
namespace {

constexpr double parts = 0x1p16;

// Of the extent of the whole box in coordinate c.
double part_of(const double* whole, std::ptrdiff_t c, std::ptrdiff_t dim) noexcept {
    return (whole[dim + c] - whole[c]) / parts;
}

// A side that lies so many parts above a lower side, or with negative parts below an upper one.
double side_at(double whole_side, double part, std::uint16_t distance) noexcept {
    return whole_side + part * distance;
}

// The distance from the whole box's side, rounded so that side_at() is not further inwards.
std::uint16_t distance_of(double side, double whole_side, double part) noexcept {
    const double found = (side - whole_side) / part;
    if (!(found >= 1.0)) return 0;  // nor where the box has no extent, or one that is infinite
    const auto distance = static_cast<std::uint16_t>(std::min(found, parts - 1.0));
    for (const int less : {0, 1}) {
        const auto tried = static_cast<std::uint16_t>(distance - less);
        const double read = side_at(whole_side, part, tried);
        if (part > 0.0 ? read <= side : read >= side) return tried;
    }
    return 0;
}

// Of a level of the tree of so many points.
std::ptrdiff_t boxes_of(std::ptrdiff_t points, std::ptrdiff_t level) noexcept {
    return ((points + (BoxTree::leaf_points << level) - 1) >> level) / BoxTree::leaf_points;
}

// The number of the finest level of so many points with at most `most` boxes.
std::ptrdiff_t level_of(std::ptrdiff_t points, std::ptrdiff_t most) noexcept {
    std::ptrdiff_t level = 0;
    while (boxes_of(points, level) > most) ++level;
    return level;
}

}  // namespace

BoxLevel level_with(const BoxTree& tree, std::ptrdiff_t most) noexcept {
    const std::ptrdiff_t level = level_of(tree.size(), most);
    return {level, tree.boxes(level), tree.box(level, 0)};
}

void KeptBoxes::keep(const BoxTree& tree) {
    const std::ptrdiff_t dim = tree.dim();
    const double* const whole = tree.box(tree.levels() - 1, 0);
    points_.push_back(tree.size());
    first_.push_back(distances_.size());
    std::ptrdiff_t last = -1;
    for (const std::ptrdiff_t most : most_boxes) {
        const BoxLevel level = level_with(tree, most);
        if (level.level == last) continue;
        last = level.level;
        for (std::ptrdiff_t b = 0; b < level.count; ++b) {
            const double* const box = level.boxes + b * 2 * dim;
            for (std::ptrdiff_t side = 0; side < 2 * dim; ++side) {
                const double part = part_of(whole, side % dim, dim);
                distances_.push_back(
                    distance_of(box[side], whole[side], side < dim ? part : -part));
            }
        }
    }
}

void KeptBoxes::make_room(const KeptBoxes& others) {
    runtime::make_room(points_, others.points_.size());
    runtime::make_room(first_, others.first_.size());
    runtime::make_room(distances_, others.distances_.size());
}

void KeptBoxes::take(KeptBoxes& others) noexcept {
    for (std::size_t& first : others.first_) first += distances_.size();
    runtime::move_behind(points_, others.points_);
    runtime::move_behind(first_, others.first_);
    runtime::move_behind(distances_, others.distances_);
}

BoxLevel KeptBoxes::read(std::ptrdiff_t j, std::size_t limit, const double* whole,
                         std::ptrdiff_t dim, AlignedBuffer& room) const {
    const std::uint16_t* from = distances_.data() + first_[static_cast<std::size_t>(j)];
    const std::ptrdiff_t level = level_of(points(j), most_boxes[limit]);
    for (std::size_t coarser = 0; coarser < limit; ++coarser) {
        const std::ptrdiff_t before = level_of(points(j), most_boxes[coarser]);
        if (before > level_of(points(j), most_boxes[coarser + 1])) {
            from += boxes_of(points(j), before) * 2 * dim;
        }
    }
    const std::ptrdiff_t count = boxes_of(points(j), level);
    room.reserve(count * 2 * dim);
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        const double part = part_of(whole, c, dim);
        for (std::ptrdiff_t k = c; k < count * 2 * dim; k += 2 * dim) {
            room.data()[k] = side_at(whole[c], part, from[k]);
            room.data()[k + dim] = side_at(whole[dim + c], -part, from[k + dim]);
        }
    }
    return {level, count, room.data()};
}

}  // namespace curvewise::warping
