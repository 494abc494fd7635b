#include "warping/cheap_cells.hpp"

#include <algorithm>
#include <limits>

#include "runtime/scratch.hpp"
#include "warping/box_tree.hpp"
#include "warping/ground_distance.hpp"
#include "warping/narrow_path.hpp"

namespace curvewise::warping {
namespace {

// With fewer cells, the two paths take longer than the sweep could save.
constexpr std::ptrdiff_t fewest_cells = std::ptrdiff_t{1} << 13;

// With more cells, bounds of the rest of a path are worth their time (dtw_pruned.hpp). Up to this
// size, one table of predecessors holds all cells.
constexpr std::ptrdiff_t most_cells = 1'200'000;

// `fixed_dim`: the number of coordinates, or 0 where it is known at run time only.
template <class Norm, int fixed_dim>
class Walks {
   public:
    explicit Walks(const SweepProblem& problem) noexcept
        : dim_(fixed_dim > 0 ? fixed_dim : problem.curves.dim()),
          last_row_(problem.curves.rows() - 1),
          last_column_(problem.curves.columns() - 1),
          p_(problem.curves.p, PointOrder::forward),
          q_(problem.curves.q, PointOrder::reversed),
          diagonal_weight_(problem.rule == kernels::Rule::dtw_symmetric2 ? 2.0 : 1.0) {}

    // The cost of the cheaper of the two paths.
    double least() const noexcept {
        return std::min(walk([](double, double, double) { return true; }),
                        walk([](double both, double row, double column) {
                            return both <= row && both <= column;
                        }));
    }

   private:
    // `is_diagonal`: whether to go on so, given the distances of the next three cells.
    template <class IsDiagonal>
    double walk(IsDiagonal is_diagonal) const noexcept {
        std::ptrdiff_t i = 0, j = 0;
        double sum = distance(0, 0);
        while (i < last_row_ && j < last_column_) {
            const double both = distance(i + 1, j + 1);
            const double row = distance(i + 1, j), column = distance(i, j + 1);
            if (is_diagonal(both, row, column)) {
                sum += diagonal_weight_ * both;
                ++i, ++j;
            } else if (row <= column) {
                sum += row;
                ++i;
            } else {
                sum += column;
                ++j;
            }
        }
        while (i < last_row_) sum += distance(++i, j);
        while (j < last_column_) sum += distance(i, ++j);
        return sum;
    }

    double distance(std::ptrdiff_t i, std::ptrdiff_t j) const noexcept {
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < (fixed_dim > 0 ? fixed_dim : dim_); ++c) {
            sum = Norm::add(sum, p_(i, c) - q_(j, c));
        }
        return Norm::finish(sum);
    }

    std::ptrdiff_t dim_;
    std::ptrdiff_t last_row_;
    std::ptrdiff_t last_column_;
    PointAccess p_;
    PointAccess q_;
    double diagonal_weight_;
};

double cost_of_some_path(const SweepProblem& problem) {
    return with_norm(problem.cost.metric, [&](auto norm) {
        using Norm = decltype(norm);
        return problem.curves.dim() == 2 ? Walks<Norm, 2>(problem).least()
                                         : Walks<Norm, 0>(problem).least();
    });
}

}  // namespace

std::optional<Path> find_path_of_cheap_cells(const SweepProblem& problem, bool open_end) {
    const std::ptrdiff_t n = problem.curves.rows(), m = problem.curves.columns();
    if (n * m < fewest_cells || n * m > most_cells || problem.columns.is_limited() ||
        problem.open_begin || !with_norm(problem.cost.metric, [](auto) { return true; })) {
        return std::nullopt;
    }
    // Summed in the table's order, so that both have the same rounding errors.
    const double most = cost_of_some_path(problem);
    if (!open_end && has_narrow_path(problem) && most < std::numeric_limits<double>::infinity()) {
        return find_narrow_path(problem, most);
    }
    const runtime::ScratchVector<double> nothing_to_come(
        static_cast<std::size_t>(std::max(n, m) + 1), 0.0);
    const double* const after = nothing_to_come.data() + 1;
    const CostToGo cost_to_go{most, 1.0, after, after, false};
    SweptColumns swept;
    SweepProblem narrowed = problem;
    narrowed.columns = LiveColumns(problem.columns, cost_to_go, swept);
    return find_path(narrowed, open_end);
}

}  // namespace curvewise::warping
