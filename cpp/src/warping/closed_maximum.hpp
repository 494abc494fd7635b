// The least maximum of a walk around two closed curves: for closed_frechet.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "runtime/poller.hpp"
#include "warping/closed_walk.hpp"

namespace curvewise::warping {

// The least bound under which a closed walk exists, by bisection among distances. With `bound`
// given, the starts from which a cell is reached lie between two, the first and the last; since two
// walks that cross have a cell in common, start k has a walk if (n, k + m) is reached from starts
// on both sides of k, or from k, and if some cell of the last row is reached from k.
class LeastMaximumSearch {
   public:
    LeastMaximumSearch(std::ptrdiff_t n, std::ptrdiff_t m, RowDistances& distances, Poller& poller)
        : n_(n),
          m_(m),
          distances_(distances),
          poller_(poller),
          row_(static_cast<std::size_t>(2 * m + 2)),
          above_(row_),
          live_(static_cast<std::size_t>(n + 1)) {}

    // The value, or infinity where it is above `most`.
    double run(double most);
    // Of a value, a start whose walk has it.
    std::ptrdiff_t start(double value) {
        admits(value);
        return start_;
    }

   private:
    struct Starts {
        std::ptrdiff_t first, last;  // that reach a cell; none: -1
        bool are_there() const noexcept { return last >= 0; }
        void add(const Starts& others) noexcept {
            if (!others.are_there()) return;
            first = are_there() ? std::min(first, others.first) : others.first;
            last = std::max(last, others.last);
        }
    };
    struct Range {
        std::ptrdiff_t first, last;
    };

    // Every walk has a pair of each row: the nearest ones of some rows.
    double lower_bound();
    // The value of one walk, from the point of Q that is nearest to P's first: of the three next
    // pairs it takes the nearest. An upper bound in O(n + m).
    double greedy();
    // Whether some closed walk has no pair farther apart than `bound`. Then `used_` is the largest
    // distance of a cell that is reached, otherwise `blocked_` the least one of a cell that is not.
    bool admits(double bound);
    // Row i of the starts from which cells are reached; whether there is one.
    bool reach_row(std::ptrdiff_t i, double bound);
    // Row i of what reaches the last row, among what is reached: a single mark instead of starts.
    void reach_back(std::ptrdiff_t i, double bound);

    static constexpr std::ptrdiff_t chunk = 64;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    std::ptrdiff_t n_, m_;
    RowDistances& distances_;
    Poller& poller_;
    std::vector<Starts> row_, above_;
    std::vector<Range> live_;  // the columns that are reached, by row
    double used_ = 0.0, blocked_ = infinity;
    std::ptrdiff_t start_ = 0;
};

}  // namespace curvewise::warping
