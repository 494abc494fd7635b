// CurveView: the points of a view, in every layout that two strides describe; its name in messages;
// and the independence of all measures from the layout.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curve.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using curvewise::CurveView;
using test::Curve;
using test::Random;
using test::shape_of;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A curve of dimension 2 in memory of another layout; what lies between its numbers is nan, and
// an answer that used it would be nan too.
class Relaid {
   public:
    Relaid(std::string name, const Curve& curve, std::ptrdiff_t row_stride,
           std::ptrdiff_t col_stride)
        : name_(std::move(name)), n_(curve.size()), strides_{row_stride, col_stride} {
        const std::ptrdiff_t rows_reach = (n_ - 1) * row_stride;
        origin_ =
            3 + std::max<std::ptrdiff_t>(0, -rows_reach) + std::max<std::ptrdiff_t>(0, -col_stride);
        memory_.assign(static_cast<std::size_t>(6 + std::abs(rows_reach) + std::abs(col_stride)),
                       nan);
        for (std::ptrdiff_t i = 0; i < n_; ++i) {
            for (std::ptrdiff_t c = 0; c < 2; ++c) {
                memory_[static_cast<std::size_t>(origin_ + i * row_stride + c * col_stride)] =
                    curve(i, c);
            }
        }
    }
    CurveView view() const { return {memory_.data() + origin_, n_, 2, strides_[0], strides_[1]}; }
    const std::string& name() const { return name_; }

   private:
    std::string name_;
    std::ptrdiff_t n_;
    std::array<std::ptrdiff_t, 2> strides_;
    std::ptrdiff_t origin_;
    std::vector<double> memory_;
};

std::vector<Relaid> layouts(const Curve& curve) {
    const std::ptrdiff_t n = curve.size();
    return {{"row-major", curve, 2, 1},
            {"column-major", curve, 1, n},
            {"columns 0 and 2 of 5", curve, 5, 2},
            {"every third row", curve, 6, 1},
            {"rows reversed", curve, -2, 1},
            {"columns exchanged", curve, 2, -1},
            {"column-major, rows reversed", curve, -1, n + 3}};
}

void reading() {
    const std::vector<double> data{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    const CurveView dense(data.data(), 4, 3);
    CHECK_EQUAL(dense.size(), std::ptrdiff_t{4});
    CHECK_EQUAL(dense.dim(), std::ptrdiff_t{3});
    CHECK_EQUAL(dense(2, 1), 7.0);
    const CurveView transposed(data.data(), 3, 4, 1, 3);
    CHECK_EQUAL(transposed(2, 1), 5.0);
    const CurveView backwards(data.data() + 11, 4, 3, -3, -1);
    CHECK_EQUAL(backwards(0, 0), 11.0);
    CHECK_EQUAL(backwards(3, 2), 0.0);
    const CurveView repeated(data.data() + 5, 100, 1, 0, 1);
    CHECK_EQUAL(repeated(99, 0), 5.0);
}

void flat_lists() {
    const double value = 0.0;
    CHECK(CurveView(&value, 5, 1, 1, 0).is_flat());
    CHECK(!CurveView(&value, 5, 1).is_flat());
    CHECK(!CurveView(&value, 5, 2, 1, 0).is_flat());
}

std::vector<double> tables(const CurveView& P, const CurveView& Q) {
    const auto cells = static_cast<std::size_t>(P.size() * Q.size());
    std::vector<double> result(2 * cells);
    curvewise::dtw_table(P, Q, result.data());
    curvewise::frechet_table(P, Q, result.data() + cells);
    return result;
}

// Every function of the library that takes curves.
std::vector<double> answers(const CurveView& P, const CurveView& Q) {
    std::vector<double> result = tables(P, Q);
    result.insert(result.end(),
                  {curvewise::dtw(P, Q), curvewise::frechet(P, Q), curvewise::area(P, Q),
                   curvewise::pcm(P, Q), curvewise::curve_length(P, Q), curvewise::mse(P, Q),
                   curvewise::mae(P, Q), curvewise::sum_of_squares(P, Q)});
    for (const auto& path : {curvewise::dtw_path(P, Q).path, curvewise::frechet_path(P, Q).path}) {
        for (const auto& [i, j] : path) {
            result.insert(result.end(), {static_cast<double>(i), static_cast<double>(j)});
        }
    }
    for (const auto& quad : curvewise::area_quads(P, Q).quads) result.push_back(quad[2][1]);
    for (const auto& point : curvewise::pcm_match(P, Q).points) result.push_back(point[0]);
    std::vector<double> residuals(static_cast<std::size_t>(2 * P.size()));
    curvewise::curve_length_residuals(P, Q, residuals.data());
    result.insert(result.end(), residuals.begin(), residuals.end());
    curvewise::normalize(P, Q, residuals.data());
    result.insert(result.end(), residuals.begin(), residuals.end());
    return result;
}

void same_answers_in_every_layout() {
    Random random(91);
    const Curve P = random.walk(20), Q = random.walk(20);
    const std::vector<double> expected = answers(P, Q);
    for (const Relaid& p : layouts(P)) {
        for (const Relaid& q : layouts(Q)) {
            const check::Note note("P " + p.name() + ", Q " + q.name());
            CHECK(answers(p.view(), q.view()) == expected);
        }
    }
    const Curve R({5.0, 1.0, 4.0, 2.0}, 1), S({1.0, 1.0, 0.0}, 1);
    const CurveView flat_r(R.values().data(), 4, 1, 1, 0), flat_s(S.values().data(), 3, 1, 1, 0);
    CHECK_EQUAL(tables(flat_r, flat_s), tables(R, S));
    CHECK_EQUAL(tables(flat_r, S), tables(R, S));
}

// The first bad entry in row-major order, whatever lies first in memory.
void places_of_bad_entries() {
    Random random(92);
    const Curve P = random.walk(20);
    Curve Q = P;
    Q(18, 0) = -std::numeric_limits<double>::infinity();
    Q(17, 1) = nan;
    for (const Relaid& q : layouts(Q)) {
        const check::Note note("Q " + q.name());
        const auto refuses = [](auto call) {
            CHECK_THROWS(call(), std::invalid_argument, "Q[17, 1] is nan; curves must be finite");
        };
        const CurveView view = q.view();
        refuses([&] { return curvewise::dtw(P, view); });
        refuses([&] { return curvewise::frechet(P, view); });
        refuses([&] { return curvewise::area(P, view); });
        refuses([&] { return curvewise::pcm(P, view); });
        refuses([&] { return curvewise::curve_length(P, view); });
        refuses([&] { return curvewise::mae(P, view); });
    }
    const std::vector<double> flat{0.0, 1.0, nan};
    CHECK_THROWS(
        curvewise::dtw(CurveView(flat.data(), 3, 1, 1, 0), P), std::invalid_argument,
        "P has shape (3,) and Q has shape (20, 2); both need the same number of coordinates");
    CHECK_THROWS(curvewise::dtw(CurveView(flat.data(), 3, 1, 1, 0), Curve{{1.0}}),
                 std::invalid_argument, "P[2] is nan; curves must be finite");
    CHECK_THROWS(curvewise::dtw(CurveView(flat.data(), 3, 1), Curve{{1.0}}), std::invalid_argument,
                 "P[2, 0] is nan; curves must be finite");
    CHECK_THROWS(curvewise::frechet(CurveView(flat.data(), 0, 1, 1, 0), Curve{{1.0}}),
                 std::invalid_argument, "P has shape (0,); frechet needs at least 1 point");
}

// Columns, then matching dimensions, then points, then finite; P before Q in each.
void order_of_checks() {
    const CurveView no_columns(nullptr, 0, 0), no_points(nullptr, 0, 2);
    const Curve bad{{nan, 0.0}, {0.0, 0.0}}, line{{nan}}, good{{0.0, 0.0}, {1.0, 1.0}};
    CHECK_THROWS(curvewise::area(bad, no_columns), std::invalid_argument,
                 "Q has shape (0, 0); a curve needs at least 1 coordinate");
    CHECK_THROWS(
        curvewise::area(no_points, line), std::invalid_argument,
        "P has shape (0, 2) and Q has shape (1, 1); both need the same number of coordinates");
    CHECK_THROWS(curvewise::area(line, line), std::invalid_argument,
                 "P has shape (1, 1) and Q has shape (1, 1); area needs 2 coordinates, x and y");
    CHECK_THROWS(curvewise::area(bad, no_points), std::invalid_argument,
                 "Q has shape (0, 2); area needs at least 2 points");
    CHECK_THROWS(curvewise::area(bad, CurveView(nullptr, 0, 2, 2, 1)), std::invalid_argument,
                 "Q has shape (0, 2); area needs at least 2 points");
    CHECK_THROWS(curvewise::area(no_points, no_points), std::invalid_argument,
                 "P has shape (0, 2); area needs at least 2 points");
    CHECK_THROWS(curvewise::area(good, bad), std::invalid_argument,
                 "Q[0, 0] is nan; curves must be finite");
    CHECK_THROWS(curvewise::area(bad, bad), std::invalid_argument,
                 "P[0, 0] is nan; curves must be finite");
}

struct Plane {
    double x = 0.0, y = 0.0;
};
struct Space {
    double x, y, z;
};
class Private {
   public:
    Private(double x, double y) : xy_{x, y} {}
    double x() const { return xy_[0]; }

   private:
    double xy_[2];
};
struct WithNumber {
    double x;
    std::int64_t number;
};
struct WithFloats {
    double x;
    float y, z;
};

template <class Point>
constexpr bool is_viewed = std::is_convertible_v<const std::vector<Point>&, CurveView>;

static_assert(is_viewed<double> && is_viewed<Plane> && is_viewed<Space> && is_viewed<Private>);
static_assert(is_viewed<std::complex<double>> && is_viewed<std::array<double, 7>>);
static_assert(!is_viewed<WithNumber> && !is_viewed<WithFloats> && !is_viewed<float>);
static_assert(!is_viewed<int> && !is_viewed<std::array<float, 2>> && !is_viewed<std::string>);
static_assert(!is_viewed<std::array<double, 0>> && !is_viewed<std::vector<double>>);
// A temporary, whose view would outlive it.
static_assert(!std::is_constructible_v<CurveView, std::vector<double>>);
static_assert(!std::is_constructible_v<CurveView, std::vector<Plane>>);
static_assert(!std::is_constructible_v<CurveView, const std::vector<std::array<double, 2>>>);
static_assert(!std::is_constructible_v<CurveView, double (&&)[3]>);
#ifdef __cpp_lib_span
static_assert(std::is_convertible_v<std::span<const double>, CurveView>);
static_assert(std::is_convertible_v<std::span<Plane>, CurveView>);
static_assert(std::is_convertible_v<std::span<const Space, 4>, CurveView>);
#endif

void types_at_hand() {
    const std::vector<double> numbers{1, 2, 3};
    const CurveView flat(numbers);
    CHECK(flat.is_flat());
    CHECK_EQUAL(shape_of(flat), "(3,)");
    CHECK_EQUAL(flat(2, 0), 3.0);
    const std::vector<Plane> plane{{1, 2}, {3, 4}, {5, 6}};
    const std::vector<Space> space{{1, 2, 3}, {4, 5, 6}};
    const double rows[2][3] = {{1, 2, 3}, {4, 5, 6}}, line[] = {1, 2, 3};
    const Plane points[] = {{1, 2}, {3, 4}, {5, 6}};
    CHECK_EQUAL(shape_of(CurveView(plane)), "(3, 2)");
    CHECK_EQUAL(shape_of(CurveView(space)), "(2, 3)");
    CHECK_EQUAL(shape_of(CurveView(rows)), "(2, 3)");
    CHECK_EQUAL(shape_of(CurveView(line)), "(3,)");
    CHECK_EQUAL(shape_of(CurveView(points)), "(3, 2)");
    for (std::ptrdiff_t i = 0; i < 2; ++i) {
        for (std::ptrdiff_t c = 0; c < 3; ++c) {
            CHECK_EQUAL(CurveView(rows)(i, c), CurveView(space)(i, c));
        }
    }
    CHECK_EQUAL(curvewise::dtw(plane, points), 0.0);
    CHECK_EQUAL(curvewise::dtw(numbers, line), 0.0);
    const std::vector<Plane> none;
    CHECK_THROWS(curvewise::dtw(none, plane), std::invalid_argument,
                 "P has shape (0, 2); dtw needs at least 1 point");
}

}  // namespace

int main() {
    return check::run({{"reading", reading},
                       {"types at hand", types_at_hand},
                       {"flat lists", flat_lists},
                       {"same answers in every layout", same_answers_in_every_layout},
                       {"places of bad entries", places_of_bad_entries},
                       {"order of checks", order_of_checks}});
}
