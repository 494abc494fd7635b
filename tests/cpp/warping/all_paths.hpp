// Common code of the tests of dtw and of the discrete Fréchet distance: a value and its path
// against all paths, one by one, and pairs of curves that are short enough for that.
#pragma once

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/dtw.hpp"
#include "oracle.hpp"

namespace oracle {

inline void check_against_all_paths(const Curve& P, const Curve& Q, const Rules& rules,
                                    double distance, const curvewise::Alignment& alignment) {
    const double expected = AllPaths(P, Q, rules).cheapest();
    const double tolerance = is_exact(rules.ground) ? 0.0 : 1e-12;
    CHECK_CLOSE(distance, expected, tolerance);
    CHECK_CLOSE(path_cost(alignment.path, P, Q, rules), expected, tolerance);
    CHECK_EQUAL(alignment.distance, distance);
    CHECK(is_path(alignment.path, P, Q, rules));
}

template <class Check>
void for_short_pairs(std::uint64_t seed, Check check) {
    test::Random random(seed);
    for (const std::ptrdiff_t n : {1, 2, 3, 4, 5}) {
        for (const std::ptrdiff_t m : {1, 2, 3, 4, 5, 6}) {
            for (const std::ptrdiff_t dim : {1, 2, 3, 5}) {
                check(random.curve(n, dim), random.curve(m, dim));
                check(random.lattice_curve(n, dim), random.lattice_curve(m, dim));
            }
        }
    }
}

}  // namespace oracle
