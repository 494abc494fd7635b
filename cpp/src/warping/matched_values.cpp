#include "warping/matched_values.hpp"

#include <algorithm>

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

void BandedValues::enclose(const double* curve, std::ptrdiff_t stride, std::ptrdiff_t dim,
                           kernels::ExtremesFunction extremes) {
    const std::ptrdiff_t values = runs() + length_ - 1;
    continued_.reserve(room());
    for (runtime::AlignedBuffer* buffer : {&all_low_, &all_high_}) buffer->reserve(dim * room());
    if (!is_every_run_) {
        for (runtime::AlignedBuffer* buffer : {&low_, &high_}) buffer->reserve(dim * room());
    }
    double* const continued = continued_.data();
    double* const from = continued - first_;
    for (std::ptrdiff_t c = 0; c < dim; ++c, curve += stride) {
        const std::ptrdiff_t at = c * room();
        std::fill(continued, from, curve[0]);
        std::copy_n(curve, size_, from);
        std::fill(from + size_, continued + values, curve[size_ - 1]);
        extremes({continued, runs(), length_, all_low_.data() + at, all_high_.data() + at});
        if (is_every_run_) continue;
        for (std::ptrdiff_t k = 0; k < count_; ++k) {
            const std::ptrdiff_t begin = at + begins_[static_cast<std::size_t>(k)];
            low_.data()[at + k] = all_low_.data()[begin];
            high_.data()[at + k] = all_high_.data()[begin];
        }
    }
    is_new_ = false;
}

}  // namespace curvewise::warping
