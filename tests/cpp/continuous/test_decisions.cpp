// Decisions of the continuous Fréchet distance. Filters decide most of them (vertex_walk.hpp, the
// negative filter of leash_search.hpp). Here each is compared with the whole walk through the rows
// of the diagram, which has no filter, at radii on either side of the value and at the value. Also
// tests the walk over vertices against all pairs of vertices.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "check.hpp"
#include "continuous/coupling.hpp"
#include "continuous/reachable.hpp"
#include "continuous/vertex_walk.hpp"
#include "curves.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "curvewise/nearest.hpp"
#include "hard_curves.hpp"

namespace {

using curvewise::frechet_continuous;
using curvewise::frechet_within;
using curvewise::continuous::BoxedCurve;
using curvewise::continuous::CouplingWalk;
using curvewise::continuous::Diagram;
using curvewise::continuous::ExactSigns;
using curvewise::continuous::FreeSet;
using curvewise::continuous::NumberSet;
using curvewise::continuous::Radius;
using curvewise::continuous::RangeScale;
using curvewise::continuous::Runs;
using curvewise::continuous::VertexWalk;
using curvewise::runtime::Poller;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Two curves of usual magnitude with all that the parts of a decision need.
class Pair {
   public:
    Pair(const Curve& P, const Curve& Q)
        : P_(P),
          Q_(Q),
          poller_(nullptr),
          p_(P, RangeScale(1.0), poller_),
          q_(Q, RangeScale(1.0), poller_) {}

    Radius radius(double distance, FreeSet set = FreeSet::closed) const {
        return {distance, RangeScale(1.0), P_.dim(), set};
    }
    // Without filters.
    bool path_exists(double distance) const {
        const Radius at_most = radius(distance);
        const Diagram<0> diagram({p_, q_, ExactSigns(P_, Q_)}, {q_, p_, ExactSigns(Q_, P_)});
        if (!diagram.corner_is_free(0, 0, at_most)) return false;
        Runs runs, next;
        diagram.start(at_most, runs);
        for (std::ptrdiff_t i = 0; i + 1 < diagram.rows(); ++i) {
            diagram.advance(i, runs, at_most, next);
            std::swap(runs, next);
        }
        return diagram.is_through(runs, at_most);
    }
    bool coupling_exists(double distance) {
        return CouplingWalk<0>({q_, p_, ExactSigns(Q_, P_)}, p_.size(), poller_)
            .succeeds(radius(distance));
    }
    VertexWalk<0> walk(const Radius& within) const {
        return {{P_.values().data(), P_.size(), P_.dim()},
                {Q_.values().data(), Q_.size(), Q_.dim()},
                ExactSigns(Q_, P_),
                within};
    }

   private:
    const Curve& P_;
    const Curve& Q_;
    Poller poller_;
    BoxedCurve p_, q_;
};

Curve any_curve(int kind, std::ptrdiff_t n, std::ptrdiff_t dim, Random& random) {
    if (kind == 0) return test::walk(n, dim, 1.0, random);
    if (kind == 1) return test::walk(n, dim, 0.2, random);
    const bool is_eight = kind == 2;
    if (kind == 2 || kind == 3) {
        Curve curve = test::loops(n, dim, 3.0, 0.0, is_eight);
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            for (std::ptrdiff_t c = 0; c < dim; ++c) curve(i, c) += random.uniform(-0.05, 0.05);
        }
        return curve;
    }
    return test::filled_curve(n, dim, [&](std::ptrdiff_t, std::ptrdiff_t) {
        return kind == 4 ? random.uniform(-1.0, 1.0)
                         : static_cast<double>(random.between(-2, 2));  // ties
    });
}

// Around a value.
std::vector<double> radii_around(double value) {
    return {0.5 * value, 0.9 * value,  0.99 * value, std::nextafter(value, 0.0),
            value,       1.01 * value, 1.1 * value,  std::nextafter(value, infinity),
            1.5 * value, 2.0 * value};
}

void check_decisions(const Curve& P, const Curve& Q) {
    const Pair pair(P, Q);
    const double value = frechet_continuous(P, Q);
    std::vector<double> columns;  // of P
    for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
        for (std::ptrdiff_t i = 0; i < P.size(); ++i) columns.push_back(P(i, c));
    }
    const curvewise::CurveView by_columns(columns.data(), P.size(), P.dim(), 1, P.size());
    const Curve large_p = P.times_power_of_two(900), large_q = Q.times_power_of_two(900);
    const Curve small_p = P.times_power_of_two(-900), small_q = Q.times_power_of_two(-900);
    for (const double radius : radii_around(value)) {
        const bool is_within = pair.path_exists(radius);
        CHECK_EQUAL(is_within, value <= radius);
        CHECK_EQUAL(frechet_within(P, Q, radius), is_within);
        CHECK_EQUAL(frechet_within(Q, P, radius), is_within);
        CHECK_EQUAL(frechet_within(by_columns, Q, radius), is_within);
        CHECK_EQUAL(frechet_within(large_p, large_q, std::ldexp(radius, 900)), is_within);
        CHECK_EQUAL(frechet_within(small_p, small_q, std::ldexp(radius, -900)), is_within);
    }
}

void decisions_without_filters() {
    Random random(56);
    for (int k = 0; k < 240; ++k) {
        const std::ptrdiff_t dims[] = {1, 2, 3, 4, 7};
        const std::ptrdiff_t dim = dims[k % 5];
        const int kind = k % 6;
        const std::ptrdiff_t most = k % 3 == 0 ? 120 : 20;
        const Curve P = any_curve(kind, random.between(1, most), dim, random);
        const Curve Q = any_curve(kind, random.between(1, most), dim, random);
        check_decisions(P, Q);
    }
}

// One vertex of a curve far from the other, anywhere: what the negative filter looks for.
void one_far_vertex() {
    Random random(57);
    for (std::ptrdiff_t place = 0; place < 80; ++place) {
        Curve P = any_curve(3, 80, 2, random);
        Curve Q = P;
        (place % 2 == 0 ? P : Q)(place, 1) += 3.0;
        check_decisions(P, Q);
        const std::vector<curvewise::CurveView> curves{Q, P};
        const curvewise::Index index(curves, curvewise::FrechetContinuousOptions{});
        for (const double radius : radii_around(frechet_continuous(P, Q))) {
            const auto found = index.radius_neighbors({P}, radius);
            CHECK_EQUAL(found[0].size(), frechet_within(P, Q, radius) ? 2U : 1U);
        }
    }
}

// At the distance of a pair of vertices, many of which are equal.
void walks_over_vertices() {
    Poller unwatched(nullptr);
    Random random(58);
    int successes = 0, couplings = 0;
    for (int k = 0; k < 400; ++k) {
        const int kind = k % 6;
        const Curve P = any_curve(kind, random.between(1, 24), 2, random);
        const Curve Q = any_curve(kind, random.between(1, 24), 2, random);
        Pair pair(P, Q);
        for (int trial = 0; trial < 10; ++trial) {
            const std::ptrdiff_t i = random.between(0, P.size() - 1);
            const std::ptrdiff_t j = random.between(0, Q.size() - 1);
            const double radius = std::hypot(P(i, 0) - Q(j, 0), P(i, 1) - Q(j, 1));
            VertexWalk<0> walk = pair.walk(pair.radius(radius));
            if (walk.misses_ends()) {
                CHECK(!pair.path_exists(radius));
                continue;
            }
            const bool exists = pair.coupling_exists(radius);
            const bool succeeds =
                walk.succeeds(unwatched, random.between(0, 8)) || walk.succeeds(unwatched);
            if (succeeds) CHECK(exists);
            successes += succeeds ? 1 : 0;
            couplings += exists ? 1 : 0;
        }
    }
    CHECK(couplings > 800);
    CHECK(successes > 0.9 * couplings);
}

void open_and_closed() {
    Poller unwatched(nullptr);
    const Curve P{{0, 0}, {3, 0}}, Q{{0, 1}, {3, 1}};
    const Pair pair(P, Q);
    CHECK(pair.walk(pair.radius(1.0)).succeeds(unwatched));
    CHECK(!pair.walk(pair.radius(1.0)).misses_ends());
    CHECK(pair.walk(pair.radius(1.0, FreeSet::open)).misses_ends());
    const Pair same(P, P);
    CHECK(!same.walk(same.radius(0.0)).misses_ends());
    CHECK(same.walk(same.radius(0.0)).succeeds(unwatched));
    CHECK(same.walk(same.radius(infinity)).succeeds(unwatched));
}

// The nearest pairs lead to (3, 1), from where the walk has to go back two steps.
void a_blind_alley() {
    Poller unwatched(nullptr);
    const Curve P({0, 3, 1, 2}, 1), Q({0, 2, 4, 1}, 1);
    const Pair pair(P, Q);
    VertexWalk<0> walk = pair.walk(pair.radius(1.0));
    CHECK(!walk.succeeds(unwatched, 0));
    CHECK_EQUAL(walk.furthest().i, 3);
    CHECK_EQUAL(walk.furthest().j, 1);
    CHECK(!walk.succeeds(unwatched, 1));
    CHECK(walk.succeeds(unwatched));  // goes on
    CHECK(!pair.walk(pair.radius(0.5)).succeeds(unwatched));
}

void numbers_in_a_set() {
    const std::ptrdiff_t strides[] = {1, 7, 1024, std::ptrdiff_t{1} << 40};
    for (const std::ptrdiff_t most : {1, 2, 7, 8, 9, 1000}) {
        for (const std::ptrdiff_t stride : strides) {
            NumberSet set(most);
            for (std::ptrdiff_t k = 0; k < most; ++k) {
                CHECK(!set.is_full());
                CHECK(!set.contains(k * stride));
                set.insert(k * stride);
                CHECK(set.contains(k * stride));
                CHECK(set.contains(0));
            }
            CHECK(set.is_full());
            CHECK(!set.contains(most * stride));
        }
    }
}

}  // namespace

int main() {
    return check::run({{"decisions without filters", decisions_without_filters},
                       {"one far vertex", one_far_vertex},
                       {"walks over vertices", walks_over_vertices},
                       {"open and closed", open_and_closed},
                       {"a blind alley", a_blind_alley},
                       {"numbers in a set", numbers_in_a_set}});
}
