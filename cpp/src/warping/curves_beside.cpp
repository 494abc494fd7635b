#include "warping/curves_beside.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "warping/dispatch.hpp"
#include "warping/ground_distance.hpp"

namespace curvewise::warping {
namespace {

kernels::Cost cost_of(const WarpingOptions& options, std::ptrdiff_t dim, bool in_domain) noexcept {
    return {canonical_metric(options.ground, dim), in_domain, options.ground.own != nullptr};
}

// The root of the table's values, and the kernel, null for what is swept one by one.
struct Sweep {
    Sweep(const WarpingOptions& options, std::ptrdiff_t dim, bool in_domain) noexcept {
        kernels::Cost cost = cost_of(options, dim, in_domain);
        if (options.recurrence == kernels::Recurrence::frechet && !cost.is_own) {
            root = put_off_root(cost, options.ground);
        }
        if (options.open_begin || options.open_end || options.ground.metric == Metric::haversine) {
            return;
        }
        kernel = active_level().kernels->beside(options.recurrence, cost, dim);
    }

    PutOffRoot root;
    kernels::BesideFunction kernel = nullptr;
};

bool needs_no_scale(const WarpingOptions& options, const curves::CheckedCurve& curve) noexcept {
    return range_of(options.ground, curve.largest).is_identity();
}

// The cells of a row with which all lanes, full, take as long as the pairs take one by one. More
// cells are swept faster down the anti-diagonals of one pair, whose values stay in registers.
// Measured at each level, with and without a band.
constexpr std::ptrdiff_t most_cells = 100;
constexpr std::ptrdiff_t most_cells_of_roots = 64;
// So that the row and the points stay near the processor.
constexpr std::ptrdiff_t most_columns = 1024;

std::ptrdiff_t lanes_beside() noexcept {
    return active_level().kernels->lanes * kernels::most_packs_beside;
}

// Most cells of a row.
std::ptrdiff_t cells_of_row(const Window& window, std::ptrdiff_t n, std::ptrdiff_t m) noexcept {
    const std::optional<std::ptrdiff_t> radius = window.between(n, m);
    if (!radius || n < 2 || m < 2 || *radius >= std::max(n, m)) return m;
    return std::min(m, 2 * (*radius * (std::max(n, m) - 1) / (n - 1)) + 1);
}

// Whether so many pairs of n and m points take less time together than one by one.
bool saves_time(const WarpingOptions& options, std::ptrdiff_t n, std::ptrdiff_t m,
                std::ptrdiff_t dim, std::ptrdiff_t pairs) noexcept {
    const bool has_roots = options.recurrence != kernels::Recurrence::frechet &&
                           canonical_metric(options.ground, dim) == Metric::euclidean;
    const std::ptrdiff_t most = has_roots ? most_cells_of_roots : most_cells;
    return m <= most_columns && cells_of_row(options.window, n, m) * lanes_beside() <= most * pairs;
}

}  // namespace

std::ptrdiff_t CurvesBeside::most(const WarpingOptions& options, std::ptrdiff_t n, std::ptrdiff_t m,
                                  std::ptrdiff_t dim) noexcept {
    if (Sweep(options, dim, true).kernel == nullptr) return 1;
    return saves_time(options, n, m, dim, lanes_beside()) ? lanes_beside() : 1;
}

std::ptrdiff_t CurvesBeside::gather(const WarpingOptions& options, const Q* const* curves,
                                    std::ptrdiff_t count) {
    static_assert(most_lanes >= kernels::padding * kernels::most_packs_beside);
    stride_ = lanes_beside();
    columns_ = curves[0]->packed.size();
    dim_ = curves[0]->packed.dim();
    count = std::min(count, stride_);
    if (!saves_time(options, columns_, columns_, dim_, count)) return 0;
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
    for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
        interleave(*curves[std::min(lane, count_ - 1)], lane);
    }
    return count_;
}

// Its columns beyond the end are all 0.
void CurvesBeside::interleave(const Q& curve, std::ptrdiff_t lane) noexcept {
    const std::ptrdiff_t m = curve.packed.size(), step = dim_ * stride_;
    for (std::ptrdiff_t c = 0; c < dim_; ++c) {
        const double* const from = curve.packed.data() + c * curve.packed.stride() + m - 1;
        double* const to = points_.data() + c * stride_ + lane;
        for (std::ptrdiff_t j = 0; j < m; ++j) to[j * step] = from[-j];
        for (std::ptrdiff_t j = m; j < columns_; ++j) to[j * step] = 0.0;
    }
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
    const Sweep sweep(options, dim_,
                      squares_are_in_domain_ && curve.packed.squares_are_in_domain());
    if (sweep.kernel == nullptr) return false;
    limit_rows(options, n);
    const std::ptrdiff_t width = active_level().kernels->lanes;
    const std::ptrdiff_t skipped = first / width * width;
    sweep.kernel({curve.packed.data(), curve.packed.stride(), points_.data() + skipped, stride_, n,
                  ends_.data(), ends_.data() + n, (count_ - skipped + width - 1) / width,
                  row_.data() + skipped});
    std::int64_t points = 0;
    for (std::ptrdiff_t lane = first; lane < count_; ++lane) {
        const std::ptrdiff_t m = sizes_[static_cast<std::size_t>(lane)];
        const double found =
            sweep.root(row_.data()[(m - 1) * stride_ + lane]) / options.divisor(n, m);
        *out++ = found > options.cutoff ? std::numeric_limits<double>::infinity() : found;
        points += m;
    }
    const auto weight = static_cast<std::int64_t>(options.ground.weight(static_cast<double>(dim_)));
    if (poller.count_steps(n * points, weight)) throw Stopped();
    return true;
}

}  // namespace curvewise::warping
