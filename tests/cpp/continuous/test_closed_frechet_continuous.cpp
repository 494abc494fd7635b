// closed_frechet_continuous against open curves from many places of the edges, on grids whose
// places are exact, and against curves that are the same closed curves.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include "check.hpp"
#include "continuous/boxed_curve.hpp"
#include "continuous/closed_leash.hpp"
#include "continuous/plain_range.hpp"
#include "curves.hpp"
#include "curves/ring.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "unpolled.hpp"

namespace {

using curvewise::closed_frechet_continuous;
using curvewise::closed_frechet_continuous_bounds;
using curvewise::closed_frechet_continuous_path;
using curvewise::CurveView;
using curvewise::frechet_continuous;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::ptrdiff_t parts = 16;  // of an edge

using Points = std::vector<std::array<double, 2>>;

CurveView view(const Points& points) {
    return CurveView(points.data()->data(), static_cast<std::ptrdiff_t>(points.size()), 2);
}

// Quarters; the last point is not the first one.
Points ring(Random& random, std::size_t count) {
    Points points(count);
    for (auto& point : points) {
        for (double& x : point) x = std::round(random.uniform(-8.0, 8.0)) / 4.0;
    }
    if (count > 1 && points.front() == points.back()) points.back()[0] += 0.25;
    return points;
}

// A closed curve from a part of an edge on, once around.
Points from_place(const Points& points, std::size_t edge, std::ptrdiff_t part) {
    Points turned = points;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(edge), turned.end());
    const auto& x = turned[0];
    const auto& y = turned[1 % turned.size()];
    const double t = static_cast<double>(part) / static_cast<double>(parts);
    const std::array<double, 2> place{x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1])};
    Points result{place};
    result.insert(result.end(), turned.begin() + 1, turned.end());
    result.push_back(x);
    result.push_back(place);
    return result;
}

double longest_edge(const Points& points) {
    double longest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto &x = points[i], &y = points[(i + 1) % points.size()];
        longest = std::max(longest, std::hypot(x[0] - y[0], x[1] - y[1]));
    }
    return longest;
}

void random_curves_from_many_places() {
    Random random(5);
    for (std::size_t round = 0; round < 120; ++round) {
        const Points p = ring(random, 1 + round % 5), q = ring(random, 1 + round % 7);
        const double value = closed_frechet_continuous(view(p), view(q));
        const Points once = from_place(p, 0, 0);
        double least = infinity;
        for (std::size_t edge = 0; edge < q.size(); ++edge) {
            for (std::ptrdiff_t part = 0; part < parts; ++part) {
                const Points other = from_place(q, edge, part);
                least = std::min(least, frechet_continuous(view(once), view(other)));
            }
        }
        CHECK(value <= least);
        CHECK(value >= least - longest_edge(q) / (2.0 * parts) * (1.0 + 1e-12));
        const auto bounds = closed_frechet_continuous_bounds(view(p), view(q));
        CHECK_EQUAL(bounds.high, value);
        CHECK(bounds.low == value || bounds.low == std::nextafter(value, 0.0));
        // The same closed curves, which are cut elsewhere, on one's edges too.
        const std::size_t i = round % p.size(), j = round % q.size();
        const Points other_p = from_place(p, i, 0), other_q = from_place(q, j, 5);
        CHECK_EQUAL(closed_frechet_continuous(view(other_q), view(other_p)), value);
        CHECK_EQUAL(closed_frechet_continuous(view(q), view(other_q)), 0.0);
        const auto path = closed_frechet_continuous_path(view(p), view(q));
        CHECK(path.distance >= value && path.distance <= value * (1.0 + 1e-13) + 1e-14);
        CHECK_EQUAL(path.parameters.front()[0], 0.0);
        CHECK_EQUAL(path.parameters.back()[0], static_cast<double>(p.size()));
        CHECK_CLOSE(path.parameters.back()[1] - path.parameters.front()[1],
                    static_cast<double>(q.size()), 1e-14);
    }
}

// Whether a path leads around: one decision, which tries all beginnings.
bool leads_around(const CurveView& P, const CurveView& Q, double distance) {
    const curvewise::curves::RingPoints p(P, {1, 0}, test::unpolled), q(Q, {2, 0}, test::unpolled);
    const curvewise::curves::RangeScale range = curvewise::continuous::plain_scale(1.0);
    const curvewise::continuous::BoxedCurve first(p.view(), range, test::unpolled),
        second(q.view(), range, test::unpolled);
    curvewise::continuous::ClosedLeashSearch<2> search(p.view(), q.view(), first, second, range,
                                                       test::unpolled);
    return search.is_within(distance);
}

void values_by_hand() {
    const Curve square{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}};
    const Curve on_edge{{1.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}, {0.0, 0.0}};
    CHECK_EQUAL(closed_frechet_continuous(square, on_edge), 0.0);
    const Curve backwards{{0.0, 2.0}, {2.0, 2.0}, {2.0, 0.0}, {0.0, 0.0}};
    CHECK_EQUAL(closed_frechet_continuous(square, backwards), 2.0);
    CHECK_EQUAL(closed_frechet_continuous(square, Curve{{1.0, 1.0}}), 1.4142135623730951);
    CHECK_EQUAL(closed_frechet_continuous_bounds(square, Curve{{1.0, 1.0}}).low,
                1.4142135623730949);
    CHECK_EQUAL(closed_frechet_continuous(Curve{{0.0}, {2.0}}, Curve{{0.5}, {3.0}}), 1.0);
    // The first point that is reached again lies behind the beginning, on the same edge.
    const Curve P{{-0.7, -2.0}, {1.6, 1.9}, {-1.6, 1.1}}, Q{{-0.3, -0.8}, {0.6, 1.7}, {1.2, -0.9}};
    CHECK_EQUAL(closed_frechet_continuous(P, Q), 2.2785763345474193);
    CHECK_EQUAL(closed_frechet_continuous(Q, P), 2.2785763345474193);
    CHECK_EQUAL(closed_frechet_continuous(Curve{{1.7e308}}, Curve{{-1.7e308}}), infinity);
    CHECK_EQUAL(closed_frechet_continuous_path(square, on_edge).parameters.front()[1], 4.0);
    CHECK_THROWS(closed_frechet_continuous(square, Curve{{1.0}}), std::invalid_argument,
                 "P has shape (4, 2) and Q has shape (1, 1); both need the same number of "
                 "coordinates");
}

// Noise, for which many free sections have to be tried: the value suffices, and the double below it
// does not.
void least_doubles_of_noise() {
    Random random(8);
    for (const std::ptrdiff_t size : {12, 40, 90, 200}) {
        for (int round = 0; round < 6; ++round) {
            const Curve P = random.curve(size, 2), Q = random.curve(size - size / 10, 2);
            const double value = closed_frechet_continuous(P, Q);
            CHECK_EQUAL(closed_frechet_continuous(Q, P), value);
            CHECK(leads_around(P, Q, value));
            CHECK(!leads_around(P, Q, std::nextafter(value, 0.0)));
        }
    }
}

// Values among the least doubles, which are fewer than the strides of the search.
void small_numbers() {
    const Curve P{{0.0, 0.0}, {5.0, 1.0}, {2.0, 7.0}, {6.0, 3.0}};
    const Curve Q{{1.0, 6.0}, {4.0, 4.0}, {0.0, 3.0}, {7.0, 0.0}, {2.0, 2.0}};
    const double value = closed_frechet_continuous(P, Q);
    const double least =
        closed_frechet_continuous(P.times_power_of_two(-1074), Q.times_power_of_two(-1074));
    CHECK_EQUAL(least, std::ceil(value) * 0x1p-1074);
}

}  // namespace

int main() {
    return check::run({{"values by hand", values_by_hand},
                       {"random curves from many places", random_curves_from_many_places},
                       {"least doubles of noise", least_doubles_of_noise},
                       {"small numbers", small_numbers}});
}
