#include "warping/coarse_table.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include "runtime/scratch.hpp"
#include "warping/block_recursion.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The last value of the table over `cost`, a row of `columns` after the other. `visit(value, cell)`
// is called for each.
template <class Visit>
double sweep_coarsely(const runtime::ScratchVector<double>& cost, std::ptrdiff_t columns,
                      Visit visit) {
    runtime::ScratchVector<double> row(static_cast<std::size_t>(columns), infinity);
    double left = infinity, diagonal = 0.0;  // leads into the first cell
    std::size_t j = 0;
    for (std::size_t cell = 0; cell < cost.size(); ++cell) {
        const double up = row[j];
        left = std::max(cost[cell], std::min(std::min(up, left), diagonal));
        visit(left, cell);
        diagonal = up;
        row[j] = left;
        if (++j == row.size()) {
            j = 0;
            left = diagonal = infinity;
        }
    }
    return row.back();
}

}  // namespace

const double* CoarseTable::Side::block(std::ptrdiff_t index, std::uint64_t random) const noexcept {
    const std::ptrdiff_t up = std::max<std::ptrdiff_t>(level - block_level, 0);
    const std::ptrdiff_t first = index << up;
    const std::ptrdiff_t end = std::min((index + 1) << up, tree.boxes(level - up));
    return tree.box(level - up, first + static_cast<std::ptrdiff_t>(
                                            random % static_cast<std::uint64_t>(end - first)));
}

CoarseTable::CoarseTable(const BoxTree& P, const BoxTree& Q, Metric metric,
                         std::ptrdiff_t most_boxes)
    : p_{P, std::min(block_level, P.levels() - 1)},
      q_{Q, std::min(block_level, Q.levels() - 1)},
      metric_(metric) {
    while (P.boxes(p_.level) * Q.boxes(q_.level) > most_boxes) {
        ++(P.boxes(p_.level) >= Q.boxes(q_.level) ? p_ : q_).level;
    }
    rows_ = P.boxes(p_.level);
    columns_ = Q.boxes(q_.level);
    smallest_.reserve(static_cast<std::size_t>(rows_ * columns_));
    largest_.reserve(smallest_.capacity());
    with_norm(metric, [&](auto norm) {
        using Norm = decltype(norm);
        for (std::ptrdiff_t i = 0; i < rows_; ++i) {
            for (std::ptrdiff_t j = 0; j < columns_; ++j) {
                smallest_.push_back(smallest_distance<Norm>(p_.box(i), q_.box(j), P.dim()));
                largest_.push_back(largest_distance<Norm>(p_.box(i), q_.box(j), P.dim()));
            }
        }
    });
    const auto nothing = [](double, std::size_t) {};
    lower_ = sweep_coarsely(smallest_, columns_, nothing);
    upper_ = sweep_coarsely(largest_, columns_, nothing);
}

double CoarseTable::undecided_share(double lower, double upper) const {
    const bool is_of_blocks = std::max(p_.level, q_.level) <= block_level;
    std::ptrdiff_t undecided = 0;
    with_norm(metric_, [&](auto norm) {
        using Norm = decltype(norm);
        std::mt19937_64 random;  // the same for every call
        const auto is_undecided = [&](std::size_t cell) {
            const auto columns = static_cast<std::size_t>(columns_);
            const double* const p = p_.block(static_cast<std::ptrdiff_t>(cell / columns), random());
            const double* const q = q_.block(static_cast<std::ptrdiff_t>(cell % columns), random());
            return smallest_distance<Norm>(p, q, p_.tree.dim()) <= upper &&
                   largest_distance<Norm>(p, q, p_.tree.dim()) > lower;
        };
        sweep_coarsely(smallest_, columns_, [&](double value, std::size_t cell) {
            if (value > upper || largest_[cell] <= lower) return;
            undecided += is_of_blocks || is_undecided(cell);
        });
    });
    return static_cast<double>(undecided) / static_cast<double>(rows_ * columns_);
}

}  // namespace curvewise::warping
