// The definitions for all tests of DTW and Fréchet: the ground distances, the valid paths and their
// costs, and a list of every warping path (exponential time).
//
// Comparisons are exact. Adding d, or taking the larger of d, is monotone in floating point, too.
// So the recurrence computes the smallest of all path sums, each rounded in path order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "curves.hpp"
#include "curvewise/ground_distance.hpp"

namespace oracle {

using curvewise::GroundDistance;
using curvewise::Metric;
using test::Curve;

using Path = std::vector<std::array<std::int64_t, 2>>;

// Metrics of coordinates; haversine, the last, has separate tests.
inline constexpr auto metrics = [] {
    std::array<Metric, choice_names(Metric{}).size() - 1> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<Metric>(k);
    return all;
}();

inline std::string name(Metric metric) {
    return choice_names(metric)[static_cast<std::size_t>(metric)];
}

inline double ground_distance(const GroundDistance& ground, const Curve& P, std::ptrdiff_t i,
                              const Curve& Q, std::ptrdiff_t j) {
    const std::ptrdiff_t dim = P.dim();
    double squares = 0.0, sum = 0.0, largest = 0.0, powers = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        const double delta = std::abs(P(i, c) - Q(j, c));
        squares += delta * delta;
        sum += delta;
        largest = std::max(largest, delta);
    }
    switch (ground.metric) {
        case Metric::euclidean:
            return dim == 1 ? largest : std::sqrt(squares);
        case Metric::sqeuclidean:
            return squares;
        case Metric::cityblock:
            return sum;
        case Metric::chebyshev:
            return largest;
        case Metric::minkowski:
        case Metric::haversine:
            break;
    }
    if (dim == 1 || largest == 0.0 || std::isinf(ground.p)) return largest;
    if (ground.p == 1.0) return sum;
    if (ground.p == 2.0) return std::sqrt(squares);
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        powers += std::pow(std::abs(P(i, c) - Q(j, c)) / largest, ground.p);
    }
    return largest * std::pow(powers, 1.0 / ground.p);
}

// If both curves are multiplied by a factor, the distance is multiplied by this power of it.
inline int degree(Metric metric) {
    switch (metric) {
        case Metric::sqeuclidean:
            return 2;
        case Metric::euclidean:
        case Metric::cityblock:
        case Metric::chebyshev:
        case Metric::minkowski:
        case Metric::haversine:
            break;
    }
    return 1;
}

// Whether sums are in the order of the coordinates and every operation is correctly rounded, so
// that there is one right answer to the last bit. (Powers are as good as the C library's.)
inline bool is_exact(const GroundDistance& ground) {
    return ground.metric != Metric::minkowski || ground.p == 1.0 || ground.p == 2.0 ||
           std::isinf(ground.p);
}

// What a path costs, and which paths there are.
struct Rules {
    GroundDistance ground;
    bool largest = false;  // the largest ground distance (Fréchet), not the sum (DTW)
    double diagonal_weight = 1.0;
    std::optional<std::ptrdiff_t> window;
    bool open_begin = false;
    bool open_end = false;
};

inline bool is_allowed(std::ptrdiff_t n, std::ptrdiff_t m, std::ptrdiff_t i, std::ptrdiff_t j,
                       const std::optional<std::ptrdiff_t>& window) {
    if (!window || n == 1 || m == 1) return true;
    return std::abs(i * (m - 1) - j * (n - 1)) <= *window * (std::max(n, m) - 1);
}

class AllPaths {
   public:
    AllPaths(const Curve& P, const Curve& Q, const Rules& rules) : P_(P), Q_(Q), rules_(rules) {
        for (std::ptrdiff_t j = 0; j < (rules.open_begin ? Q.size() : 1); ++j) {
            extend(0, j, ground_distance(rules.ground, P, 0, Q, j));
        }
    }
    double cheapest() const noexcept { return cheapest_; }

   private:
    void extend(std::ptrdiff_t i, std::ptrdiff_t j, double cost) {
        const bool ends = j + 1 == Q_.size() || rules_.open_end;
        if (i + 1 == P_.size() && ends) cheapest_ = std::min(cheapest_, cost);
        step(i + 1, j, cost, 1.0);
        step(i, j + 1, cost, 1.0);
        step(i + 1, j + 1, cost, rules_.diagonal_weight);
    }
    void step(std::ptrdiff_t i, std::ptrdiff_t j, double cost, double weight) {
        if (i >= P_.size() || j >= Q_.size()) return;
        if (!is_allowed(P_.size(), Q_.size(), i, j, rules_.window)) return;
        const double d = ground_distance(rules_.ground, P_, i, Q_, j);
        extend(i, j, rules_.largest ? std::max(cost, d) : cost + weight * d);
    }

    const Curve& P_;
    const Curve& Q_;
    const Rules& rules_;
    double cheapest_ = std::numeric_limits<double>::infinity();
};

// Whether every step is (1, 0), (0, 1) or (1, 1), within the window, and both ends are where they
// may be.
inline bool is_path(const Path& path, const Curve& P, const Curve& Q, const Rules& rules) {
    if (path.empty() || path.front()[0] != 0 || path.back()[0] != P.size() - 1) return false;
    if (!rules.open_begin && path.front()[1] != 0) return false;
    if (!rules.open_end && path.back()[1] != Q.size() - 1) return false;
    for (std::size_t k = 0; k < path.size(); ++k) {
        const auto [i, j] = path[k];
        if (i >= P.size() || j < 0 || j >= Q.size()) return false;
        if (!is_allowed(P.size(), Q.size(), i, j, rules.window)) return false;
        if (k == 0) continue;
        const std::int64_t di = i - path[k - 1][0], dj = j - path[k - 1][1];
        if (di < 0 || di > 1 || dj < 0 || dj > 1 || di + dj == 0) return false;
    }
    return true;
}

// Added up, or the largest taken, in path order.
inline double path_cost(const Path& path, const Curve& P, const Curve& Q, const Rules& rules) {
    double cost = 0.0;
    for (std::size_t k = 0; k < path.size(); ++k) {
        const auto [i, j] = path[k];
        const bool diagonal = k > 0 && path[k - 1][0] < i && path[k - 1][1] < j;
        const double d = ground_distance(rules.ground, P, i, Q, j);
        const double weight = diagonal ? rules.diagonal_weight : 1.0;
        cost = rules.largest ? std::max(cost, d) : cost + weight * d;
    }
    return cost;
}

}  // namespace oracle
