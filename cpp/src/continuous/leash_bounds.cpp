#include "continuous/leash_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/scratch.hpp"

namespace curvewise::continuous {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A double not above the real root of a sum of `dim` squares of differences, given the rounded sum
// `square`. Each operation errs by 2^-53 of its result, and by more below the usual range.
double safe_root(double square, std::ptrdiff_t dim) noexcept {
    if (square < 0x1p-900) return 0.0;
    return std::sqrt(square) * (1.0 - static_cast<double>(dim + 6) * 0x1p-52);
}

double square_between_boxes(const double* a, const double* b, std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        const double gap = std::max(std::max(a[c] - b[dim + c], b[c] - a[dim + c]), 0.0);
        sum += gap * gap;
    }
    return sum;
}

// The finest level with at most `most` boxes.
int level_with(const BoxedCurve& curve, std::ptrdiff_t most) noexcept {
    int level = 0;
    while (curve.boxes(level) > most) ++level;
    return level;
}

}  // namespace

CurveSummary::CurveSummary(const curves::CheckedCurve& checked, const BoxedCurve& boxed)
    : largest_(checked.largest) {
    const std::ptrdiff_t dim = boxed.dim();
    const double* const first = boxed.point<0>(0);
    const double* const last = boxed.point<0>(boxed.size() - 1);
    const double* const box = boxed.box<0>(boxed.levels() - 1, 0);
    numbers_.reserve(static_cast<std::size_t>(4 * dim));
    numbers_.insert(numbers_.end(), first, first + dim);
    numbers_.insert(numbers_.end(), last, last + dim);
    numbers_.insert(numbers_.end(), box, box + 2 * dim);
}

double CurveSummary::bound(const CurveSummary& other, std::ptrdiff_t dim) const noexcept {
    const double* const p = numbers_.data();
    const double* const q = other.numbers_.data();
    const double ends =
        std::max(square_distance<0>(p, q, dim), square_distance<0>(p + dim, q + dim, dim));
    // The boxes' sides at either end of a coordinate: some point lies beyond the other curve by at
    // least their distance.
    double beyond = 0.0;
    for (std::ptrdiff_t c = 2 * dim; c < 4 * dim; ++c) {
        beyond = std::max(beyond, std::abs(p[c] - q[c]));
    }
    return safe_root(std::max(ends, beyond * beyond), dim);
}

void CurveSummary::write_row(double* row) const noexcept {
    *std::copy(numbers_.begin(), numbers_.end(), row) = largest_;
}

// As bound(), with each number of the other curve replaced by the nearest one in its interval. All
// operations are monotone.
double CurveSummary::bound_of_box(const double* box, std::ptrdiff_t dim) const noexcept {
    const double* const p = numbers_.data();
    const double* const least = box;
    const double* const greatest = box + 4 * dim + 1;
    const auto beyond_interval = [=](std::ptrdiff_t c) {
        return std::max(std::max(least[c] - p[c], p[c] - greatest[c]), 0.0);
    };
    double first = 0.0, last = 0.0, beyond = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        const double of_first = beyond_interval(c), of_last = beyond_interval(dim + c);
        first += of_first * of_first;
        last += of_last * of_last;
    }
    for (std::ptrdiff_t c = 2 * dim; c < 4 * dim; ++c) {
        beyond = std::max(beyond, beyond_interval(c));
    }
    return safe_root(std::max(std::max(first, last), beyond * beyond), dim);
}

double run_bound(const BoxedCurve& P, const BoxedCurve& Q, std::ptrdiff_t most_runs) {
    const int p_level = level_with(P, most_runs), q_level = level_with(Q, most_runs);
    const std::ptrdiff_t rows = P.boxes(p_level), columns = Q.boxes(q_level), dim = P.dim();
    runtime::ScratchVector<double> of_columns(static_cast<std::size_t>(columns), infinity);
    double furthest = 0.0;
    for (std::ptrdiff_t a = 0; a < rows; ++a) {
        double of_row = infinity;
        for (std::ptrdiff_t b = 0; b < columns; ++b) {
            const double square =
                square_between_boxes(P.box<0>(p_level, a), Q.box<0>(q_level, b), dim);
            of_row = std::min(of_row, square);
            double& of_column = of_columns[static_cast<std::size_t>(b)];
            of_column = std::min(of_column, square);
        }
        furthest = std::max(furthest, of_row);
    }
    for (const double square : of_columns) furthest = std::max(furthest, square);
    return safe_root(furthest, dim);
}

}  // namespace curvewise::continuous
