#include "warping/pair_bounds.hpp"

#include <algorithm>
#include <iterator>

#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"

namespace curvewise::detail {
namespace {

// With fewer cells, the table is swept as fast as the points are compared with boxes.
constexpr std::ptrdiff_t fewest_cells = 1 << 10;

// With more, the pruning of a single pair, which searches for its bounds, is the faster way.
constexpr std::ptrdiff_t most_narrowed_cells = 3 << 18;

std::ptrdiff_t boxes_at(int level) noexcept { return level == 1 ? 8 : 48; }

// The finest level of a tree with at most so many boxes.
std::ptrdiff_t tree_level(const BoxTree& tree, std::ptrdiff_t most_boxes) noexcept {
    std::ptrdiff_t level = 0;
    while (tree.boxes(level) > most_boxes) ++level;
    return level;
}

void append_summary(const BoxTree& tree, std::vector<double>& summary) {
    const PointAccess& points = tree.points();
    const std::ptrdiff_t dim = tree.dim();
    for (std::ptrdiff_t c = 0; c < dim; ++c) summary.push_back(points(0, c));
    for (std::ptrdiff_t c = 0; c < dim; ++c) summary.push_back(points(tree.size() - 1, c));
    const double* const box = tree.box(tree.levels() - 1, 0);
    summary.insert(summary.end(), box, box + 2 * dim);
}

template <class Norm>
double distance(const double* a, const double* b, std::ptrdiff_t dim) noexcept {
    double sum = 0.0;
    for (std::ptrdiff_t c = 0; c < dim; ++c) sum = Norm::add(sum, a[c] - b[c]);
    return Norm::finish(sum);
}

// Four sums side by side: the order does not matter here.
double sum_of(const double* terms, std::ptrdiff_t count) noexcept {
    double sums[4] = {};
    std::ptrdiff_t k = 0;
    for (; k + 4 <= count; k += 4) {
        for (std::ptrdiff_t lane = 0; lane < 4; ++lane) sums[lane] += terms[k + lane];
    }
    for (; k < count; ++k) sums[0] += terms[k];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

void KeptBounds::keep(const CheckedCurve& Q, const PackedCurve& packed, PointOrder order) {
    trees_.emplace_back(packed, order);
    dim_ = packed.dim();
    append_summary(trees_.back(), summaries_);
    largest_.push_back(Q.largest);
}

void KeptBounds::take(KeptBounds& others) {
    dim_ = std::max(dim_, others.dim_);
    largest_.insert(largest_.end(), others.largest_.begin(), others.largest_.end());
    summaries_.insert(summaries_.end(), others.summaries_.begin(), others.summaries_.end());
    trees_.insert(trees_.end(), std::make_move_iterator(others.trees_.begin()),
                  std::make_move_iterator(others.trees_.end()));
    others = KeptBounds();
}

PairBounds::PairBounds(const WarpingOptions& options, const KeptBounds& kept, const CheckedCurve& P,
                       const PackedCurve& packed)
    : options_(options),
      kept_(kept),
      P_(packed),
      metric_(canonical_metric(options.ground, packed.dim())),
      kernel_(active_level().kernels->least(metric_, packed.dim())),
      largest_(P.largest),
      tree_(packed, PointOrder::forward) {
    append_summary(tree_, summary_);
}

bool PairBounds::is_bounded(std::ptrdiff_t j) const noexcept {
    return has_box_bounds(metric_) &&
           RangeScale(std::max(largest_, kept_.largest(j))).is_identity();
}

template <class Norm>
double PairBounds::quick_bound(std::ptrdiff_t j) const noexcept {
    if (!is_bounded(j)) return 0.0;
    const std::ptrdiff_t dim = tree_.dim();
    const double* const p = summary_.data();
    const double* const q = kept_.summary(j);
    const double first = options_.open_begin ? 0.0 : distance<Norm>(p, q, dim);
    const double last = options_.open_end ? 0.0 : distance<Norm>(p + dim, q + dim, dim);
    const bool is_one_cell = tree_.size() == 1 && kept_.tree(j).size() == 1;
    const double ends = is_frechet() || is_one_cell ? std::max(first, last) : first + last;
    // Some point of the one curve lies so far beyond all points of the other.
    double beyond = 0.0;
    for (std::ptrdiff_t c = 2 * dim; c < 3 * dim; ++c) {
        const double low = q[c] - p[c], high = p[c + dim] - q[c + dim];
        beyond = std::max(beyond, std::max(low, high));
        if (!is_open()) beyond = std::max(beyond, std::max(-low, -high));
    }
    return std::max(ends, Norm::finish(Norm::add(0.0, beyond)));
}

void PairBounds::quick(double* bounds) const {
    with_norm(metric_, [&](auto norm) {
        for (std::ptrdiff_t j = 0; j < kept_.size(); ++j) {
            bounds[j] = quick_bound<decltype(norm)>(j);
        }
    });
}

void PairBounds::least(const PackedCurve& points, PointOrder order, const BoxTree& boxes,
                       std::ptrdiff_t most_boxes, AlignedBuffer& out) {
    const std::ptrdiff_t level = tree_level(boxes, most_boxes);
    const std::ptrdiff_t count = points.size();
    out.reserve(AlignedBuffer::rounded(count + kernels::padding));
    kernels::PointsAndBoxes sides{points.data(),       points.stride(), count,
                                  points.dim(),        boxes.box(level, 0),
                                  boxes.boxes(level),  nullptr,         nullptr,
                                  out.data()};
    const Band band(count, boxes.size(), options_.window);
    if (band.is_limited()) {
        first_box_.resize(static_cast<std::size_t>(count));
        last_box_.resize(static_cast<std::size_t>(count));
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const ColumnRange range = band.columns(i);
            const std::ptrdiff_t points_per_box = BoxTree::leaf_points << level;
            const auto place =
                static_cast<std::size_t>(order == PointOrder::forward ? i : count - 1 - i);
            first_box_[place] = range.first / points_per_box;
            last_box_[place] = range.last / points_per_box;
        }
        sides.first_box = first_box_.data();
        sides.last_box = last_box_.data();
    }
    kernel_(sides);
}

void PairBounds::compute_terms(std::ptrdiff_t j, const PackedCurve& q, int level) {
    if (terms_of_ == j && terms_level_ == level) return;
    least(P_, PointOrder::forward, kept_.tree(j), boxes_at(level), row_terms_);
    if (!is_open()) least(q, PointOrder::reversed, tree_, boxes_at(level), column_terms_);
    terms_of_ = j;
    terms_level_ = level;
}

double PairBounds::refined(std::ptrdiff_t j, const PackedCurve& q, int level) {
    const std::ptrdiff_t n = P_.size(), m = q.size();
    if (!is_bounded(j) || n * m < fewest_cells) return 0.0;
    compute_terms(j, q, level);
    const double* const rows = row_terms_.data();
    const double* const columns = column_terms_.data();
    if (is_frechet()) {
        return std::max(*std::max_element(rows, rows + n),
                        *std::max_element(columns, columns + m));
    }
    const double slack = 1.0 - static_cast<double>(n + m + 2) * 0x1p-52;
    if (is_open()) return sum_of(rows, n) * slack;
    if (options_.recurrence == kernels::Recurrence::dtw_symmetric1) {
        return std::max(sum_of(rows, n), sum_of(columns, m)) * slack;
    }
    // symmetric2 pays for rows and columns, except for the first cell: once.
    const double rest = sum_of(rows + 1, n - 1) + sum_of(columns, m - 1);
    return (rest + std::max(rows[0], columns[m - 1])) * slack;
}

std::optional<CostToGo> PairBounds::cost_to_go(std::ptrdiff_t j, const PackedCurve& q,
                                               double most) {
    const std::ptrdiff_t n = P_.size(), m = q.size();
    if (!is_bounded(j) || n * m < fewest_cells || n * m >= most_narrowed_cells ||
        options_.open_begin) {
        return std::nullopt;
    }
    sums_.assign(n, m, options_.recurrence == kernels::Recurrence::dtw_symmetric2);
    if (!is_frechet()) {
        compute_terms(j, q, levels - 1);
        std::copy_n(row_terms_.data(), n, sums_.rows());
        if (!is_open()) std::reverse_copy(column_terms_.data(), column_terms_.data() + m, sums_.columns());
        sums_.add_up();
    }
    return sums_.cost_to_go(most);
}

}  // namespace curvewise::detail
