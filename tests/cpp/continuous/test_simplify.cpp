// Simplification: values by hand, every edge of random curves by frechet_within(), points in any
// memory, messages.
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "curvewise/simplify.hpp"

namespace {

using curvewise::CurveView;
using curvewise::EdgeMeasure;
using curvewise::frechet_within;
using curvewise::simplify;
using test::Curve;
using test::Random;
using Rows = std::vector<std::int64_t>;

void values_by_hand() {
    const Curve track{{0.0, 0.0}, {4.0, 1.0}, {8.0, -1.0}, {12.0, 0.0}, {12.0, 6.0}};
    CHECK((simplify(track, 2.0) == Rows{0, 3, 4}));
    CHECK((simplify(track, 2.0, EdgeMeasure::hausdorff) == Rows{0, 3, 4}));
    CHECK((simplify(track, 0.0) == Rows{0, 1, 2, 3, 4}));
    const Curve back{{0.0}, {9.0}, {5.0}, {10.0}};
    CHECK((simplify(back, 2.0) == Rows{0, 3}));
    CHECK((simplify(back, std::nextafter(2.0, 0.0)) == Rows{0, 1, 2, 3}));
    CHECK((simplify(back, 0.0, EdgeMeasure::hausdorff) == Rows{0, 3}));
    CHECK((simplify(Curve{{1.0, 2.0}}, 0.0) == Rows{0}));
    CHECK((simplify(track, std::numeric_limits<double>::infinity()) == Rows{0, 4}));
}

// The fewest edges from each vertex to the last one, by a decision on every edge.
Rows fewest(const std::vector<double>& points, std::ptrdiff_t dim, double tolerance) {
    const auto n = static_cast<std::ptrdiff_t>(points.size()) / dim;
    std::vector<std::ptrdiff_t> edges(static_cast<std::size_t>(n), 0);
    Rows next(static_cast<std::size_t>(n), n - 1);
    for (std::ptrdiff_t i = n - 2; i >= 0; --i) {
        std::ptrdiff_t least = n;
        const double* const x = points.data() + i * dim;
        for (std::ptrdiff_t j = n - 1; j > i; --j) {
            std::vector<double> edge(x, x + dim);
            edge.insert(edge.end(), points.data() + j * dim, points.data() + (j + 1) * dim);
            if (edges[static_cast<std::size_t>(j)] >= least ||
                !frechet_within(CurveView(x, j - i + 1, dim), CurveView(edge.data(), 2, dim),
                                tolerance)) {
                continue;
            }
            least = edges[static_cast<std::size_t>(j)];
            next[static_cast<std::size_t>(i)] = j;
        }
        edges[static_cast<std::size_t>(i)] = least + 1;
    }
    Rows rows{0};
    while (rows.back() < n - 1) rows.push_back(next[static_cast<std::size_t>(rows.back())]);
    return rows;
}

void every_edge() {
    Random random(7);
    for (const std::ptrdiff_t dim : {1, 2, 3, 4}) {
        for (int trial = 0; trial < 20; ++trial) {
            std::vector<double> points(static_cast<std::size_t>(60 * dim));
            for (std::size_t k = 0; k < points.size(); ++k) {
                const std::size_t before = static_cast<std::size_t>(dim);
                points[k] = (k < before ? 0.0 : points[k - before]) + random.uniform(-1.0, 1.5);
            }
            const CurveView curve(points.data(), 60, dim);
            for (const double tolerance : {0.5, 1.0, 3.0}) {
                CHECK((simplify(curve, tolerance) == fewest(points, dim, tolerance)));
            }
        }
    }
}

void columns_and_scales() {
    const Curve track{{0.0, 0.0}, {4.0, 1.0}, {8.0, -1.0}, {12.0, 0.0}, {12.0, 6.0}};
    const double columns[] = {0.0, 4.0, 8.0, 12.0, 12.0, 0.0, 1.0, -1.0, 0.0, 6.0};
    CHECK((simplify(CurveView(columns, 5, 2, 1, 5), 2.0) == Rows{0, 3, 4}));
    for (const int exponent : {-600, 600}) {
        std::vector<double> scaled;
        for (const double x : columns) scaled.push_back(std::ldexp(x, exponent));
        const CurveView curve(scaled.data(), 5, 2, 1, 5);
        CHECK((simplify(curve, std::ldexp(2.0, exponent)) == Rows{0, 3, 4}));
    }
}

void messages() {
    const Curve track{{0.0, 0.0}, {1.0, 1.0}};
    CHECK_THROWS(simplify(track, -1.0), std::invalid_argument,
                 "tolerance is -1; give a number >= 0");
    CHECK_THROWS(simplify(Curve({}, 2), 1.0), std::invalid_argument,
                 "curve has shape (0, 2); simplify needs at least 1 point");
    CHECK_THROWS(simplify(Curve{{std::nan("")}}, 1.0), std::invalid_argument,
                 "curve[0, 0] is nan; curves must be finite");
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"every edge of random curves", every_edge},
                       {"columns and scales", columns_and_scales},
                       {"messages", messages}});
}
