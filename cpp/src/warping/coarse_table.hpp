// A coarse Fréchet table of two curves, in boxes. If the smallest ground distance of each pair of
// boxes replaces a cell, the recurrence gives a lower bound of the distance. The largest ground
// distance gives an upper bound: the path of points through all points of the path of boxes. The
// number of boxes that paths may cross, for distances between the two bounds, shows early if the
// table can be pruned.
//
// Boxes larger than a block of the recursion are represented by a random block inside. A long curve
// that returns to the same levels has points of all levels in every large box, but in few blocks.
// Time and memory are O(boxes), a small part of the table's cells.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/scratch.hpp"
#include "warping/box_tree.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {

class CoarseTable {
   public:
    // A table of at most about `most_boxes` pairs of boxes. The trees must outlive it.
    CoarseTable(const BoxTree& P, const BoxTree& Q, Metric metric, std::ptrdiff_t most_boxes);

    double lower() const noexcept { return lower_; }
    double upper() const noexcept { return upper_; }
    // The share of the blocks that a recursion between the two bounds must sweep, judged by the
    // pairs of boxes. These blocks can be reached over ground distances of at most `upper`, and are
    // not wholly at or below `lower`.
    double undecided_share(double lower, double upper) const;

   private:
    // A tree; its boxes of one level are the rows, or the columns.
    struct Side {
        const BoxTree& tree;
        std::ptrdiff_t level;
        const double* box(std::ptrdiff_t index) const noexcept { return tree.box(level, index); }
        // That of a block inside.
        const double* block(std::ptrdiff_t index, std::uint64_t random) const noexcept;
    };

    Side p_;
    Side q_;
    Metric metric_;
    std::ptrdiff_t rows_;
    std::ptrdiff_t columns_;
    runtime::ScratchVector<double> smallest_;
    runtime::ScratchVector<double> largest_;
    double lower_;
    double upper_;
};

}  // namespace curvewise::warping
