// The boxes of many stored curves, in little memory. Each curve has only the levels of its tree
// that bounds use. A side of a box is stored as its distance from the same side of the curve's
// whole box, in 2^-16 of the whole box's extent. That is about 24 to 40 boxes of 4 d bytes a curve.
//
// Distances are rounded so that a stored box encloses the box of the tree. So a lower bound of all
// distances from the box is a lower bound for the points in it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "warping/box_tree.hpp"

namespace curvewise::warping {

// Boxes of one level of a curve's tree: each its lowest coordinates, then its highest.
struct BoxLevel {
    std::ptrdiff_t level;
    std::ptrdiff_t count;
    const double* boxes;

    std::ptrdiff_t points_per_box() const noexcept { return BoxTree::leaf_points << level; }
};

// The finest level of a tree with at most `most` boxes.
BoxLevel level_with(const BoxTree& tree, std::ptrdiff_t most) noexcept;

// Boxes that were read, because the last ones are often needed again.
struct BoxRoom {
    std::ptrdiff_t curve = -1;
    std::ptrdiff_t level = -1;
    AlignedBuffer boxes;
};

// The numbers that are kept of a curve, and how they are read.
struct KeptBoxes {
    // The finest levels with at most these numbers of boxes are kept.
    static constexpr std::ptrdiff_t most_boxes[] = {48, 32, 8};

    // How many numbers there are of a curve of `points` points.
    static std::ptrdiff_t count(std::ptrdiff_t points, std::ptrdiff_t dim) noexcept;
    // Writes those of the curve of a tree.
    static void write(const BoxTree& tree, std::uint16_t* numbers) noexcept;

    // The finest level with at most most_boxes[limit] boxes, read into `room`, which serves the
    // curves of one list alone. `whole` is the box around the curve, within the usual range.
    BoxLevel read(std::size_t limit, const double* whole, std::ptrdiff_t dim, BoxRoom& room) const;

    std::ptrdiff_t curve;   // its index in the list
    std::ptrdiff_t points;  // of the curve
    const std::uint16_t* numbers;
};

}  // namespace curvewise::warping
