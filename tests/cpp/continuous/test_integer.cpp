// Whole numbers of any size: against 64-bit ones where those suffice, and by the laws of a ring
// where they do not.
#include <cstdint>
#include <random>
#include <vector>

#include "check.hpp"
#include "continuous/integer.hpp"

namespace {

using curvewise::detail::Integer;

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

}  // namespace

int main() {
    return check::run({{"small numbers", small_numbers}, {"large numbers", large_numbers}});
}
