// The Fréchet table of two curves in boxes, coarsely: with the smallest ground distance of each
// pair of boxes in place of a cell, the recurrence gives a lower bound of the distance, with the
// largest an upper one (take, of the path of boxes, the path of points that goes through all of
// their points). How many boxes the paths of a distance between the two may cross says, before
// much has been done, whether the table can be pruned. Of boxes larger than a block of the
// recursion a block inside is looked at, taken at random: a long curve that comes back to its
// levels again and again has some of each in every large box, and in few blocks. Time and memory
// O(boxes), a small part of the table's cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "warping/box_tree.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {

class CoarseTable {
   public:
    // Of at most some `most_boxes` pairs of boxes. The trees must outlive it.
    CoarseTable(const BoxTree& P, const BoxTree& Q, Metric metric, std::ptrdiff_t most_boxes);

    double lower() const noexcept { return lower_; }
    double upper() const noexcept { return upper_; }
    // The share of the blocks that can be reached over ground distances of at most `upper`, as far
    // as the pairs of boxes tell, and that are not wholly at or below `lower`: what a recursion
    // between the two has to sweep.
    double undecided_share(double lower, double upper) const;

   private:
    // Of a tree whose boxes of one level are the rows, or the columns.
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
    std::vector<double> smallest_;
    std::vector<double> largest_;
    double lower_;
    double upper_;
};

}  // namespace curvewise::warping
