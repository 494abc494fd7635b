#include "warping/matched_values.hpp"

#include <algorithm>
#include <limits>

#include "warping/kernels/strip.hpp"

namespace curvewise::warping {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The least and the greatest value from that at `begin` up to each, by `step`, before `end`.
template <std::ptrdiff_t step>
void run(const double* values, std::ptrdiff_t begin, std::ptrdiff_t end, double* low,
         double* high) noexcept {
    double least = infinity, greatest = -infinity;
    for (std::ptrdiff_t j = begin; j != end; j += step) {
        const double value = values[j];
        least = value < least ? value : least;
        greatest = value > greatest ? value : greatest;
        low[j] = least;
        high[j] = greatest;
    }
}

}  // namespace

std::ptrdiff_t merge_intervals(const double* intervals, std::ptrdiff_t count, double most_gap,
                               double* merged) {
    std::ptrdiff_t left = 0;
    for (std::ptrdiff_t b = 0; b < count; ++b) {
        double low = intervals[2 * b], high = intervals[2 * b + 1];
        for (std::ptrdiff_t k = left - 1; k >= 0; --k) {
            if (merged[2 * k] - high > most_gap || low - merged[2 * k + 1] > most_gap) continue;
            low = std::min(low, merged[2 * k]);
            high = std::max(high, merged[2 * k + 1]);
            --left;
            merged[2 * k] = merged[2 * left];
            merged[2 * k + 1] = merged[2 * left + 1];
        }
        merged[2 * left] = low;
        merged[2 * left + 1] = high;
        ++left;
    }
    return left;
}

bool BandedValues::assign(std::ptrdiff_t count, PointOrder order, std::ptrdiff_t size,
                          std::optional<std::ptrdiff_t> window) {
    if (count == count_ && size == size_) return is_limited_;
    count_ = count;
    size_ = size;
    const Band band(count, size, window);
    is_limited_ = band.is_limited();
    if (!is_limited_) return false;
    is_new_ = true;
    block_ = 1;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const ColumnRange range = band.columns(i);
        block_ = std::max(block_, range.last - range.first + 1);
    }
    parts_.resize(static_cast<std::size_t>(count));
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const ColumnRange range = band.columns(i);
        if (order == PointOrder::forward) {
            parts_[static_cast<std::size_t>(i)] =
                parts_of(size - 1 - range.last, size - 1 - range.first);
        } else {
            parts_[static_cast<std::size_t>(count - 1 - i)] = parts_of(range.first, range.last);
        }
    }
    return true;
}

// By the place of the points where they are stored.
BandedValues::Parts BandedValues::parts_of(std::ptrdiff_t first,
                                           std::ptrdiff_t last) const noexcept {
    if (first / block_ == last / block_) {
        if (first % block_ == 0) return {size_, last};
        if (last == size_ - 1) return {first, size_};
    }
    return {first, last};
}

void BandedValues::enclose(const PackedCurve& curve) {
    const std::ptrdiff_t room = size_ + 1;
    running_.reserve(4 * room);
    double* const from_begin_low = running_.data();
    double* const from_begin_high = from_begin_low + room;
    double* const to_end_low = from_begin_high + room;
    double* const to_end_high = to_end_low + room;
    from_begin_low[size_] = to_end_low[size_] = infinity;
    from_begin_high[size_] = to_end_high[size_] = -infinity;
    for (std::ptrdiff_t begin = 0; begin < size_; begin += block_) {
        const std::ptrdiff_t end = std::min(begin + block_, size_);
        run<1>(curve.data(), begin, end, from_begin_low, from_begin_high);
        run<-1>(curve.data(), end - 1, begin - 1, to_end_low, to_end_high);
    }
    low_.reserve(count_ + kernels::padding);
    high_.reserve(count_ + kernels::padding);
    double* const low = low_.data();
    double* const high = high_.data();
    const Parts* const parts = parts_.data();
    for (std::ptrdiff_t k = 0; k < count_; ++k) {
        const auto [begins, ends] = parts[k];
        low[k] = std::min(to_end_low[begins], from_begin_low[ends]);
        high[k] = std::max(to_end_high[begins], from_begin_high[ends]);
    }
    is_new_ = false;
}

}  // namespace curvewise::warping
