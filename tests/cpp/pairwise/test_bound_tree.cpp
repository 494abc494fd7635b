// Trees of boxes around rows of numbers, and forests of them that rows are added to.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/control.hpp"
#include "pairwise/bound_tree.hpp"

namespace {

using curvewise::Control;
using curvewise::Stopped;
using curvewise::pairwise::BoundForest;
using curvewise::pairwise::BoundRows;
using curvewise::pairwise::BoundTree;
using curvewise::runtime::Poller;
using test::Random;

constexpr std::ptrdiff_t width = 3;  // of a row, whose last number does not divide

struct Rows {
    explicit Rows(std::ptrdiff_t count) : points(Random(31).curve(count, width).values()) {
        for (std::size_t k = 0; k < points.size(); k += 5) points[k] = 0.5;
    }
    const double* operator[](std::ptrdiff_t j) const { return points.data() + j * width; }
    BoundRows rows() const {
        return {{width, width - 1},
                [this](std::ptrdiff_t j, double* row) { std::copy_n((*this)[j], width, row); }};
    }

    std::vector<double> points;
};

// Box b of a level holds the rows of its leaves, from the first on.
void check_boxes(const BoundTree& tree, const Rows& rows, std::ptrdiff_t first) {
    std::vector<std::uint32_t> places;
    for (std::ptrdiff_t b = 0; b < tree.boxes(0); ++b) {
        const BoundTree::Leaf leaf = tree.leaf(b);
        CHECK(leaf.count >= 1 && leaf.count <= BoundTree::leaf_rows);
        places.insert(places.end(), leaf.places, leaf.places + leaf.count);
    }
    std::ptrdiff_t held = BoundTree::leaf_rows;
    for (int level = 0; level < tree.levels(); ++level, held *= BoundTree::fan) {
        for (std::ptrdiff_t b = 0; b < tree.boxes(level); ++b) {
            const auto begin = static_cast<std::size_t>(b * held);
            const std::size_t end = std::min(begin + static_cast<std::size_t>(held), places.size());
            CHECK(begin < end);
            for (std::ptrdiff_t c = 0; c < width; ++c) {
                double least = 2.0, greatest = -2.0;
                for (std::size_t k = begin; k < end; ++k) {
                    const double number = rows[first + places[k]][c];
                    least = std::min(least, number);
                    greatest = std::max(greatest, number);
                }
                CHECK_EQUAL(tree.box(level, b)[c], least);
                CHECK_EQUAL(tree.box(level, b)[width + c], greatest);
            }
        }
    }
    CHECK(tree.boxes(tree.levels() - 1) <= BoundTree::fan);
    std::sort(places.begin(), places.end());
    CHECK_EQUAL(static_cast<std::ptrdiff_t>(places.size()), tree.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        CHECK_EQUAL(places[k], static_cast<std::uint32_t>(k));
    }
}

void boxes_are_those_of_their_rows() {
    const Rows rows(25000);
    const std::ptrdiff_t leaf = BoundTree::leaf_rows;
    Poller poller(nullptr);
    for (const std::ptrdiff_t size :
         {std::ptrdiff_t{1}, std::ptrdiff_t{2}, leaf - 1, leaf, leaf + 1, 2 * leaf, 8 * leaf - 1,
          8 * leaf, 8 * leaf + 1, 64 * leaf - 1, 64 * leaf, 64 * leaf + 1, 512 * leaf,
          512 * leaf + 1}) {
        const check::Note note(std::to_string(size) + " rows");
        const BoundTree tree(rows.rows(), 7, size, poller);
        CHECK_EQUAL(tree.size(), size);
        check_boxes(tree, rows, 7);
    }
}

// Each row is in one tree at most, trees are few, and rows are divided few times.
void forests_grow_in_pieces() {
    const std::ptrdiff_t all = 40000;
    const Rows rows(all);
    Poller poller(nullptr);
    for (const std::ptrdiff_t piece : {1, 7, 255, 256, 300, 5000}) {
        const check::Note note("pieces of " + std::to_string(piece));
        BoundForest forest;
        std::ptrdiff_t size = 0, divided = 0;
        while (size + piece <= all) {
            const std::ptrdiff_t begin = size;
            const BoundRows added{{width, width - 1}, [&](std::ptrdiff_t j, double* row) {
                                      std::copy_n(rows[begin + j], width, row);
                                  }};
            const BoundForest others = BoundForest().with(0, {}, piece, added, poller);
            CHECK_EQUAL(others.size(), piece < BoundForest::fewest_rows ? 0 : piece);
            BoundRows counted{{width, width - 1}, [&](std::ptrdiff_t j, double* row) {
                                  ++divided;
                                  std::copy_n(rows[j], width, row);
                              }};
            size += piece;
            forest = forest.with(begin, others, size, counted, poller);
            CHECK(size - forest.size() < BoundForest::fewest_rows);
            CHECK(forest.trees().size() <= 10);
        }
        std::ptrdiff_t first = 0;
        for (const BoundForest::Planted& planted : forest.trees()) {
            CHECK_EQUAL(planted.first, first);
            check_boxes(*planted.tree, rows, first);
            first += planted.tree->size();
        }
        CHECK_EQUAL(first, forest.size());
        CHECK(divided <= 9 * all);
    }
}

void large_trees_are_not_merged() {
    const std::ptrdiff_t half = BoundForest::most_merged_rows / 2;
    const Rows rows(4 * half + 10);
    Poller poller(nullptr);
    const auto added = [&](std::ptrdiff_t first, std::ptrdiff_t count) {
        const BoundRows part{{width, width - 1}, [&, first](std::ptrdiff_t j, double* row) {
                                 std::copy_n(rows[first + j], width, row);
                             }};
        return BoundForest().with(0, {}, count, part, poller);
    };
    const auto sizes = [](const BoundForest& forest) {
        std::vector<std::ptrdiff_t> all;
        for (const BoundForest::Planted& planted : forest.trees()) {
            all.push_back(planted.tree->size());
        }
        return all;
    };
    using Sizes = std::vector<std::ptrdiff_t>;
    BoundForest forest = added(0, half);
    forest = forest.with(half, added(half, half), 2 * half, rows.rows(), poller);
    CHECK_EQUAL(sizes(forest), Sizes{2 * half});
    // 3 rows in no tree are in one of their own before a tree that comes behind them.
    forest = forest.with(2 * half, {}, 2 * half + 3, rows.rows(), poller);
    CHECK_EQUAL(sizes(forest), Sizes{2 * half});
    const BoundForest large = added(2 * half + 3, 2 * half);
    forest = forest.with(2 * half + 3, large, 4 * half + 3, rows.rows(), poller);
    CHECK_EQUAL(sizes(forest), (Sizes{2 * half, 3, 2 * half}));
    CHECK(forest.trees()[2].tree == large.trees()[0].tree);
    CHECK_EQUAL(forest.trees()[2].first, 2 * half + 3);
}

void rows_without_bounds_have_no_trees() {
    Poller poller(nullptr);
    CHECK_EQUAL(BoundForest().with(0, {}, 1000, {}, poller).size(), 0);
}

void a_control_ends_the_division() {
    const Rows rows(5000);
    Control control;
    control.stop();
    Poller poller(&control);
    CHECK_THROWS(BoundTree(rows.rows(), 0, 5000, poller), Stopped,
                 "stopped before the work was done");
}

}  // namespace

int main() {
    return check::run({{"boxes are those of their rows", boxes_are_those_of_their_rows},
                       {"forests grow in pieces", forests_grow_in_pieces},
                       {"large trees are not merged", large_trees_are_not_merged},
                       {"rows without bounds have no trees", rows_without_bounds_have_no_trees},
                       {"a control ends the division", a_control_ends_the_division}});
}
