// How long decisions and distances of the continuous Fréchet distance take, pair by pair, beside a
// plain decision that is not exact (plain_decision.hpp). decisions.py runs it, also one that is
// linked to an older library, and prints tables.
//
//   bench_decisions KIND N DIM PAIRS FIRST
//
// KIND is walk, noise or loop, FIRST the first pair's number. A line for each pair: its number,
// then microseconds here and of the plain decision, and whether the answers agree, for each of 0.9,
// 1 and 1.1 of the distance; then microseconds of the distance.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "curvewise/curvewise.hpp"
#include "plain_decision.hpp"

namespace {

using curvewise::CurveView;
using Points = std::vector<double>;

struct Pair {
    Points p, q;
};

// Unrelated walks; white noise; a loop of three turns and another of a few per cent more, both with
// noise.
Pair pair_of(const std::string& kind, std::ptrdiff_t n, int dim, unsigned number) {
    std::mt19937_64 bits(number);
    std::normal_distribution<double> normal;
    Pair pair;
    for (Points* points : {&pair.p, &pair.q}) {
        const double size = points == &pair.p ? 1.0 : 1.0 + 0.03 * normal(bits);
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            const double angle = 18.85 * static_cast<double>(i) / static_cast<double>(n - 1);
            for (int c = 0; c < dim; ++c) {
                double x = normal(bits);
                if (kind == "walk" && i > 0) x += *(points->end() - dim);
                if (kind == "loop") x = 0.01 * x + size * std::sin((1.0 + c / 2) * angle + c % 2);
                points->push_back(x);
            }
        }
    }
    return pair;
}

// The least microseconds of a few calls.
template <class Call>
double microseconds(Call call) {
    double least = INFINITY, spent = 0.0;
    for (int k = 0; k < 7 && (k < 2 || spent < 5e3); ++k) {
        const auto start = std::chrono::steady_clock::now();
        call();
        const std::chrono::duration<double, std::micro> elapsed =
            std::chrono::steady_clock::now() - start;
        least = std::min(least, elapsed.count());
        spent += elapsed.count();
    }
    return least;
}

bool plainly_within(const Pair& pair, std::ptrdiff_t n, int dim, double radius) {
    const double* const p = pair.p.data();
    const double* const q = pair.q.data();
    return dim == 2 ? plain::is_within<2>(p, n, q, n, radius)
                    : plain::is_within<3>(p, n, q, n, radius);
}

void print_pair(const Pair& pair, std::ptrdiff_t n, int dim, unsigned number) {
    const CurveView P(pair.p.data(), n, dim), Q(pair.q.data(), n, dim);
    const double distance = curvewise::frechet_continuous(P, Q);
    std::printf("%u", number);
    for (const double factor : {0.9, 1.0, 1.1}) {
        const double radius = factor * distance;
        bool here = false, plain = false;
        const double ours =
            microseconds([&] { here = curvewise::frechet_within(P, Q, radius, true); });
        const double theirs = microseconds([&] { plain = plainly_within(pair, n, dim, radius); });
        std::printf(" %.3f %.3f %d", ours, theirs, here == plain ? 1 : 0);
    }
    std::printf(" %.3f\n", microseconds([&] { return curvewise::frechet_continuous(P, Q); }));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 6) return 2;
    const std::string kind = argv[1];
    const std::ptrdiff_t n = std::atol(argv[2]);
    const int dim = std::atoi(argv[3]);
    const int pairs = std::atoi(argv[4]);
    const auto first = static_cast<unsigned>(std::atol(argv[5]));
    for (unsigned k = 0; k < static_cast<unsigned>(pairs); ++k) {
        print_pair(pair_of(kind, n, dim, first + k), n, dim, first + k);
    }
}
