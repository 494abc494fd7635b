#include "warping/soft_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "curvewise/control.hpp"
#include "runtime/scratch.hpp"
#include "warping/dispatch.hpp"

namespace curvewise::warping {
namespace {

using kernels::exponent_of_zero;
using kernels::ScaledLanes;
using kernels::Shares;

// For a value alone: as for dtw, the data of a strip stays in the first-level cache.
constexpr std::ptrdiff_t value_height = 256;
// The least number of rows with gradients, since each strip has ramps.
constexpr std::ptrdiff_t least_height = 64;

std::ptrdiff_t gradient_height(std::ptrdiff_t rows) noexcept {
    const auto root = static_cast<std::ptrdiff_t>(std::sqrt(static_cast<double>(rows)));
    return std::max(least_height, (root + 7) / 8 * 8);
}

void set_to_zero(const ScaledLanes& lanes, std::ptrdiff_t index) noexcept {
    lanes.mantissas[index] = 1.0;
    lanes.exponents[index] = exponent_of_zero;
}

}  // namespace

ScaledRow::ScaledRow(std::ptrdiff_t columns)
    : mantissas(static_cast<std::size_t>(columns + 1), 1.0),
      exponents(static_cast<std::size_t>(columns + 1), exponent_of_zero) {}

void ScaledRow::clear() noexcept {
    std::fill(mantissas.begin(), mantissas.end(), 1.0);
    std::fill(exponents.begin(), exponents.end(), exponent_of_zero);
}

// Lane k of diagonal t is at index k + 1 of at(t). There is memory for two more diagonals, for
// contributions from below.
class SoftSweep::ShareTable {
   public:
    ShareTable(const SoftSweep& sweep, std::ptrdiff_t height) : stride_(height + 2) {
        const std::ptrdiff_t rows = sweep.curves_.rows();
        std::ptrdiff_t diagonals = 0;
        for (std::ptrdiff_t row = 0; row < rows; row += height) {
            const Strip strip = sweep.strip(row, height);
            diagonals = std::max(diagonals, strip.end_diagonal - strip.first_diagonal);
        }
        room_ = AlignedBuffer::rounded((diagonals + 2) * stride_);
        storage_.reserve(3 * room_);
        lanes_.resize(static_cast<std::size_t>(diagonals));
    }

    void enter(const Strip& strip) noexcept { first_diagonal_ = strip.first_diagonal; }
    Shares at(std::ptrdiff_t t) noexcept {
        double* const up = storage_.data() + (t - first_diagonal_) * stride_;
        return {up, up + room_, up + 2 * room_};
    }
    void set_to_zero(std::ptrdiff_t t, std::ptrdiff_t index) noexcept {
        const Shares shares = at(t);
        shares.up[index] = shares.left[index] = shares.diagonal[index] = 0.0;
    }
    void clear(std::ptrdiff_t t) noexcept {
        for (std::ptrdiff_t index = 0; index < stride_; ++index) set_to_zero(t, index);
    }
    ColumnRange& lanes(std::ptrdiff_t t) noexcept {
        return lanes_[static_cast<std::size_t>(t - first_diagonal_)];
    }

   private:
    std::ptrdiff_t stride_;
    std::ptrdiff_t room_ = 0;
    std::ptrdiff_t first_diagonal_ = 0;
    AlignedBuffer storage_;
    runtime::ScratchVector<ColumnRange> lanes_;
};

SoftSweep::SoftSweep(const PackedPair& curves, const Band& band, double scale, Poller& poller)
    : kernels_(*active_level().kernels),
      curves_(curves),
      band_(band),
      scale_(scale),
      poller_(poller) {
    const std::ptrdiff_t height =
        std::min(curves.rows(), std::max(value_height, gradient_height(curves.rows())));
    lane_room_ = AlignedBuffer::rounded(height + 2 + kernels::padding);
    lanes_.reserve(7 * lane_room_);
}

SoftSweep::Strip SoftSweep::strip(std::ptrdiff_t first_row, std::ptrdiff_t height) const noexcept {
    const std::ptrdiff_t rows = std::min(height, curves_.rows() - first_row);
    return {first_row, rows, band_.columns(first_row).first,
            band_.columns(first_row + rows - 1).last + rows};
}

ScaledRow SoftSweep::start() const {
    ScaledRow row(curves_.columns());
    row.exponents[0] = 0.0;  // left of the first column there is 1
    return row;
}

ScaledLanes SoftSweep::lanes_of(std::ptrdiff_t which) noexcept {
    double* const mantissas = lanes_.data() + 2 * which * lane_room_;
    return {mantissas, mantissas + lane_room_};
}

void SoftSweep::advance(const Strip& strip, std::ptrdiff_t t, ColumnRange& lanes) const noexcept {
    while (lanes.first + band_.columns(strip.first_row + lanes.first).last < t) ++lanes.first;
    while (lanes.last + 1 < strip.rows &&
           lanes.last + 1 + band_.columns(strip.first_row + lanes.last + 1).first <= t) {
        ++lanes.last;
    }
}

void SoftSweep::forward(const Strip& strip, const ScaledRow& above, ScaledRow& below,
                        ShareTable* shares) {
    const PackedCurve &p = curves_.p, &q = curves_.q;
    kernels::Strip points{};
    points.p = p.data() + strip.first_row;
    points.q = q.data();
    points.p_stride = p.stride();
    points.q_stride = q.stride();
    points.dim = curves_.dim();
    points.columns = curves_.columns();
    points.cost = lanes_.data() + 6 * lane_room_;
    const kernels::CostFunction fill = kernels_.fill({Metric::sqeuclidean, true});
    const kernels::SoftForward step =
        shares != nullptr ? kernels_.soft_forward_with_shares : kernels_.soft_forward;
    std::array<ScaledLanes, 3> diagonals{lanes_of(0), lanes_of(1), lanes_of(2)};
    for (std::ptrdiff_t index = 0; index < strip.rows + 2; ++index) {
        for (const ScaledLanes& lanes : diagonals) set_to_zero(lanes, index);
    }
    const auto bring = [&](const ScaledLanes& lanes, std::ptrdiff_t column) {
        const auto index = static_cast<std::size_t>(column + 1);
        lanes.mantissas[0] = above.mantissas[index];
        lanes.exponents[0] = above.exponents[index];
    };
    bring(diagonals[0], strip.first_diagonal - 1);
    bring(diagonals[1], strip.first_diagonal);
    below.clear();
    ColumnRange lanes{0, -1};
    for (std::ptrdiff_t t = strip.first_diagonal; t < strip.end_diagonal; ++t) {
        const auto& [before_last, before, current] = diagonals;
        advance(strip, t, lanes);
        const auto [low, high] = lanes;
        fill(points, t, low, high);
        step({points.cost, scale_, before, before_last, current,
              shares != nullptr ? shares->at(t) : Shares{}},
             low, high);
        // What the next two diagonals read beyond the lanes that are in the band.
        set_to_zero(current, low);
        set_to_zero(current, high + 2);
        if (t + 1 < curves_.columns()) {
            bring(current, t + 1);
        } else {
            set_to_zero(current, 0);
        }
        if (shares != nullptr) {
            shares->lanes(t) = lanes;
            shares->set_to_zero(t, low);
            shares->set_to_zero(t, high + 2);
        }
        if (high == strip.rows - 1 && low <= high) {
            const auto index = static_cast<std::size_t>(t - high + 1);
            below.mantissas[index] = current.mantissas[strip.rows];
            below.exponents[index] = current.exponents[strip.rows];
        }
        std::rotate(diagonals.begin(), diagonals.begin() + 1, diagonals.end());
        if (poller_.count_steps(high - low + 1, 4)) throw Stopped();
    }
}

void SoftSweep::backward(const Strip& strip, ShareTable& shares, FromBelow& from_below,
                         double* by_p, double* by_q) {
    const PackedCurve &p = curves_.p, &q = curves_.q;
    const std::ptrdiff_t columns = curves_.columns();
    for (std::ptrdiff_t t = strip.end_diagonal; t < strip.end_diagonal + 2; ++t) shares.clear(t);
    for (std::ptrdiff_t t = strip.first_diagonal; t < strip.end_diagonal + 2; ++t) {
        const std::ptrdiff_t column = t - strip.rows;
        if (column < 0 || column > columns) continue;
        shares.at(t).up[strip.rows + 1] = from_below.up[static_cast<std::size_t>(column)];
        shares.at(t).diagonal[strip.rows + 1] =
            from_below.diagonal[static_cast<std::size_t>(column)];
    }
    std::fill(from_below.up.begin(), from_below.up.end(), 0.0);
    std::fill(from_below.diagonal.begin(), from_below.diagonal.end(), 0.0);
    for (std::ptrdiff_t t = strip.end_diagonal - 1; t >= strip.first_diagonal; --t) {
        const auto [low, high] = shares.lanes(t);
        const std::ptrdiff_t q_place = columns - 1 - t;
        const Shares current = shares.at(t);
        kernels_.soft_backward(
            {current, shares.at(t + 1), shares.at(t + 2), lanes_.data(), p.data() + strip.first_row,
             q.data() + q_place, by_p + strip.first_row, by_q + q_place, p.stride(), q.stride(),
             curves_.dim()},
            low, high);
        if (low == 0 && low <= high) {
            from_below.up[static_cast<std::size_t>(t)] = current.up[1];
            from_below.diagonal[static_cast<std::size_t>(t)] = current.diagonal[1];
        }
        if (poller_.count_steps(high - low + 1, 2)) throw Stopped();
    }
}

double SoftSweep::log_of_last(const ScaledRow& row) const noexcept {
    const auto last = static_cast<std::size_t>(curves_.columns());
    constexpr double log_of_2 = 0.69314718055994530942;
    // From the nearest power of two: of a number just below 1 nothing cancels.
    const bool is_above = row.mantissas[last] > 1.4;
    const double mantissa = is_above ? 0.5 * row.mantissas[last] : row.mantissas[last];
    const double exponent = is_above ? row.exponents[last] + 1.0 : row.exponents[last];
    return exponent * log_of_2 + std::log(mantissa);
}

double SoftSweep::log_of_total() {
    ScaledRow above = start(), below(curves_.columns());
    for (std::ptrdiff_t row = 0; row < curves_.rows(); row += value_height) {
        forward(strip(row, value_height), above, below, nullptr);
        std::swap(above, below);
    }
    return log_of_last(above);
}

double SoftSweep::log_of_total(double* by_p, double* by_q) {
    const std::ptrdiff_t height = gradient_height(curves_.rows());
    ShareTable shares(*this, height);
    runtime::ScratchVector<ScaledRow> above{start()};
    ScaledRow below(curves_.columns());
    const bool counting = poller_.set_counting(false);
    for (std::ptrdiff_t row = 0; row + height < curves_.rows(); row += height) {
        forward(strip(row, height), above.back(), below, nullptr);
        above.push_back(below);
    }
    FromBelow from_below{
        runtime::ScratchVector<double>(static_cast<std::size_t>(curves_.columns() + 1)), {}};
    from_below.diagonal = from_below.up;
    from_below.diagonal.back() = 1.0;  // the weight of the last cell
    double result = 0.0;
    for (auto s = static_cast<std::ptrdiff_t>(above.size()) - 1; s >= 0; --s) {
        const Strip swept = strip(s * height, height);
        shares.enter(swept);
        forward(swept, above.back(), below, &shares);
        if (swept.first_row + swept.rows == curves_.rows()) result = log_of_last(below);
        above.pop_back();
        poller_.set_counting(counting);
        backward(swept, shares, from_below, by_p, by_q);
        poller_.set_counting(false);
    }
    poller_.set_counting(counting);
    return result;
}

}  // namespace curvewise::warping
