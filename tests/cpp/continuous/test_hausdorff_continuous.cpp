// The Hausdorff distance of lines against values by hand and dense points; witnesses; batches with
// a cutoff; messages.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "check.hpp"
#include "continuous/boxed_curve.hpp"
#include "continuous/nearest.hpp"
#include "curves.hpp"
#include "curvewise/hausdorff_continuous.hpp"
#include "curvewise/pairwise.hpp"

namespace {

using curvewise::hausdorff_continuous;
using curvewise::hausdorff_continuous_points;
using curvewise::HausdorffContinuousOptions;
using curvewise::HausdorffPoints;
using test::Curve;
using test::Random;

constexpr HausdorffContinuousOptions directed{true};

void values_by_hand() {
    const Curve square{{0.0, 0.0}, {10.0, 0.0}, {10.0, 6.0}, {0.0, 6.0}, {0.0, 0.0}};
    const Curve open{{0.0, 0.0}, {0.0, 6.0}, {10.0, 6.0}, {10.0, 0.0}};
    CHECK_EQUAL(hausdorff_continuous(square, open), 5.0);
    CHECK_EQUAL(hausdorff_continuous(square, open, directed), 5.0);
    CHECK_EQUAL(hausdorff_continuous(open, square, directed), 0.0);
    const HausdorffPoints found = hausdorff_continuous_points(square, open);
    CHECK_EQUAL(found.distance, 5.0);
    CHECK_EQUAL(found.from_p.distance, 5.0);
    CHECK_EQUAL(found.from_p.parameter, 0.5);
    CHECK_EQUAL(found.from_q.distance, 0.0);
    CHECK_EQUAL(hausdorff_continuous(Curve{{1.0}}, Curve{{-2.0}}), 3.0);
    CHECK_EQUAL(hausdorff_continuous(Curve{{5.0, 3.0}}, Curve{{0.0, 0.0}, {10.0, 0.0}}, directed),
                3.0);
}

double distance_from(const std::vector<double>& z, const Curve& curve) {
    curvewise::runtime::Poller poller(nullptr);
    const curvewise::continuous::BoxedCurve boxed(curve, curvewise::curves::RangeScale(1.0),
                                                  poller);
    const curvewise::continuous::NearestEdges<0> edges(boxed, poller);
    double least = std::numeric_limits<double>::infinity();
    for (std::ptrdiff_t edge = 0; edge < boxed.size() - 1; ++edge) {
        least = std::min(least, edges.square_to_edge(z.data(), edge));
    }
    return std::sqrt(least);
}

std::vector<double> point_at(const Curve& curve, double parameter) {
    const auto edge = std::min(static_cast<std::ptrdiff_t>(parameter), curve.size() - 2);
    std::vector<double> z;
    for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
        const double x = curve(edge, c), y = curve(edge + 1, c);
        z.push_back(x + (parameter - static_cast<double>(edge)) * (y - x));
    }
    return z;
}

void witnesses_of_random_curves() {
    Random random(5);
    for (int round = 0; round < 60; ++round) {
        const Curve P = random.walk(2 + random.index(70)), Q = random.walk(2 + random.index(70));
        const HausdorffPoints found = hausdorff_continuous_points(P, Q);
        CHECK_EQUAL(found.distance, std::max(found.from_p.distance, found.from_q.distance));
        CHECK_EQUAL(found.distance, hausdorff_continuous(Q, P));
        const double value = found.from_p.distance;
        CHECK(std::abs(distance_from(point_at(P, found.from_p.parameter), Q) - value) < 1e-12);
        // No place between the vertices is farther.
        for (std::ptrdiff_t k = 0; k <= 10 * (P.size() - 1); ++k) {
            CHECK(distance_from(point_at(P, static_cast<double>(k) / 10), Q) < value + 1e-12);
        }
    }
}

void a_cutoff_changes_no_value_below_it() {
    Random random(5);
    std::vector<Curve> curves;
    for (int k = 0; k < 6; ++k) curves.push_back(random.walk(3 + random.index(30)));
    const std::vector<curvewise::CurveView> views(curves.begin(), curves.end());
    for (const HausdorffContinuousOptions& options : {HausdorffContinuousOptions{}, directed}) {
        std::vector<double> all(36), cut(36);
        curvewise::cdist(views, views, options, all.data());
        std::vector<double> sorted = all;
        std::sort(sorted.begin(), sorted.end());
        curvewise::BatchOptions batch;
        batch.cutoff = sorted[18];
        curvewise::cdist(views, views, options, cut.data(), batch);
        for (std::size_t k = 0; k < all.size(); ++k) {
            const bool is_within = all[k] <= batch.cutoff;
            CHECK_EQUAL(cut[k], is_within ? all[k] : std::numeric_limits<double>::infinity());
        }
    }
}

void messages() {
    const Curve P{{0.0, 0.0}}, Q{{0.0}};
    CHECK_THROWS(hausdorff_continuous(P, Q), std::invalid_argument,
                 "P has shape (1, 2) and Q has shape (1, 1); both need the same number of "
                 "coordinates");
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"witnesses of random curves", witnesses_of_random_curves},
                       {"a cutoff changes no value below it", a_cutoff_changes_no_value_below_it},
                       {"messages", messages}});
}
