// closed_dtw and closed_frechet against open curves from every point of both.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/closed_curves.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"

namespace {

using curvewise::ClosedOptions;
using curvewise::CurveView;
using test::Curve;
using test::Random;

// Points of a small grid, with ties, or of any place.
std::vector<double> points(Random& random, std::ptrdiff_t count, bool on_grid) {
    std::vector<double> result(static_cast<std::size_t>(2 * count));
    for (double& x : result) {
        x = random.uniform(-2.0, 2.0);
        if (on_grid) x = std::round(x);
    }
    return result;
}

bool closes(const std::vector<double>& points) {
    const std::size_t last = points.size() - 2;
    return last > 0 && points[0] == points[last] && points[1] == points[last + 1];
}

std::vector<double> turned(const std::vector<double>& points, std::ptrdiff_t begin) {
    std::vector<double> result = points;
    std::rotate(result.begin(), result.begin() + 2 * begin, result.end());
    return result;
}

CurveView view(const std::vector<double>& points) {
    return CurveView(points.data(), static_cast<std::ptrdiff_t>(points.size() / 2), 2);
}

void random_curves_from_every_point() {
    Random random(11);
    for (int round = 0; round < 300; ++round) {
        const std::ptrdiff_t n = 1 + round % 7, m = 1 + round % 11;
        const auto p = points(random, n, round % 2 == 0), q = points(random, m, round % 2 == 0);
        if (closes(p) || closes(q)) continue;
        double sum = std::numeric_limits<double>::infinity(), maximum = sum;
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            for (std::ptrdiff_t j = 0; j < m; ++j) {
                const auto a = turned(p, i), b = turned(q, j);
                sum = std::min(sum, curvewise::dtw(view(a), view(b)));
                maximum = std::min(maximum, curvewise::frechet(view(a), view(b)));
            }
        }
        CHECK_CLOSE(curvewise::closed_dtw(view(p), view(q)), sum, 1e-13);
        CHECK_EQUAL(curvewise::closed_frechet(view(p), view(q)), maximum);
        CHECK_EQUAL(curvewise::closed_frechet_path(view(p), view(q)).distance, maximum);
        CHECK_EQUAL(curvewise::closed_frechet(view(q), view(p)), maximum);
    }
}

void a_square_cut_elsewhere() {
    const Curve square{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    const Curve other{{1, 1}, {0, 1}, {0, 0}, {1, 0}};
    CHECK_EQUAL(curvewise::closed_dtw(square, other), 0.0);
    CHECK_EQUAL(curvewise::closed_frechet(square, other), 0.0);
    const curvewise::Alignment found = curvewise::closed_dtw_path(square, other);
    using Pair = std::array<std::int64_t, 2>;
    CHECK_EQUAL(found.path, (std::vector<Pair>{{0, 2}, {1, 3}, {2, 0}, {3, 1}}));
    ClosedOptions options;
    options.cutoff = 0.5;
    const Curve far{{9, 9}, {8, 9}};
    CHECK_EQUAL(curvewise::closed_frechet(square, far, options),
                std::numeric_limits<double>::infinity());
    CHECK(curvewise::closed_dtw_path(square, far, options).path.empty());
    CHECK_THROWS(curvewise::closed_dtw(square, Curve({}, 2)), std::invalid_argument,
                 "Q has shape (0, 2); dtw needs at least 1 point");
}

}  // namespace

int main() {
    return check::run({{"random curves from every point", random_curves_from_every_point},
                       {"a square cut elsewhere", a_square_cut_elsewhere}});
}
