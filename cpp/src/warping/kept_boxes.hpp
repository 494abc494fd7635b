// The boxes of many stored curves, in little memory. Each curve has only the levels of its tree
// that bounds use. A side of a box is stored as its distance from the same side of the curve's
// whole box, in 2^-16 of the whole box's extent. That is about 24 to 40 boxes of 4 d bytes a curve.
//
// Distances are rounded so that a stored box encloses the box of the tree. So a lower bound of all
// distances from the box is a lower bound for the points in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

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

class KeptBoxes {
   public:
    // The finest levels with at most these numbers of boxes are kept.
    static constexpr std::ptrdiff_t most_boxes[] = {48, 32, 8};

    void keep(const BoxTree& tree);
    // Adds those of `others`, for which room was made, and leaves it empty.
    void make_room(const KeptBoxes& others);
    void take(KeptBoxes& others) noexcept;

    std::ptrdiff_t size() const noexcept { return static_cast<std::ptrdiff_t>(points_.size()); }
    // The number of points of curve j.
    std::ptrdiff_t points(std::ptrdiff_t j) const noexcept {
        return points_[static_cast<std::size_t>(j)];
    }
    // The finest level of curve j with at most most_boxes[limit] boxes, read into `room`, which
    // serves this alone. `whole` is the box around the curve, within the usual range.
    BoxLevel read(std::ptrdiff_t j, std::size_t limit, const double* whole, std::ptrdiff_t dim,
                  BoxRoom& room) const;

   private:
    std::vector<std::ptrdiff_t> points_;
    std::vector<std::size_t> first_;  // of each curve's distances
    std::vector<std::uint16_t> distances_;
};

}  // namespace curvewise::warping
