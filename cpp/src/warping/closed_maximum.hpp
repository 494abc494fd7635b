// The least maximum of a walk around two closed curves: for closed_frechet.
#pragma once

#include <cstddef>
#include <limits>

#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"
#include "warping/closed_walk.hpp"

namespace curvewise::warping {

// The least bound under which a closed walk exists, by bisection among distances. With `bound`
// given, the starts from which a cell is reached lie between a first and a last one. Two walks that
// cross share a cell. So start k has a walk in two cases: (n, k + m) is reached from k, or it is
// reached from starts on both sides of k and some cell of the last row is reached from k.
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
    // A start whose walk has the given value.
    std::ptrdiff_t start(double value) {
        admits(value);
        return start_;
    }

   private:
    struct Starts {
        std::ptrdiff_t first, last;  // starts that reach a cell; -1 if there are none
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
    // Whether a closed walk exists with all pair distances at most `bound`. If so, `used_` is the
    // largest distance of a reached cell; otherwise `blocked_` is the least distance of a cell that
    // is not reached.
    bool admits(double bound);
    // Row i of the starts from which cells are reached; whether there is one.
    bool reach_row(std::ptrdiff_t i, double bound);
    // Row i of the reached cells that reach the last row, with a single mark instead of starts.
    void reach_back(std::ptrdiff_t i, double bound);

    static constexpr std::ptrdiff_t chunk = 64;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    std::ptrdiff_t n_, m_;
    RowDistances& distances_;
    Poller& poller_;
    runtime::ScratchVector<Starts> row_, above_;
    runtime::ScratchVector<Range> live_;  // the columns that are reached, by row
    double used_ = 0.0, blocked_ = infinity;
    std::ptrdiff_t start_ = 0;
};

}  // namespace curvewise::warping
