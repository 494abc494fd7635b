#include "warping/block_values.hpp"

#include <algorithm>

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

FrontSide::FrontSide(std::ptrdiff_t points)
    : points_(points),
      lowest_(static_cast<std::size_t>(runs_of(points)), infinity),
      is_even_(lowest_.size(), 1),
      values_(points) {}

std::ptrdiff_t FrontSide::points_of(std::ptrdiff_t run) const noexcept {
    return std::min(kernels::block_side, points_ - run * kernels::block_side);
}

double FrontSide::lowest(const RunRange& runs) const noexcept {
    return *std::min_element(lowest_.data() + runs.first, lowest_.data() + runs.end);
}

void FrontSide::fill(const RunRange& runs, double value) noexcept {
    std::fill(lowest_.data() + runs.first, lowest_.data() + runs.end, value);
    std::fill(is_even_.data() + runs.first, is_even_.data() + runs.end, std::uint8_t{1});
}

void FrontSide::take_smallest_so_far(const RunRange& runs, double entering) noexcept {
    double smallest = entering;
    for (std::ptrdiff_t run = runs.first; run < runs.end; ++run) {
        double& lowest = lowest_[static_cast<std::size_t>(run)];
        std::uint8_t& is_even = is_even_[static_cast<std::size_t>(run)];
        if (smallest <= lowest) {
            lowest = smallest;
            is_even = 1;
        } else if (is_even) {
            smallest = lowest;
        } else {
            double* const value = values_.data() + run * kernels::block_side;
            for (std::ptrdiff_t k = 0; k < points_of(run); ++k) {
                smallest = std::min(smallest, value[k]);
                value[k] = smallest;
            }
        }
    }
}

double* FrontSide::spread(std::ptrdiff_t run) noexcept {
    double* const value = values_.data() + run * kernels::block_side;
    if (is_even_[static_cast<std::size_t>(run)]) {
        std::fill_n(value, points_of(run), lowest_[static_cast<std::size_t>(run)]);
    }
    return value;
}

void FrontSide::changed(std::ptrdiff_t run, double upper) noexcept {
    const double* const value = values_.data() + run * kernels::block_side;
    const auto [lowest, highest] = std::minmax_element(value, value + points_of(run));
    const bool is_blocked = *lowest > upper;
    lowest_[static_cast<std::size_t>(run)] = is_blocked ? infinity : *lowest;
    is_even_[static_cast<std::size_t>(run)] = is_blocked || *lowest == *highest;
}

ValueFront::ValueFront(const PackedPair& curves, double upper, kernels::ValueFunction values)
    : curves_(curves), upper_(upper), values_(values), p_(curves.rows()), q_(curves.columns()) {}

void ValueFront::block(const RunRange& p, const RunRange& q) noexcept {
    p_.fill(p, infinity);
    q_.fill(q, infinity);
}

// The smallest value that leads into a cell: from the other side all values, from its own side the
// earlier ones.
void ValueFront::pass(const RunRange& p, const RunRange& q, double corner) noexcept {
    const double into_p = std::min(corner, q_.lowest(q));
    const double into_q = std::min(corner, p_.lowest(p));
    p_.take_smallest_so_far(p, into_p);
    q_.take_smallest_so_far(q, into_q);
}

std::int64_t ValueFront::sweep(std::ptrdiff_t p_run, std::ptrdiff_t q_run, double corner) noexcept {
    const std::ptrdiff_t i = p_run * kernels::block_side, j = q_run * kernels::block_side;
    const std::ptrdiff_t rows = std::min(kernels::block_side, curves_.rows() - i);
    const std::ptrdiff_t columns = std::min(kernels::block_side, curves_.columns() - j);
    const double* const q = curves_.q.data() + curves_.columns() - 1 - j;
    values_({curves_.p.data() + i, q, curves_.p.stride(), curves_.q.stride(), curves_.dim(), rows,
             columns, q_.spread(q_run), p_.spread(p_run), corner});
    p_.changed(p_run, upper_);
    q_.changed(q_run, upper_);
    return rows * columns;
}

}  // namespace curvewise::warping
