#include "warping/curves_beside.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "warping/cost_sums.hpp"
#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"

namespace curvewise::warping {
namespace {

kernels::Cost cost_of(const WarpingOptions& options, std::ptrdiff_t dim, bool in_domain) noexcept {
    return {canonical_metric(options.ground, dim), in_domain, options.ground.own != nullptr};
}

// Writes the curves that curve(lane) gives, of at most `size` points, to `lanes` lanes. What a lane
// has beyond its curve's end is 0.
template <class Curve>
void interleave(const Curve& curve, PointOrder order, std::ptrdiff_t lanes, std::ptrdiff_t size,
                std::ptrdiff_t stride, double* to) {
    constexpr std::ptrdiff_t most = kernels::padding * kernels::most_packs_beside;
    const std::ptrdiff_t dim = curve(0).dim(), step = order == PointOrder::reversed ? -1 : 1;
    const double* from[most];
    std::ptrdiff_t shared = size;
    for (std::ptrdiff_t l = 0; l < lanes; ++l) shared = std::min(shared, curve(l).size());
    for (std::ptrdiff_t c = 0; c < dim; ++c) {
        for (std::ptrdiff_t l = 0; l < lanes; ++l) {
            const PackedCurve& packed = curve(l);
            from[l] = packed.data() + c * packed.stride() + (step < 0 ? packed.size() - 1 : 0);
        }
        double* row = to + c * stride;
        for (std::ptrdiff_t j = 0; j < shared; ++j, row += dim * stride) {
            for (std::ptrdiff_t l = 0; l < lanes; ++l) row[l] = from[l][step * j];
        }
        for (std::ptrdiff_t j = shared; j < size; ++j, row += dim * stride) {
            for (std::ptrdiff_t l = 0; l < lanes; ++l) {
                row[l] = j < curve(l).size() ? from[l][step * j] : 0.0;
            }
        }
    }
}

bool needs_no_scale(const WarpingOptions& options, const curves::CheckedCurve& curve) noexcept {
    return range_of(options.ground, curve.largest).is_identity();
}

// The cells of a row with which all lanes, full, take as long as the pairs take one by one. More
// cells are swept faster down the anti-diagonals of one pair, whose values stay in registers.
// Measured at each level, with and without a band.
constexpr std::ptrdiff_t most_cells = 100;
constexpr std::ptrdiff_t most_cells_of_roots = 64;
// With more, no band and few coordinates, a search that gives pairs up early takes less time one by
// one.
constexpr std::ptrdiff_t most_searched_cells = 64;
// So that the row and the points stay near the processor.
constexpr std::ptrdiff_t most_columns = 1024;

std::ptrdiff_t lanes_beside() noexcept {
    return active_level().kernels->lanes * kernels::most_packs_beside;
}

// Most cells of a row.
std::ptrdiff_t cells_of_row(const Window& window, std::ptrdiff_t n, std::ptrdiff_t m) noexcept {
    const std::optional<std::ptrdiff_t> radius = window.between(n, m);
    if (!radius || n < 2 || m < 2 || *radius >= std::max(n, m)) return m;
    const std::ptrdiff_t reach = n >= m ? *radius : *radius * (m - 1) / (n - 1);
    return std::min(m, 2 * reach + 1);
}

bool has_roots(const WarpingOptions& options, std::ptrdiff_t dim) noexcept {
    return options.rule != kernels::Rule::frechet &&
           canonical_metric(options.ground, dim) == Metric::euclidean;
}

// Whether so many pairs of n and m points take less time together than one by one.
bool saves_time(const WarpingOptions& options, std::ptrdiff_t n, std::ptrdiff_t m,
                std::ptrdiff_t dim, std::ptrdiff_t pairs) noexcept {
    const std::ptrdiff_t most = has_roots(options, dim) ? most_cells_of_roots : most_cells;
    return m <= most_columns && cells_of_row(options.window, n, m) * lanes_beside() <= most * pairs;
}

// The time of a pair among others, of its bound, and of a pair that is a candidate. In cells of a
// table, by measurement.
struct Efforts {
    Efforts(const WarpingOptions& options, std::ptrdiff_t n, std::ptrdiff_t m, std::ptrdiff_t dim)
        : pair(n * cells_of_row(options.window, n, m) * dim),
          bound((m + 80) * dim),
          candidate(pair + pair / 2 + 4 * (n + m) * dim) {}

    // The time that bounds of `count` pairs save, divided by their time; below 0 if they lose time.
    double saved(std::ptrdiff_t count, std::ptrdiff_t candidates) const noexcept {
        const std::ptrdiff_t saved = count * (pair - bound) - candidates * candidate;
        return static_cast<double>(saved) / static_cast<double>(count * bound);
    }

    std::ptrdiff_t pair, bound, candidate;
};

}  // namespace

// The root of the table's values, and the kernels, null for pairs that are swept one by one.
struct CurvesBeside::Sweep {
    Sweep(const WarpingOptions& options, std::ptrdiff_t dim, bool in_domain) noexcept {
        kernels::Cost cost = cost_of(options, dim, in_domain);
        if (options.rule == kernels::Rule::frechet && !cost.is_own) {
            root = put_off_root(cost, options.ground);
        }
        if (options.open_begin || options.open_end || takes_degrees(options.ground.metric)) {
            return;
        }
        functions = active_level().kernels->beside(options.rule, cost, dim);
    }

    PutOffRoot root;
    kernels::BesideKernels functions;
};

CurvesBeside::Sweep CurvesBeside::sweep_with(const WarpingOptions& options,
                                             const P& curve) const noexcept {
    return {options, dim_, squares_are_in_domain_ && curve.packed.squares_are_in_domain()};
}

std::ptrdiff_t CurvesBeside::most(const WarpingOptions& options, std::ptrdiff_t n, std::ptrdiff_t m,
                                  std::ptrdiff_t dim) noexcept {
    if (Sweep(options, dim, true).functions.sweep == nullptr) return 1;
    return saves_time(options, n, m, dim, lanes_beside()) ? lanes_beside() : 1;
}

pairwise::BesideEffort CurvesBeside::effort(const WarpingOptions& options, std::ptrdiff_t n,
                                            std::ptrdiff_t m, std::ptrdiff_t dim) noexcept {
    const std::ptrdiff_t points = (n + m) * dim;
    const std::ptrdiff_t table = n * cells_of_row(options.window, n, m) * dim;
    const bool have_roots = has_roots(options, dim);
    pairwise::BesideEffort effort;
    effort.value = static_cast<double>(have_roots ? 2 * table : table);
    effort.bound = static_cast<double>((m + 30) * (dim > 2 ? 2 * dim : dim));
    // Both curves are interleaved, and read again for each cell.
    const double reading = have_roots ? 1.1 : dim > 2 ? 1.5 : 1.2;
    effort.candidate = reading * effort.value + static_cast<double>(3 * points + 60);
    // A box for each point, or several for all (PairBounds).
    const bool has_own_boxes = dim == 1 || options.window.radius || options.window.fraction;
    const std::ptrdiff_t later_bounds =
        has_own_boxes ? 3000 + 4 * points : 1000 * dim + 48 * points;
    effort.is_large = table > 3 * later_bounds;
    effort.is_wide = dim <= 3 && cells_of_row(options.window, n, m) == m && m > most_searched_cells;
    return effort;
}

std::ptrdiff_t CurvesBeside::gather(const WarpingOptions& options, const Q* const* curves,
                                    std::ptrdiff_t count, bool has_cutoff) {
    static_assert(most_lanes >= kernels::padding * kernels::most_packs_beside);
    stride_ = lanes_beside();
    columns_ = curves[0]->packed.size();
    dim_ = curves[0]->packed.dim();
    count = std::min(count, stride_);
    // Bounds alone save time with fewer.
    if (!has_cutoff && !saves_time(options, columns_, columns_, dim_, count)) return 0;
    const bool is_limited = options.window.radius || options.window.fraction;
    const std::ptrdiff_t fewest = is_limited ? columns_ : columns_ - columns_ / 8;
    squares_are_in_domain_ = true;
    for (count_ = 0; count_ < count; ++count_) {
        const Q& curve = *curves[count_];
        if (curve.packed.size() < fewest || !needs_no_scale(options, curve.checked)) break;
        squares_are_in_domain_ = squares_are_in_domain_ && curve.packed.squares_are_in_domain();
        sizes_[static_cast<std::size_t>(count_)] = curve.packed.size();
    }
    if (count_ == 0) return 0;
    points_.reserve(columns_ * dim_ * stride_);
    row_.reserve(columns_ * stride_);
    const std::ptrdiff_t width = active_level().kernels->lanes;
    const std::ptrdiff_t lanes = (count_ + width - 1) / width * width;
    const auto curve = [&](std::ptrdiff_t lane) -> const PackedCurve& {
        return curves[std::min(lane, count_ - 1)]->packed;
    };
    interleave(curve, PointOrder::reversed, lanes, columns_, stride_, points_.data());
    return count_;
}

void CurvesBeside::limit_rows(const WarpingOptions& options, std::ptrdiff_t n) {
    const auto rows = static_cast<std::size_t>(n);
    if (columns_of_ends_ == columns_ && ends_.size() == 2 * rows) return;
    columns_of_ends_ = columns_;
    ends_.resize(2 * rows);
    const Band band(n, columns_, options.window.between(n, columns_));
    for (std::size_t i = 0; i < rows; ++i) {
        const ColumnRange columns = band.columns(static_cast<std::ptrdiff_t>(i));
        ends_[i] = columns.first;
        ends_[rows + i] = columns.last;
    }
}

bool CurvesBeside::distances(const WarpingOptions& options, const P& curve, std::ptrdiff_t first,
                             double* out, Poller& poller) {
    const std::ptrdiff_t n = curve.packed.size();
    if (!needs_no_scale(options, curve.checked) ||
        !saves_time(options, n, columns_, dim_, count_ - first)) {
        return false;
    }
    const Sweep sweep = sweep_with(options, curve);
    if (sweep.functions.sweep == nullptr) return false;
    limit_rows(options, n);
    const std::ptrdiff_t width = active_level().kernels->lanes;
    const std::ptrdiff_t skipped = first / width * width;
    sweep.functions.sweep({curve.packed.data(), curve.packed.stride(), points_.data() + skipped,
                           stride_, static_cast<int>(dim_), n, ends_.data(), ends_.data() + n,
                           (count_ - skipped + width - 1) / width, row_.data() + skipped});
    finish(options, sweep.root, n, first, out, poller);
    return true;
}

void CurvesBeside::finish(const WarpingOptions& options, const PutOffRoot& root, std::ptrdiff_t n,
                          std::ptrdiff_t first, double* out, Poller& poller) const {
    std::int64_t points = 0;
    for (std::ptrdiff_t lane = first; lane < count_; ++lane) {
        const std::ptrdiff_t m = sizes_[static_cast<std::size_t>(lane)];
        const double found = root(row_.data()[(m - 1) * stride_ + lane]) / options.divisor(n, m);
        *out++ = found > options.cutoff ? std::numeric_limits<double>::infinity() : found;
        points += m;
    }
    const auto weight = static_cast<std::int64_t>(options.ground.weight(static_cast<double>(dim_)));
    if (poller.count_steps(n * points, weight)) throw Stopped();
}

bool CurvesBeside::pair_distances(const WarpingOptions& options, const P* const* Ps,
                                  const Q* const* Qs, std::ptrdiff_t count, double* out,
                                  Poller& poller) {
    const std::ptrdiff_t n = Ps[0]->packed.size(), dim = Ps[0]->packed.dim();
    // All lanes are swept, also if there are fewer pairs.
    std::array<const Q*, most_lanes> all{};
    for (std::ptrdiff_t lane = 0; lane < lanes_beside(); ++lane) {
        all[static_cast<std::size_t>(lane)] = Qs[std::min(lane, count - 1)];
    }
    if (!saves_time(options, n, Qs[0]->packed.size(), dim, count) ||
        gather(options, all.data(), lanes_beside(), false) < lanes_beside()) {
        return false;
    }
    bool in_domain = squares_are_in_domain_;
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        if (!needs_no_scale(options, Ps[k]->checked)) return false;
        in_domain = in_domain && Ps[k]->packed.squares_are_in_domain();
    }
    const Sweep sweep(options, dim, in_domain);
    if (sweep.functions.sweep_pairs == nullptr) return false;
    points_of_each_.reserve(n * dim * stride_);
    const auto curve = [&](std::ptrdiff_t lane) -> const PackedCurve& {
        return Ps[std::min(lane, count - 1)]->packed;
    };
    interleave(curve, PointOrder::forward, stride_, n, stride_, points_of_each_.data());
    count_ = count;
    limit_rows(options, n);
    sweep.functions.sweep_pairs({points_of_each_.data(), stride_, points_.data(), stride_,
                                 static_cast<int>(dim_), n, ends_.data(), ends_.data() + n,
                                 kernels::most_packs_beside, row_.data()});
    finish(options, sweep.root, n, 0, out, poller);
    return true;
}

// The boxes of the columns, in reverse.
void CurvesBeside::enclose(const WarpingOptions& options, const PackedCurve& curve,
                           kernels::BoundsBeside& beside) {
    const std::ptrdiff_t n = curve.size(), last = columns_ - 1;
    const auto window = options.window.between(columns_, n);
    reversed_.reserve(n + kernels::padding);
    sides_.reserve(2 * dim_ * columns_);
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        const double* const points = curve.data() + c * curve.stride();
        BandedValues& boxes = boxes_[static_cast<std::size_t>(c)];
        if (boxes.assign(columns_, n, window)) {
            std::reverse_copy(points, points + n, reversed_.data());
            boxes.enclose(reversed_.data(), n, 1, active_level().kernels->extremes);
            beside.low[c] = boxes.each().low + last;
            beside.high[c] = boxes.each().high + last;
        } else {
            const auto [least, greatest] = std::minmax_element(points, points + n);
            double* const low = sides_.data() + 2 * c * columns_;
            std::fill_n(low, columns_, *least);
            std::fill_n(low + columns_, columns_, *greatest);
            beside.low[c] = low + last;
            beside.high[c] = low + columns_ + last;
        }
    }
}

// In the unit of the table.
void CurvesBeside::bound_lanes(const WarpingOptions& options, const Sweep& sweep, const P& curve,
                               double most, std::ptrdiff_t first, double* bounds) {
    const std::ptrdiff_t n = curve.packed.size();
    const std::ptrdiff_t fewest = sizes_[static_cast<std::size_t>(count_ - 1)];
    const std::ptrdiff_t width = active_level().kernels->lanes;
    const std::ptrdiff_t skipped = first / width * width;
    kernels::BoundsBeside beside{};
    beside.p = curve.packed.data();
    beside.p_stride = curve.packed.stride();
    beside.q = points_.data() + skipped;
    beside.stride = stride_;
    beside.dim = static_cast<int>(dim_);
    beside.rows = n;
    beside.columns = fewest;
    beside.has_last = fewest == columns_;
    beside.packs = (count_ - skipped + width - 1) / width;
    beside.most = most;
    beside.bounds = bounds + skipped;
    enclose(options, curve.packed, beside);
    sweep.functions.bounds(beside);
    // Sums in another order than the table's have a slack, the largest of some distances has none.
    if (options.rule == kernels::Rule::frechet) return;
    const double slack = CostSums::slack(n, columns_);
    for (std::ptrdiff_t lane = first; lane < count_; ++lane) bounds[lane] *= slack;
}

bool CurvesBeside::may_be_bounded(const WarpingOptions& options, const P& curve) const noexcept {
    return sizes_[static_cast<std::size_t>(count_ - 1)] >= 2 &&
           needs_no_scale(options, curve.checked);
}

std::ptrdiff_t CurvesBeside::candidates(const WarpingOptions& options, double cutoff,
                                        const P& curve, std::ptrdiff_t first,
                                        std::ptrdiff_t* places, double& saved, Poller& poller) {
    const std::ptrdiff_t n = curve.packed.size(), count = count_ - first;
    const Efforts efforts(options, n, columns_, dim_);
    if (efforts.pair < efforts.bound || !may_be_bounded(options, curve)) return -1;
    const Sweep sweep = sweep_with(options, curve);
    if (sweep.functions.bounds == nullptr) return -1;
    const double limit = sweep.root.most_under(
        undivided(std::min(cutoff, options.cutoff), options.divisor(n, columns_)));
    double bounds[most_lanes];
    bound_lanes(options, sweep, curve, limit, first, bounds);
    std::ptrdiff_t found = 0;
    std::int64_t points = 0;  // of the others
    for (std::ptrdiff_t lane = first; lane < count_; ++lane) {
        const bool is_above = bounds[lane] > limit;
        places[found] = lane - first;
        found += is_above ? 0 : 1;
        points += is_above ? sizes_[static_cast<std::size_t>(lane)] : 0;
    }
    poller.spend(columns_ * count);
    saved = efforts.saved(count, found);
    if (saved < 0.0) return -1;
    if (poller.count_steps(n * points, 0)) throw Stopped();
    return found;
}

bool CurvesBeside::bounds(const WarpingOptions& options, double cutoff, const P& curve, double* out,
                          Poller& poller) {
    const std::ptrdiff_t n = curve.packed.size();
    if (!may_be_bounded(options, curve)) return false;
    const Sweep sweep = sweep_with(options, curve);
    if (sweep.functions.bounds == nullptr) return false;
    const double limit = sweep.root.most_under(
        undivided(std::min(cutoff, options.cutoff), options.divisor(n, columns_)));
    double bounds[most_lanes];
    bound_lanes(options, sweep, curve, limit, 0, bounds);
    for (std::ptrdiff_t lane = 0; lane < count_; ++lane) {
        const double divisor = options.divisor(n, sizes_[static_cast<std::size_t>(lane)]);
        out[lane] = sweep.root(bounds[lane]) / divisor;
    }
    poller.spend(columns_ * count_);
    return true;
}

}  // namespace curvewise::warping
