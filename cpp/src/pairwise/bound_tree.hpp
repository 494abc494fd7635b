// Trees over the first bounds of many targets, so that a search finds the targets with small bounds
// without a look at all of them. The first bound of a target is a function of a row of numbers. A
// box around rows has a bound, too, that is not above the bound of any row in it.
//
// A tree is a hierarchy of boxes (an R-tree, packed from top to bottom as by Kamel & Faloutsos and
// Leutenegger). A leaf holds 48 rows, each other box 8 boxes of the level below. The rows are
// divided at the median of the number that differs most, first into the boxes of the highest level.
// For N rows of w numbers, construction takes O(N (w + log N)) time. The boxes and the order take
// about w / 2 + 4 bytes a row.
//
// A forest has few trees. Rows that are added make trees of their own, and small trees are merged
// with trees of at most their size (Bentley & Saxe 1980). So each row is divided O(log N) times.
// The merging ends at 2^16 rows, so that no single addition takes long. The last rows, fewer than a
// tree is worth, are in no tree. Trees and forests never change, so that searches may use them
// while others are made.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/poller.hpp"

namespace curvewise::pairwise {

using runtime::Poller;

struct RowShape {
    std::ptrdiff_t width = 0;     // numbers of a row, 0 where boxes have no bounds
    std::ptrdiff_t dividing = 0;  // of these, the first ones divide the rows
};

// The rows of targets.
struct BoundRows {
    RowShape shape;
    std::function<void(std::ptrdiff_t j, double* row)> write;  // of target j
};

class BoundTree {
   public:
    static constexpr std::ptrdiff_t leaf_rows = 48;
    static constexpr std::ptrdiff_t fan = 8;

    // Of the `count` rows from `first` on. Throws Stopped.
    BoundTree(const BoundRows& rows, std::ptrdiff_t first, std::ptrdiff_t count, Poller& poller);

    std::ptrdiff_t size() const noexcept { return static_cast<std::ptrdiff_t>(places_.size()); }
    // The highest level has at most `fan` boxes, level 0 is the leaves.
    int levels() const noexcept { return static_cast<int>(first_box_.size()) - 1; }
    std::ptrdiff_t boxes(int level) const noexcept {
        const auto k = static_cast<std::size_t>(level);
        return first_box_[k + 1] - first_box_[k];
    }
    // The least of each number of the rows, then the greatest of each. Box b of a level holds the
    // boxes from fan * b on of the level below.
    const double* box(int level, std::ptrdiff_t b) const noexcept {
        return numbers_.data() + (first_box_[static_cast<std::size_t>(level)] + b) * 2 * width_;
    }
    // The rows of a leaf, as their distances from the first row of the tree.
    struct Leaf {
        const std::uint32_t* places;
        std::ptrdiff_t count;
    };
    Leaf leaf(std::ptrdiff_t b) const noexcept {
        return {places_.data() + b * leaf_rows, std::min(leaf_rows, size() - b * leaf_rows)};
    }

   private:
    std::ptrdiff_t width_;
    std::vector<std::ptrdiff_t> first_box_;  // of every level, and the number of all
    std::vector<double> numbers_;
    std::vector<std::uint32_t> places_;
};

class BoundForest {
   public:
    // With fewer rows, a tree saves nothing.
    static constexpr std::ptrdiff_t fewest_rows = 256;

    // With more, trees are not merged.
    static constexpr std::ptrdiff_t most_merged_rows = std::ptrdiff_t{1} << 16;

    struct Planted {
        std::ptrdiff_t first;  // row
        std::shared_ptr<const BoundTree> tree;
    };

    // In the order of their rows, one behind the other, from row 0 on.
    const std::vector<Planted>& trees() const noexcept { return trees_; }
    // The number of rows in trees; the rows behind are in none.
    std::ptrdiff_t size() const noexcept { return size_; }

    // The forest of all `size` rows: the first `own_size`, which have this forest, and those of
    // `others` behind. Throws Stopped.
    BoundForest with(std::ptrdiff_t own_size, const BoundForest& others, std::ptrdiff_t size,
                     const BoundRows& rows, Poller& poller) const;

   private:
    std::vector<Planted> trees_;
    std::ptrdiff_t size_ = 0;
};

}  // namespace curvewise::pairwise
