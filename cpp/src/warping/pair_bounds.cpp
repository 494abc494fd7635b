#include "warping/pair_bounds.hpp"

#include <algorithm>
#include <limits>

#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// With fewer cells, the table is swept as fast as the points are compared with boxes.
constexpr std::ptrdiff_t fewest_cells = 1 << 10;
// With a band, where each point has a single box.
constexpr std::ptrdiff_t fewest_cells_of_lines = 1 << 6;

// In several dimensions, the bound of one box for each point takes less time than that of several
// boxes, which is larger. The latter pays where a table has more cells than these, divided by d^2.
constexpr std::ptrdiff_t most_narrow_cells = 5 << 15;

// With more, the pruning of a single pair, which searches for its bounds, is the faster way.
constexpr std::ptrdiff_t most_narrowed_cells = 3 << 18;

constexpr int point_level = 3;

// Of a bound, by what a sweep adds to it before it gives up.
constexpr double most_raise = 4.0;

double sum_of(const double* terms, std::ptrdiff_t count) noexcept {
    return active_level().kernels->sum(terms, count);
}

// The sum over runs of `points` points of a curve of `size`, with a term for every point except the
// first.
double sum_but_one(const double* terms, std::ptrdiff_t runs, std::ptrdiff_t points,
                   std::ptrdiff_t size) noexcept {
    if (runs == 1) return terms[0] * static_cast<double>(size - 1);
    const std::ptrdiff_t in_last = size - (runs - 1) * points;
    return terms[0] * static_cast<double>(points - 1) +
           sum_of(terms + 1, runs - 2) * static_cast<double>(points) +
           terms[runs - 1] * static_cast<double>(in_last);
}

// As smallest_distance(), before the norm's finish, which is monotone.
template <class Norm>
double unfinished_distance(const double* a, const double* b, std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        sum = Norm::add(sum, std::max(std::max(a[c] - b[dim + c], b[c] - a[dim + c]), 0.0));
    }
    return sum;
}

// Boxes in one dimension. Closing gaps that are small relative to all values lowers a bound only a
// little.
std::ptrdiff_t merge(const BoxLevel& boxes, AlignedBuffer& merged) {
    double low = infinity, high = -infinity;
    for (std::ptrdiff_t b = 0; b < boxes.count; ++b) {
        low = std::min(low, boxes.boxes[2 * b]);
        high = std::max(high, boxes.boxes[2 * b + 1]);
    }
    merged.reserve(2 * boxes.count);
    return merge_intervals(boxes.boxes, boxes.count, (high - low) / 16.0, merged.data());
}

// For every point.
kernels::PointsAndBoxes all_of(const double* boxes, std::ptrdiff_t count) noexcept {
    kernels::PointsAndBoxes all{};
    all.boxes = boxes;
    all.box_count = count;
    return all;
}

}  // namespace

PairBounds::PairBounds(const WarpingOptions& options, const KeptBounds& kept, const CheckedCurve& P,
                       const PackedCurve& packed)
    : options_(options),
      kept_(kept),
      P_(packed),
      metric_(canonical_metric(options.ground, packed.dim())),
      kernel_(active_level().kernels->least(metric_of_boxes(metric_), packed.dim())),
      extremes_(active_level().kernels->extremes),
      tree_(packed, PointOrder::forward),
      first_(options, kept, P, tree_),
      they_add_(is_symmetric2()) {
    if (!is_banded()) return;
    reversed_stride_ = AlignedBuffer::rounded(packed.size() + kernels::padding);
    reversed_.reserve(packed.dim() * reversed_stride_);
    for (std::ptrdiff_t c = 0; c < packed.dim(); ++c) {
        const double* const from = packed.data() + c * packed.stride();
        double* const to = reversed_.data() + c * reversed_stride_;
        std::reverse_copy(from, from + packed.size(), to);
        std::fill(to + packed.size(), to + reversed_stride_, 0.0);
    }
}

bool PairBounds::has_narrow_band(std::ptrdiff_t m) const noexcept {
    const std::ptrdiff_t n = P_.size(), dim = tree_.dim();
    const auto window = options_.window.between(n, m);
    return !is_line() && window && *window < m &&
           n * (2 * *window + 1) <= most_narrow_cells / (dim * dim) &&
           Band(n, m, window).is_limited();
}

void BandedBoxes::assign(std::ptrdiff_t count, PointOrder order, std::ptrdiff_t size,
                         std::ptrdiff_t points_per_box, std::optional<std::ptrdiff_t> window) {
    if (count == count_ && size == size_) return;
    count_ = count;
    size_ = size;
    const Band band(count, size_, window);
    is_limited_ = band.is_limited();
    if (!is_limited_) return;
    first_.resize(static_cast<std::size_t>(count));
    last_.resize(static_cast<std::size_t>(count));
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const ColumnRange range = band.columns(i);
        const auto place =
            static_cast<std::size_t>(order == PointOrder::forward ? i : count - 1 - i);
        first_[place] = range.first / points_per_box;
        last_[place] = range.last / points_per_box;
    }
}

kernels::PointsAndBoxes BandedBoxes::of(const BoxLevel& boxes) const noexcept {
    kernels::PointsAndBoxes banded = all_of(boxes.boxes, boxes.count);
    if (is_limited_) {
        banded.first_box = first_.data();
        banded.last_box = last_.data();
    }
    return banded;
}

// By the row terms that were computed last.
double PairBounds::combined(double rows, double columns, double first_row,
                            double first_column) const {
    if (!they_add_) return std::max(rows + first_row, columns + first_column);
    // symmetric2 pays for the first cell once.
    return rows + columns +
           (is_symmetric2() ? std::max(first_row, first_column) : first_row + first_column);
}

// Whether differences add up to at most the difference between the ends, so that rounding changes
// each by a few units in its last place. No square of a difference is too small for that.
bool PairBounds::has_ways_through(const PackedCurve& q) const noexcept {
    return is_line() && options_.rule == kernels::Rule::dtw_symmetric1 &&
           (metric_ != Metric::sqeuclidean || PackedPair{P_, q}.squares_are_in_domain());
}

template <class Norm>
double PairBounds::run_bound(std::ptrdiff_t j, int level) {
    const BoxLevel P = level_with(tree_, KeptBoxes::most_boxes[KeptBounds::limit_of(level)]);
    const BoxLevel Q = kept_.boxes(j, level, tree_.dim(), boxes_);
    const std::ptrdiff_t rows = P.count, columns = Q.count, dim = tree_.dim();
    const std::ptrdiff_t row_points = P.points_per_box(), column_points = Q.points_per_box();
    const std::ptrdiff_t n = tree_.size(), m = kept_[j].points;
    const Band band(n, m, options_.window.between(n, m));
    run_terms_.assign(static_cast<std::size_t>(rows + columns), infinity);
    double* const row_terms = run_terms_.data();
    double* const column_terms = row_terms + rows;
    for (std::ptrdiff_t a = 0; a < rows; ++a) {
        std::ptrdiff_t first = 0, last = columns - 1;
        if (band.is_limited()) {
            const std::ptrdiff_t end = std::min((a + 1) * row_points, n);
            first = band.columns(a * row_points).first / column_points;
            last = band.columns(end - 1).last / column_points;
        }
        double least = infinity;
        for (std::ptrdiff_t b = first; b <= last; ++b) {
            const double sum =
                unfinished_distance<Norm>(P.boxes + a * 2 * dim, Q.boxes + b * 2 * dim, dim);
            least = std::min(least, sum);
            column_terms[b] = std::min(column_terms[b], sum);
        }
        row_terms[a] = least;
    }
    for (double& term : run_terms_) term = Norm::finish(term);
    first_.finish(run_terms_.data(), rows + columns);
    if (is_frechet()) return *std::max_element(run_terms_.begin(), run_terms_.end());
    const double rest_of_rows = sum_but_one(row_terms, rows, row_points, n);
    if (is_open()) return combined(rest_of_rows, 0.0, row_terms[0], 0.0);
    const double rest_of_columns = sum_but_one(column_terms, columns, column_points, m);
    return combined(rest_of_rows, rest_of_columns, row_terms[0], column_terms[0]);
}

double PairBounds::point_bound(std::ptrdiff_t j, const PackedCurve& q) {
    compute_row_terms(j, q);
    compute_column_terms(j, q);
    const std::ptrdiff_t n = P_.size(), m = q.size();
    const double* const rows = row_terms_.data();
    const double* const columns = column_terms_.data();
    if (is_frechet()) {
        return std::max(*std::max_element(rows, rows + n), *std::max_element(columns, columns + m));
    }
    const double rest_of_rows = sum_of(rows_are_reversed_ ? rows : rows + 1, n - 1);
    if (is_open()) return combined(rest_of_rows, 0.0, rows[0], 0.0);
    const double first_row = rows[rows_are_reversed_ ? n - 1 : 0];
    return combined(rest_of_rows, sum_of(columns, m - 1), first_row, columns[m - 1]);
}

double PairBounds::column_bound(std::ptrdiff_t j, const PackedCurve& q) {
    if (is_open()) return 0.0;
    compute_column_terms(j, q);
    const double* const columns = column_terms_.data();
    if (is_frechet()) return *std::max_element(columns, columns + q.size());
    return sum_of(columns, q.size());
}

double PairBounds::undivided(std::ptrdiff_t j, const PackedCurve& q, int level) {
    const bool has_two_levels = is_line() || has_narrow_band(q.size());
    if (has_two_levels && level == 1) return column_bound(j, q);
    if (has_two_levels && level == point_level) return 0.0;  // it was level 2
    if (has_two_levels || level == point_level) return point_bound(j, q);
    return with_norm(first_.box_metric(),
                     [&](auto norm) { return run_bound<decltype(norm)>(j, level); });
}

double PairBounds::refined(std::ptrdiff_t j, const PackedCurve& q, int level) {
    const std::ptrdiff_t n = P_.size(), m = q.size();
    const bool has_boxes_of_points = is_line() ? is_banded() : has_narrow_band(m);
    const bool is_short = n * m < (has_boxes_of_points ? fewest_cells_of_lines : fewest_cells);
    if (!is_bounded(j) || is_short) return 0.0;
    const double bound = undivided(j, q, level);
    if (is_frechet()) return bound;
    return bound * CostSums::slack(n, m) / options_.divisor(n, m);
}

void PairBounds::compute_terms(const PackedCurve& points, kernels::PointsAndBoxes boxes,
                               AlignedBuffer& terms) const {
    terms.reserve(AlignedBuffer::rounded(points.size() + kernels::padding));
    boxes.points = points.data();
    boxes.stride = points.stride();
    boxes.count = points.size();
    boxes.dim = points.dim();
    boxes.least = terms.data();
    kernel_(boxes);
    first_.finish(terms.data(), points.size());
}

void PairBounds::compute_row_terms(std::ptrdiff_t j, const PackedCurve& q) {
    if (row_terms_of_ == j) return;
    row_terms_of_ = j;
    they_add_ = is_symmetric2();
    rows_are_reversed_ = false;
    const auto window = options_.window.between(P_.size(), q.size());
    if ((is_line() || has_narrow_band(q.size())) &&
        values_of_rows_.assign(P_.size(), q.size(), window)) {
        they_add_ = they_add_ || has_ways_through(q);
        return compute_banded_row_terms(j, q);
    }
    const BoxLevel boxes = kept_.boxes(j, point_level, tree_.dim(), boxes_);
    if (is_line()) {
        const std::ptrdiff_t count = merge(boxes, merged_of_kept_);
        return compute_terms(P_, all_of(merged_of_kept_.data(), count), row_terms_);
    }
    boxes_of_rows_.assign(P_.size(), PointOrder::forward, q.size(), boxes.points_per_box(), window);
    compute_terms(P_, boxes_of_rows_.of(boxes), row_terms_);
}

void PairBounds::compute_banded_row_terms(std::ptrdiff_t j, const PackedCurve& q) {
    if (has_ways_through(q)) {
        compute_column_terms(j, q);
        values_of_rows_.enclose(nearest_values_.data(), q.size(), 1, extremes_);
    } else {
        values_of_rows_.enclose(q.data(), q.stride(), q.dim(), extremes_);
    }
    kernels::PointsAndBoxes own = values_of_rows_.each();
    own.points = reversed_.data();
    own.stride = reversed_stride_;
    own.count = P_.size();
    own.dim = P_.dim();
    row_terms_.reserve(AlignedBuffer::rounded(own.count + kernels::padding));
    own.least = row_terms_.data();
    kernel_(own);
    first_.finish(row_terms_.data(), own.count);
    rows_are_reversed_ = true;
}

void PairBounds::compute_column_terms(std::ptrdiff_t j, const PackedCurve& q) {
    if (is_open() || column_terms_of_ == j) return;
    column_terms_of_ = j;
    const auto window = options_.window.between(q.size(), P_.size());
    if ((is_line() || has_narrow_band(q.size())) &&
        values_of_columns_.assign(q.size(), P_.size(), window)) {
        if (values_of_columns_.is_new()) {
            values_of_columns_.enclose(reversed_.data(), reversed_stride_, q.dim(), extremes_);
        }
        kernels::PointsAndBoxes own = values_of_columns_.each();
        if (has_ways_through(q)) {
            nearest_values_.reserve(q.size() + kernels::padding);
            own.nearest = nearest_values_.data();
        }
        return compute_terms(q, own, column_terms_);
    }
    const BoxLevel boxes = point_level_boxes();
    if (is_line()) {
        if (merged_count_ == 0) merged_count_ = merge(boxes, merged_);
        return compute_terms(q, all_of(merged_.data(), merged_count_), column_terms_);
    }
    boxes_of_columns_.assign(q.size(), PointOrder::reversed, P_.size(), boxes.points_per_box(),
                             window);
    compute_terms(q, boxes_of_columns_.of(boxes), column_terms_);
}

BoxLevel PairBounds::point_level_boxes() const noexcept {
    return level_with(tree_, KeptBoxes::most_boxes[KeptBounds::limit_of(point_level)]);
}

std::optional<CostToGo> PairBounds::cost_to_go(std::ptrdiff_t j, const PackedCurve& q,
                                               double most) {
    const std::ptrdiff_t n = P_.size(), m = q.size();
    if (!is_bounded(j) || n * m < fewest_cells || n * m >= most_narrowed_cells ||
        options_.open_begin) {
        return std::nullopt;
    }
    if (is_frechet()) {
        sums_.assign(n, m, they_add_);
        return sums_.cost_to_go(most);
    }
    compute_row_terms(j, q);
    compute_column_terms(j, q);
    const double* const rows = row_terms_.data();
    if (is_open()) {
        sums_.assign(n, m, they_add_);
        std::copy_n(rows, n, sums_.rows());
        sums_.add_up();
    } else if (rows_are_reversed_) {
        sums_.add_up(rows, 1, n, column_terms_.data(), m, they_add_);
    } else {
        sums_.add_up(rows + n - 1, -1, n, column_terms_.data(), m, they_add_);
    }
    // Where the bounds are far below it, few cells are pruned.
    if (sums_.all() * most_raise < most) return std::nullopt;
    return sums_.cost_to_go(most);
}

bool PairBounds::is_of_lines() const noexcept {
    return is_line() && !is_open() && options_.rule == kernels::Rule::dtw_symmetric1;
}

double PairBounds::line_value(const PackedCurve& q, const CostToGo& cost_to_go) {
    const auto window = options_.window.between(P_.size(), q.size());
    return line_table_.value({P_, q}, metric_, window, cost_to_go);
}

}  // namespace curvewise::warping
