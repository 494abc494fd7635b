#include "warping/coarse_table.hpp"

#include <algorithm>
#include <limits>

#include "warping/block_recursion.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The last value of the table over `cost`, a row of `columns` after the other. `visit(value, cell)`
// is called for each.
template <class Visit>
double sweep_coarsely(const std::vector<double>& cost, std::ptrdiff_t columns, Visit visit) {
    std::vector<double> row(static_cast<std::size_t>(columns), infinity);
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

CoarseTable::CoarseTable(const BoxTree& P, const BoxTree& Q, Metric metric,
                         std::ptrdiff_t most_boxes) {
    std::ptrdiff_t p = std::min(block_level, P.levels() - 1),
                   q = std::min(block_level, Q.levels() - 1);
    while (P.boxes(p) * Q.boxes(q) > most_boxes) ++(P.boxes(p) >= Q.boxes(q) ? p : q);
    rows_ = P.boxes(p);
    columns_ = Q.boxes(q);
    smallest_.reserve(static_cast<std::size_t>(rows_ * columns_));
    largest_.reserve(smallest_.capacity());
    with_norm(metric, [&](auto norm) {
        using Norm = decltype(norm);
        for (std::ptrdiff_t i = 0; i < rows_; ++i) {
            for (std::ptrdiff_t j = 0; j < columns_; ++j) {
                smallest_.push_back(smallest_distance<Norm>(P.box(p, i), Q.box(q, j), P.dim()));
                largest_.push_back(largest_distance<Norm>(P.box(p, i), Q.box(q, j), P.dim()));
            }
        }
    });
    const auto nothing = [](double, std::size_t) {};
    lower_ = sweep_coarsely(smallest_, columns_, nothing);
    upper_ = sweep_coarsely(largest_, columns_, nothing);
}

double CoarseTable::undecided_share(double lower, double upper) const {
    std::ptrdiff_t undecided = 0;
    sweep_coarsely(smallest_, columns_, [&](double value, std::size_t cell) {
        undecided += value <= upper && largest_[cell] > lower;
    });
    return static_cast<double>(undecided) / static_cast<double>(rows_ * columns_);
}

}  // namespace curvewise::warping
