#include "pairwise/stored_curve.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "runtime/aligned_buffer.hpp"

namespace curvewise::pairwise {

CurveView view_of(const double* points, std::ptrdiff_t n, std::ptrdiff_t dim, bool is_flat,
                  PointLayout layout) noexcept {
    switch (layout) {
        case PointLayout::columns:
            return {points, n, dim, 1, is_flat ? 0 : n};
        case PointLayout::reversed_columns:
            return {points + (n - 1), n, dim, -1, is_flat ? 0 : n};
        default:
            return {points, n, dim, dim, is_flat ? 0 : 1};
    }
}

CurveView StoredCurve::view(std::ptrdiff_t dim, PointLayout layout) const noexcept {
    return view_of(points, size, dim, is_flat, layout);
}

void write_points(const CurveView& curve, PointLayout layout, double* to, runtime::Poller& poller) {
    const std::ptrdiff_t n = curve.size(), dim = curve.dim();
    if (layout == PointLayout::rows) {
        poller.in_runs(n, dim, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
            for (std::ptrdiff_t i = first; i < end; ++i) {
                for (std::ptrdiff_t c = 0; c < dim; ++c) to[i * dim + c] = curve(i, c);
            }
        });
        return;
    }
    const bool is_reversed = layout == PointLayout::reversed_columns;
    for (std::ptrdiff_t c = 0; c < dim; ++c, to += n) {
        poller.in_runs(n, 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
            for (std::ptrdiff_t i = first; i < end; ++i) {
                to[is_reversed ? n - 1 - i : i] = curve(i, c);
            }
        });
    }
}

bool squares_are_in_domain(const double* numbers, std::ptrdiff_t count) noexcept {
    // The bits of 2 |x|, less one: in the order of |x|, with 0 behind all others.
    const auto rank = [](double x) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        return 2 * bits - 1;
    };
    std::uint64_t least = rank(0.0);
    for (std::ptrdiff_t k = 0; k < count; ++k) least = std::min(least, rank(numbers[k]));
    return least >= rank(0x1p-400);
}

void PointBlocks::reserve(std::ptrdiff_t count) {
    auto block = std::make_shared<runtime::AlignedBuffer>(count + padding);
    next_ = block->data();
    std::fill_n(next_ + count, padding, 0.0);
    hold(std::move(block));
}

double* PointBlocks::append(std::ptrdiff_t count) noexcept {
    return std::exchange(next_, next_ + count);
}

void PointBlocks::take(PointBlocks& others) noexcept {
    for (std::shared_ptr<const void>& block : others.blocks_) blocks_.push_back(std::move(block));
    others.blocks_.clear();
}

}  // namespace curvewise::pairwise
