// The boxes stored for a search against those of the tree. A stored box encloses its box exactly,
// and is only slightly larger, for one curve and for those of several lists put together.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "check.hpp"
#include "oracle.hpp"
#include "unpolled.hpp"
#include "warping/kept_boxes.hpp"

namespace {

using curvewise::curves::RangeScale;
using curvewise::warping::BoxLevel;
using curvewise::warping::BoxRoom;
using curvewise::warping::BoxTree;
using curvewise::warping::KeptBoxes;
using curvewise::warping::level_with;
using curvewise::warping::PackedCurve;
using curvewise::warping::PointOrder;

using test::Curve;
using test::Random;
using test::unpolled;

struct Side {
    explicit Side(const Curve& curve)
        : packed(curve, RangeScale(1.0), PointOrder::reversed, unpolled),
          tree(packed, PointOrder::reversed) {}
    PackedCurve packed;
    BoxTree tree;
};

// Small integers, walks, a constant; far from 0, very small, in units in the last place.
Curve some_curve(Random& random, std::ptrdiff_t dim) {
    const std::ptrdiff_t n = 1 + random.index(random.index(2) == 0 ? 30 : 900);
    Curve curve = random.index(2) == 0 ? random.lattice_curve(n, dim) : random.curve(n, dim);
    const double offsets[] = {0.0, 1e9, -1e-3, 0x1p52, -0x1p54};
    const double factors[] = {1.0, 0.0, 1e-7, 0x1p-300};
    const double offset = offsets[random.index(5)], factor = factors[random.index(4)];
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) curve(i, c) = curve(i, c) * factor + offset;
    }
    return curve;
}

void check_boxes(const BoxLevel& read, const BoxLevel& expected, const double* whole,
                 std::ptrdiff_t dim) {
    CHECK_EQUAL(read.level, expected.level);
    CHECK_EQUAL(read.count, expected.count);
    for (std::ptrdiff_t k = 0; k < read.count * 2 * dim; ++k) {
        const std::ptrdiff_t c = k % dim;
        const bool is_low = k % (2 * dim) < dim;
        CHECK(is_low ? read.boxes[k] <= expected.boxes[k] : read.boxes[k] >= expected.boxes[k]);
        CHECK(read.boxes[k] >= whole[c] && read.boxes[k] <= whole[dim + c]);
        // Two parts, and what rounding adds far from 0.
        const double extent = whole[dim + c] - whole[c];
        const double slack =
            extent * 0x1p-15 + 0x1p-52 * std::max(std::abs(whole[c]), std::abs(whole[dim + c]));
        CHECK(std::abs(read.boxes[k] - expected.boxes[k]) <= slack);
    }
}

void boxes_enclose(std::ptrdiff_t dim, Random& random) {
    BoxRoom room;
    for (std::ptrdiff_t j = 0; j < 9; ++j) {
        const Side side(some_curve(random, dim));
        const BoxTree& tree = side.tree;
        const check::Note note("curve " + std::to_string(j) + " of " + std::to_string(tree.size()));
        const double* const whole = tree.box(tree.levels() - 1, 0);
        constexpr std::uint16_t unwritten = 40503;
        const auto count = static_cast<std::size_t>(KeptBoxes::count(tree.size(), dim));
        std::vector<std::uint16_t> numbers(count + 1, unwritten);
        KeptBoxes::write(tree, numbers.data());
        CHECK_EQUAL(numbers[count], unwritten);
        const KeptBoxes kept{j, tree.size(), numbers.data()};
        for (const std::size_t limit : {1U, 0U, 2U}) {
            check_boxes(kept.read(limit, whole, dim, room),
                        level_with(tree, KeptBoxes::most_boxes[limit]), whole, dim);
        }
    }
}

void boxes_enclose_those_of_the_tree() {
    Random random(1);
    for (int round = 0; round < 60; ++round) {
        for (const std::ptrdiff_t dim : {1, 2, 3, 7}) boxes_enclose(dim, random);
    }
}

}  // namespace

int main() {
    return check::run({{"kept boxes enclose those of the tree", boxes_enclose_those_of_the_tree}});
}
