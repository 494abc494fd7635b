#include "warping/matched_values.hpp"

#include <algorithm>

#include "warping/kernels/strip.hpp"

namespace curvewise::warping {
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

bool BandedValues::assign(std::ptrdiff_t count, std::ptrdiff_t size,
                          std::optional<std::ptrdiff_t> window) {
    if (count == count_ && size == size_) return is_limited_;
    count_ = count;
    size_ = size;
    const Band band(count, size, window);
    is_limited_ = band.is_limited();
    if (!is_limited_) return false;
    is_new_ = true;
    length_ = 1;
    begins_.resize(static_cast<std::size_t>(count));
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        const ColumnRange range = band.columns(count - 1 - k);
        length_ = std::max(length_, range.last - range.first + 1);
        begins_[static_cast<std::size_t>(k)] = size - 1 - range.last;
    }
    // What the curve's end cuts off the band is found beyond it.
    for (std::ptrdiff_t k = 0; k < count && begins_[static_cast<std::size_t>(k)] == 0; ++k) {
        const std::ptrdiff_t end = size - band.columns(count - 1 - k).first;
        begins_[static_cast<std::size_t>(k)] = end - length_;
    }
    first_ = begins_.front();
    is_every_run_ = true;
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        std::ptrdiff_t& begin = begins_[static_cast<std::size_t>(k)];
        begin -= first_;
        is_every_run_ = is_every_run_ && begin == k;
    }
    return true;
}

void BandedValues::enclose(const double* curve, kernels::ExtremesFunction extremes) {
    const std::ptrdiff_t runs = begins_.back() + 1, values = runs + length_ - 1;
    const std::ptrdiff_t room = values + kernels::padding;
    continued_.reserve(room);
    all_low_.reserve(room);
    all_high_.reserve(room);
    double* const continued = continued_.data();
    double* const from = continued - first_;
    std::fill(continued, from, curve[0]);
    std::copy_n(curve, size_, from);
    std::fill(from + size_, continued + values, curve[size_ - 1]);
    extremes({continued, runs, length_, all_low_.data(), all_high_.data()});
    is_new_ = false;
    if (is_every_run_) return;
    low_.reserve(count_ + kernels::padding);
    high_.reserve(count_ + kernels::padding);
    for (std::ptrdiff_t k = 0; k < count_; ++k) {
        const std::ptrdiff_t begin = begins_[static_cast<std::size_t>(k)];
        low_.data()[k] = all_low_.data()[begin];
        high_.data()[k] = all_high_.data()[begin];
    }
}

}  // namespace curvewise::warping
