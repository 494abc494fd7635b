// Box trees against their definition: every box holds its points, the distances of boxes bound
// those of all their points, and the nearest point is as near as the nearest of all. Comparisons
// are exact. Half of the data is small integers, so that distances reach their bounds.
#include <algorithm>
#include <limits>
#include <vector>

#include "check.hpp"
#include "oracle.hpp"
#include "unpolled.hpp"
#include "warping/box_tree.hpp"

namespace {

using curvewise::Metric;
using curvewise::curves::RangeScale;
using curvewise::runtime::Poller;
using curvewise::warping::BoxTree;
using curvewise::warping::Nearest;
using curvewise::warping::NearestSearch;
using curvewise::warping::PackedCurve;
using curvewise::warping::PointAccess;
using curvewise::warping::PointOrder;
using curvewise::warping::with_norm;

using test::Curve;
using test::Random;
using test::unpolled;

struct Side {
    Side(const Curve& curve, PointOrder order)
        : packed(curve, RangeScale(1.0), order, unpolled), tree(packed, order) {}
    PackedCurve packed;
    BoxTree tree;
};

std::ptrdiff_t points_per_box(std::ptrdiff_t level) { return BoxTree::leaf_points << level; }

void check_boxes(const Curve& curve, const BoxTree& tree) {
    CHECK_EQUAL(tree.boxes(tree.levels() - 1), 1);
    for (std::ptrdiff_t level = 0; level < tree.levels(); ++level) {
        for (std::ptrdiff_t b = 0; b < tree.boxes(level); ++b) {
            const std::ptrdiff_t first = b * points_per_box(level);
            const std::ptrdiff_t end = std::min(first + points_per_box(level), curve.size());
            for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
                double low = curve(first, c), high = low;
                for (std::ptrdiff_t i = first; i < end; ++i) {
                    low = std::min(low, curve(i, c));
                    high = std::max(high, curve(i, c));
                }
                CHECK_EQUAL(tree.box(level, b)[c], low);
                CHECK_EQUAL(tree.box(level, b)[curve.dim() + c], high);
            }
        }
    }
}

// All pairs of boxes of one level of each tree.
template <class Norm>
void check_bounds(const BoxTree& P, const BoxTree& Q, std::ptrdiff_t p_level,
                  std::ptrdiff_t q_level) {
    for (std::ptrdiff_t a = 0; a < P.boxes(p_level); ++a) {
        for (std::ptrdiff_t b = 0; b < Q.boxes(q_level); ++b) {
            const double* const p = P.box(p_level, a);
            const double* const q = Q.box(q_level, b);
            const double smallest = curvewise::warping::smallest_distance<Norm>(p, q, P.dim());
            const double largest = curvewise::warping::largest_distance<Norm>(p, q, P.dim());
            const std::ptrdiff_t i_end = std::min((a + 1) * points_per_box(p_level), P.size());
            const std::ptrdiff_t j_end = std::min((b + 1) * points_per_box(q_level), Q.size());
            for (std::ptrdiff_t i = a * points_per_box(p_level); i < i_end; ++i) {
                for (std::ptrdiff_t j = b * points_per_box(q_level); j < j_end; ++j) {
                    const double d = curvewise::warping::point_distance<Norm>(
                        P.points(), i, Q.points(), j, P.dim());
                    CHECK(smallest <= d);
                    CHECK(d <= largest);
                }
            }
        }
    }
}

template <class Norm>
void check_nearest(const BoxTree& P, const BoxTree& Q, Metric metric, Random& random) {
    NearestSearch<Norm> search(P.points(), Q);
    Poller poller(nullptr);
    std::vector<double> distances(static_cast<std::size_t>(P.size()));
    nearest_distances(P.points(), P.size(), Q, metric, poller, distances.data());
    for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
        double expected = std::numeric_limits<double>::infinity();
        for (std::ptrdiff_t j = 0; j < Q.size(); ++j) {
            expected = std::min(expected, curvewise::warping::point_distance<Norm>(
                                              P.points(), i, Q.points(), j, P.dim()));
        }
        CHECK_EQUAL(distances[static_cast<std::size_t>(i)], expected);
        const std::ptrdiff_t start = random.index(Q.size());
        const Nearest nearest = search(i, start, -1.0);
        CHECK_EQUAL(nearest.distance, expected);
        CHECK_EQUAL(curvewise::warping::point_distance<Norm>(P.points(), i, Q.points(),
                                                             nearest.point, P.dim()),
                    expected);
        const double enough = expected * random.uniform(0.5, 3.0);
        const double found = search(i, start, enough).distance;
        CHECK(found == expected || (expected <= found && found <= enough));
    }
}

void compare(const Curve& P, const Curve& Q, Random& random) {
    const check::Note note(test::described(P, Q));
    const Side rows(P, PointOrder::forward), columns(Q, PointOrder::reversed);
    check_boxes(P, rows.tree);
    check_boxes(Q, columns.tree);
    for (const Metric metric : oracle::metrics) {
        with_norm(metric, [&](auto norm) {
            using Norm = decltype(norm);
            for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
                for (std::ptrdiff_t j = 0; j < Q.size(); ++j) {
                    CHECK_EQUAL(curvewise::warping::point_distance<Norm>(
                                    rows.tree.points(), i, columns.tree.points(), j, P.dim()),
                                oracle::ground_distance({metric}, P, i, Q, j));
                }
            }
            for (std::ptrdiff_t p = 0; p < rows.tree.levels(); ++p) {
                for (std::ptrdiff_t q = 0; q < columns.tree.levels(); ++q) {
                    check_bounds<Norm>(rows.tree, columns.tree, p, q);
                }
            }
            check_nearest<Norm>(rows.tree, columns.tree, metric, random);
            check_nearest<Norm>(columns.tree, rows.tree, metric, random);
        });
    }
}

void boxes_bounds_and_neighbours() {
    Random random(1);
    for (const std::ptrdiff_t dim : {1, 2, 3, 4, 7}) {
        for (const std::ptrdiff_t n : {1, 7, 8, 9, 16, 17, 40, 63, 64, 65}) {
            for (const std::ptrdiff_t m : {1, 8, 31, 66}) {
                compare(random.curve(n, dim), random.curve(m, dim), random);
                compare(random.lattice_curve(n, dim), random.lattice_curve(m, dim), random);
            }
        }
    }
    compare(random.walk(150), random.walk(170), random);
}

}  // namespace

int main() { return check::run({{"boxes, bounds and neighbours", boxes_bounds_and_neighbours}}); }
