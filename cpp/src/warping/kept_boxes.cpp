#include "warping/kept_boxes.hpp"

#include <algorithm>

namespace curvewise::warping {
namespace {

constexpr double parts = 0x1p16;

// The length of a part of the extent of the whole box in coordinate c.
double part_of(const double* whole, std::ptrdiff_t c, std::ptrdiff_t dim) noexcept {
    return (whole[dim + c] - whole[c]) / parts;
}

// A side that lies `distance` parts above a lower side, or with negative parts below an upper one.
double side_at(double whole_side, double part, std::uint16_t distance) noexcept {
    return whole_side + part * distance;
}

// The distance from the whole box's side, rounded so that side_at() is not further inwards.
std::uint16_t distance_of(double side, double whole_side, double part) noexcept {
    const double found = (side - whole_side) / part;
    if (!(found >= 1.0)) return 0;  // nor if the extent of the box is zero or infinite
    const auto distance = static_cast<std::uint16_t>(std::min(found, parts - 1.0));
    for (const int less : {0, 1}) {
        const auto tried = static_cast<std::uint16_t>(distance - less);
        const double read = side_at(whole_side, part, tried);
        if (part > 0.0 ? read <= side : read >= side) return tried;
    }
    return 0;
}

// A level of the tree of a curve of `points` points, from the finest on.
struct Level {
    explicit Level(std::ptrdiff_t points) noexcept
        : boxes((points + BoxTree::leaf_points - 1) / BoxTree::leaf_points) {}
    void coarsen_to(std::ptrdiff_t most) noexcept {
        for (; boxes > most; ++level) boxes = (boxes + 1) / 2;
    }
    std::ptrdiff_t level = 0;
    std::ptrdiff_t boxes;
};

}  // namespace

BoxLevel level_with(const BoxTree& tree, std::ptrdiff_t most) noexcept {
    Level found(tree.size());
    found.coarsen_to(most);
    return {found.level, found.boxes, tree.box(found.level, 0)};
}

std::ptrdiff_t KeptBoxes::count(std::ptrdiff_t points, std::ptrdiff_t dim) noexcept {
    Level level(points);
    std::ptrdiff_t boxes = 0, last = -1;
    for (const std::ptrdiff_t most : most_boxes) {
        level.coarsen_to(most);
        if (level.level != last) boxes += level.boxes;
        last = level.level;
    }
    return boxes * 2 * dim;
}

void KeptBoxes::write(const BoxTree& tree, std::uint16_t* numbers) noexcept {
    const std::ptrdiff_t dim = tree.dim();
    const double* const whole = tree.box(tree.levels() - 1, 0);
    std::ptrdiff_t last = -1;
    for (const std::ptrdiff_t most : most_boxes) {
        const BoxLevel level = level_with(tree, most);
        if (level.level == last) continue;
        last = level.level;
        for (std::ptrdiff_t b = 0; b < level.count; ++b) {
            const double* const box = level.boxes + b * 2 * dim;
            for (std::ptrdiff_t side = 0; side < 2 * dim; ++side) {
                const double part = part_of(whole, side % dim, dim);
                *numbers++ = distance_of(box[side], whole[side], side < dim ? part : -part);
            }
        }
    }
}

BoxLevel KeptBoxes::read(std::size_t limit, const double* whole, std::ptrdiff_t dim,
                         BoxRoom& room) const {
    Level found(points);
    std::ptrdiff_t before = 0;
    found.coarsen_to(most_boxes[0]);
    for (std::size_t coarser = 1; coarser <= limit; ++coarser) {
        const Level finer = found;
        found.coarsen_to(most_boxes[coarser]);
        if (found.level > finer.level) before += finer.boxes * 2 * dim;
    }
    if (room.curve != curve || room.level != found.level) {
        room.curve = curve;
        room.level = found.level;
        room.boxes.reserve(found.boxes * 2 * dim);
        const std::uint16_t* const from = numbers + before;
        double* const to = room.boxes.data();
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            const double part = part_of(whole, c, dim);
            const double low = whole[c], high = whole[dim + c];
            for (std::ptrdiff_t k = c; k < found.boxes * 2 * dim; k += 2 * dim) {
                to[k] = side_at(low, part, from[k]);
                to[k + dim] = side_at(high, -part, from[k + dim]);
            }
        }
    }
    return {found.level, found.boxes, room.boxes.data()};
}

}  // namespace curvewise::warping
