// The kernels' square root against std::sqrt, at every instruction-set level of this machine. The
// arguments are 10^7 random ones in its domain (or the number in the first command-line argument),
// special ones, and those that are hardest to round. The last make it a proof.
//
// Before its one rounding, the square root is right to about 2^-45 ulp (see square_root.inl.hpp).
// So it can be rounded wrongly only if sqrt(x) is that close to the middle between two doubles.
// Scale M = 2 sqrt(x) to an integer of 54 bits, and x to 2^k X. Such a middle is an odd M with M^2
// = 2^j X + r, j = 54 or 55 and r small: the middle is r / (2 M) half ulps away. Every such M is a
// root of r modulo 2^j. There are four roots if r is 1 modulo 8, and otherwise 0; they are lifted
// bit by bit. With all |r| < 2^20, the test covers every x whose root is closer than 2^-34 ulp to a
// middle.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include "check.hpp"
#include "square_roots.hpp"
#include "warping/dispatch.hpp"

namespace {

struct Level {
    const char* name;
    test::SquareRoots roots;
};

std::vector<Level> levels() {
    std::vector<Level> result{{"baseline", test::square_roots_baseline}};
#ifdef CURVEWISE_X86_64_LEVELS
    const std::size_t available = curvewise::warping::available_levels().size();
    if (available > 1) result.push_back({"v3", test::square_roots_v3});
    if (available > 2) result.push_back({"v4", test::square_roots_v4});
#endif
    return result;
}

void check_all(std::vector<double> x) {
    x.resize((x.size() + 7) / 8 * 8, 1.0);
    std::vector<double> y(x.size());
    for (const Level& level : levels()) {
        const check::Note note(level.name);
        level.roots(x.data(), y.data(), static_cast<std::ptrdiff_t>(x.size()));
        for (std::size_t i = 0; i < x.size(); ++i) {
            // Not CHECK_EQUAL: 10^9 of them.
            if (y[i] == std::sqrt(x[i])) continue;
            char argument[40];
            std::snprintf(argument, sizeof argument, "x = %a", x[i]);
            const check::Note note_of_argument(argument);
            CHECK_EQUAL(y[i], std::sqrt(x[i]));
        }
    }
}

void random_arguments(std::int64_t count) {
    constexpr std::size_t batch = 1 << 16;
    std::mt19937_64 bits(1);
    std::uniform_int_distribution<int> exponents(-904, 1019);
    for (std::int64_t done = 0; done < count; done += batch) {
        std::vector<double> x(batch);
        for (double& value : x) {
            value = std::ldexp(1.0 + static_cast<double>(bits() >> 12U) * 0x1p-52, exponents(bits));
        }
        check_all(std::move(x));
    }
}

void special_arguments() {
    std::vector<double> x{0.0, 0x1p-904, 0x1.fffffffffffffp1019, 1.0, 2.0, 3.0, 4.0};
    for (int exponent = -904; exponent < 1020; ++exponent) {
        for (const double mantissa : {1.0, 0x1.0000000000001p0, 0x1.fffffffffffffp0, 1.5}) {
            x.push_back(std::ldexp(mantissa, exponent));
        }
    }
    for (double root = 1.0; root < 3000.0; root += 1.0) {
        const double square = root * root;
        x.insert(x.end(), {square, std::nextafter(square, 0.0), std::nextafter(square, 1e300)});
    }
    check_all(std::move(x));
}

// An odd M with M^2 = r modulo 2^bits, for r = 1 modulo 8.
std::uint64_t square_root_modulo(std::int64_t r, unsigned bits) {
    std::uint64_t root = 1;
    for (unsigned k = 3; k < bits; ++k) {
        const std::uint64_t error = root * root - static_cast<std::uint64_t>(r);
        if (((error >> k) & 1U) != 0) root += std::uint64_t{1} << (k - 1);
    }
    return root;
}

// Appends x = (M^2 - r) / 2^j, scaled, if it is a double whose root M / 2 is in the right binade.
void append_argument(std::uint64_t M, std::int64_t r, unsigned j, std::vector<double>& x) {
    // 128-bit arithmetic in two parts: M = high 2^27 + low.
    const std::uint64_t high = M >> 27U, low = M & ((1U << 27U) - 1U);
    const std::uint64_t middle = 2 * high * low;
    // M^2 - r = high^2 2^54 + middle 2^27 + low^2 - r; the part below 2^54 ends in 2^54 times a
    // carry.
    const auto rest = static_cast<std::int64_t>(low * low) - r;
    const auto below = static_cast<std::int64_t>((middle & ((1U << 27U) - 1U)) << 27U) + rest;
    std::uint64_t X = high * high + (middle >> 27U) + static_cast<std::uint64_t>(below >> 54U);
    if (j == 55) X >>= 1U;
    if (X >> 52U != 1) return;
    x.push_back(std::ldexp(static_cast<double>(X), j == 54 ? -52 : -51));
}

void hardest_arguments() {
    constexpr std::int64_t closest = 1 << 20;
    std::vector<double> x;
    for (const unsigned j : {54U, 55U}) {
        const std::uint64_t mask = (std::uint64_t{1} << j) - 1, half = std::uint64_t{1} << (j - 1);
        for (std::int64_t r = 1 - closest; r < closest; r += 8) {
            const std::uint64_t root = square_root_modulo(r, j);
            for (const std::uint64_t M : {root, 0 - root, root + half, half - root}) {
                append_argument(M & mask, r, j, x);
            }
        }
    }
    CHECK(x.size() > 100'000);
    check_all(std::move(x));
}

}  // namespace

int main(int count, char** arguments) {
    const std::int64_t random = count > 1 ? std::atoll(arguments[1]) : 10'000'000;
    return check::run({{"random arguments", [=] { random_arguments(random); }},
                       {"special arguments", special_arguments},
                       {"hardest arguments", hardest_arguments}});
}
