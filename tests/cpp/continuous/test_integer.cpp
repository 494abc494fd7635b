// Whole numbers of any size: against 64-bit ones where those suffice, and by the laws of a ring
// where they do not. And the comparisons that are made with them, against roots in long double, of
// numbers that are far enough apart for it. And distances, which must be the real ones rounded up,
// against their squares as whole numbers.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "check.hpp"
#include "continuous/exact_signs.hpp"
#include "continuous/integer.hpp"
#include "curves.hpp"
#include "curvewise/frechet_continuous.hpp"

namespace {

using curvewise::frechet_continuous;
using curvewise::continuous::ExactSigns;
using curvewise::continuous::Integer;
using curvewise::continuous::Reach;
using test::Curve;

int sign_of(std::int64_t x) { return x < 0 ? -1 : x > 0 ? 1 : 0; }

bool equal(const Integer& a, const Integer& b) { return (a - b).sign() == 0; }

Integer whole(std::int64_t x) { return {x, 0}; }

void small_numbers() {
    const std::vector<std::int64_t> numbers{
        0, 1, -1, 2, 65535, -65536, 4294967295, -4294967296, 1234567890123, -3000000000};
    for (const std::int64_t a : numbers) {
        CHECK_EQUAL(whole(a).sign(), sign_of(a));
        CHECK(equal(-whole(a), whole(-a)));
        for (const std::int64_t b : numbers) {
            CHECK_EQUAL((whole(a) - whole(b)).sign(), sign_of(a - b));
            CHECK(equal(whole(a) + whole(b), whole(a + b)));
            const std::int64_t c = a % 2147483647, d = b % 2147483647;
            CHECK(equal(whole(c) * whole(d), whole(c * d)));
        }
    }
    CHECK(equal(Integer(INT64_MIN, 0), -Integer(1, 63)));
    CHECK(equal(Integer(-5, 70), Integer(-40, 67)));
    CHECK_EQUAL(Integer(0, 1000).sign(), 0);
}

Integer large(std::mt19937_64& random) {
    Integer x;
    for (std::uint64_t k = random() % 5 + 1; k-- > 0;) {
        x = x.times_power_of_two(static_cast<int>(random() % 90)) +
            whole(static_cast<std::int64_t>(random()));
    }
    return x;
}

void large_numbers() {
    std::mt19937_64 random(1);
    for (int round = 0; round < 5000; ++round) {
        const Integer a = large(random), b = large(random), c = large(random);
        CHECK(equal((a + b) * (a - b), a * a - b * b));
        CHECK(equal(a * (b + c), a * b + a * c));
        CHECK(equal((a - b) - c, a - (b + c)));
        CHECK_EQUAL((a - b).sign(), -(b - a).sign());
        CHECK_EQUAL((a * b).sign(), a.sign() * b.sign());
        const int shift = static_cast<int>(random() % 200);
        CHECK(equal(a.times_power_of_two(shift), a * Integer(1, shift)));
        CHECK_EQUAL((a * a + whole(1)).sign(), 1);
    }
}

// What of the edge from edge(0) to edge(1) is within a radius of a point: A, the root of R, and D.
struct Part {
    long double middle = 0, half = 0, length = 0;
    bool exists;
    Part(const Curve& edge, const Curve& points, const Reach& z) {
        long double square = 0;
        for (std::ptrdiff_t c = 0; c < edge.dim(); ++c) {
            const long double u = edge(1, c) - edge(0, c), w = points(z.index, c) - edge(0, c);
            length += u * u;
            middle += u * w;
            square += w * w;
        }
        const long double r = z.radius;
        const long double rest = middle * middle - length * (square - r * r);
        exists = rest >= 0;
        half = exists ? std::sqrt(rest) : 0;
    }
};

int sign_of_real(long double x) { return std::abs(x) < 1e-9L ? 0 : x < 0 ? -1 : 1; }

void signs_of_roots() {
    test::Random random(3);
    int compared = 0;
    for (int k = 0; k < 4000; ++k) {
        const std::ptrdiff_t dim = 1 + random.index(3);
        const auto coordinates = [&](std::ptrdiff_t count) {
            std::vector<double> values;
            for (std::ptrdiff_t i = 0; i < count * dim; ++i) {
                values.push_back(static_cast<double>(random.index(17) - 8));
            }
            return Curve(values, dim);
        };
        const Curve edge = coordinates(2), points = coordinates(2);
        const auto radius = [&] { return 0.25 * static_cast<double>(1 + random.index(40)); };
        const Reach one{0, radius()}, other{1, radius()};
        const Part first(edge, points, one), second(edge, points, other);
        const ExactSigns exact(edge, points);
        if (!first.exists || !second.exists || first.length == 0) continue;
        ++compared;
        const long double low = first.middle - first.half,
                          low_of_other = second.middle - second.half;
        CHECK_EQUAL(exact.low_to_low(0, one, other), sign_of_real(low - low_of_other));
        CHECK_EQUAL(exact.low_to_high(0, one, other),
                    sign_of_real(low - (second.middle + second.half)));
    }
    CHECK(compared > 1000);
}

// The sign of x^2 factor - square, for 0 < x < 2^53.
int compare(double x, const Integer& factor, const Integer& square) {
    int exponent = 0;
    const Integer mantissa =
        whole(static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53)));
    return (mantissa * mantissa * factor - square.times_power_of_two(2 * (53 - exponent))).sign();
}

// The square of a value, times a factor, is known.
void check_rounded_up(double value, const Integer& factor, const Integer& square) {
    CHECK(compare(value, factor, square) >= 0);
    CHECK(compare(std::nextafter(value, 0.0), factor, square) < 0);
}

// Coordinates with enough bits that their squares are rounded. The cases are two points, and an
// edge and a curve that leaves it for a nearby point. Doubles cannot decide on which side of the
// radius they are.
void distances_are_rounded_up() {
    test::Random random(4);
    for (int round = 0; round < 2000; ++round) {
        const std::int64_t most = std::int64_t{1} << (30 + round % 12);
        const auto coordinate = [&] { return 1 + random.index(most); };
        const std::int64_t x = coordinate(), y = coordinate();
        const auto of = [](std::int64_t a) { return static_cast<double>(a); };
        check_rounded_up(frechet_continuous(Curve{{0.0, 0.0}}, Curve{{of(x), of(y)}}), whole(1),
                         whole(x) * whole(x) + whole(y) * whole(y));
        // The foot of (p, q) lies inside the edge to (2 x, 2 y), or nearly on it.
        const std::int64_t p = x + random.index(x), q = y + random.index(y);
        const Integer cross = whole(x) * whole(q) - whole(y) * whole(p);
        if (cross.sign() == 0) continue;
        const Curve edge{{0.0, 0.0}, {of(2 * x), of(2 * y)}};
        const Curve beside{{0.0, 0.0}, {of(p), of(q)}, {of(2 * x), of(2 * y)}};
        check_rounded_up(frechet_continuous(edge, beside),
                         whole(x) * whole(x) + whole(y) * whole(y), cross * cross);
    }
}

}  // namespace

int main() {
    return check::run({{"small numbers", small_numbers},
                       {"large numbers", large_numbers},
                       {"signs of roots", signs_of_roots},
                       {"distances are rounded up", distances_are_rounded_up}});
}
