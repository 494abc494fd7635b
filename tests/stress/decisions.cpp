// Decisions of the continuous Fréchet distance against exact whole numbers
// (textbook_continuous.hpp, which shares no code with the library): random lattice curves in 1 to 3
// dimensions, at the distance and at the doubles next to it, where a rounding error would change
// the answer, around it, and at quarters, where many vertices are just within. Curves are also
// multiplied by a power of two. Prints how many decisions were made and how many were wrong; ends
// with 1 if any was.
//
//   CURVEWISE_ISA=v3 decisions 2500000 1
//
// The number of decisions, and the seed. 2,500,000 take a few minutes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "choices.hpp"
#include "curves.hpp"
#include "curvewise/build_info.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "textbook_continuous.hpp"

namespace {

using test::Curve;
using test::RandomChoices;

struct Count {
    std::int64_t made = 0;
    std::int64_t yes = 0;
    std::int64_t wrong = 0;
};

// Walks on the lattice, or points anywhere on it. Coordinates are at most 4, so that 128 bits
// suffice.
Curve lattice_curve(RandomChoices& choices, std::ptrdiff_t dim) {
    const std::ptrdiff_t n = choices.between(1, 8);
    const bool is_walk = choices.one_in(2);
    std::vector<double> values;
    for (std::ptrdiff_t k = 0; k < n * dim; ++k) {
        const double before = is_walk && k >= dim ? values[static_cast<std::size_t>(k - dim)] : 0.0;
        const double next = before + static_cast<double>(choices.between(-3, 3));
        values.push_back(std::clamp(next, -4.0, 4.0));
    }
    return {values, dim};
}

void decide(const Curve& P, const Curve& Q, double radius, bool expected, Count& count) {
    for (const bool is_swapped : {false, true}) {
        const bool found = is_swapped ? curvewise::frechet_within(Q, P, radius)
                                      : curvewise::frechet_within(P, Q, radius);
        ++count.made;
        count.yes += found ? 1 : 0;
        if (found == expected) continue;
        ++count.wrong;
        std::printf("WRONG at radius %.17g\n", radius);
    }
}

void play(RandomChoices& choices, Count& count) {
    const std::ptrdiff_t dim = choices.between(1, 3);
    const Curve P = lattice_curve(choices, dim), Q = lattice_curve(choices, dim);
    const textbook::Ratio square = textbook::continuous_square(P, Q);
    const double root =
        std::sqrt(static_cast<double>(square.numerator) / static_cast<double>(square.denominator));
    const double below = std::nextafter(root, 0.0);
    const double above = std::nextafter(root, std::numeric_limits<double>::infinity());
    const int k = static_cast<int>(choices.between(-900, 900));
    for (const double radius :
         {std::nextafter(below, 0.0), below, root, above, root * choices.uniform(0.9, 1.1)}) {
        const bool expected = textbook::compare_with_root(radius, square) >= 0;
        decide(P, Q, radius, expected, count);
        if (radius > 0.0) {
            decide(P.times_power_of_two(k), Q.times_power_of_two(k), std::ldexp(radius, k),
                   expected, count);
        }
    }
    for (int look = 0; look < 3; ++look) {  // without the textbook's search for the distance
        const auto quarters = static_cast<std::int64_t>(choices.between(0, 24));
        const textbook::ExactRule rule({static_cast<textbook::Wide>(quarters * quarters), 16});
        decide(P, Q, static_cast<double>(quarters) / 4.0, textbook::is_long_enough(rule, P, Q),
               count);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::int64_t most = argc > 1 ? std::atoll(argv[1]) : 2500000;
    const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
    Count count;
    for (std::uint64_t round = 0; count.made < most; ++round) {
        RandomChoices choices(seed, round);
        play(choices, count);
    }
    std::printf("%lld decisions at level %s, %lld of them yes: %lld wrong\n",
                static_cast<long long>(count.made), curvewise::build_info().active.c_str(),
                static_cast<long long>(count.yes), static_cast<long long>(count.wrong));
    return count.wrong > 0 ? 1 : 0;
}
