// The points of many curves in few blocks of memory, each curve in the layout that its measure
// reads, so that a prepared curve need not hold them. Blocks may be mapped from a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "curves/checks.hpp"

namespace curvewise::pairwise {

// Coordinate c of point i is at [i * dim + c], at [c * n + i], or at [c * n + n - 1 - i]. Files
// have these numbers.
enum class PointLayout : std::uint32_t { rows = 1, columns = 2, reversed_columns = 3 };

struct StoredCurve {
    const double* points;
    double largest;
    std::ptrdiff_t size;
    bool is_flat;
    bool squares_are_in_domain;  // see warping::PackedCurve

    CurveView view(std::ptrdiff_t dim, PointLayout layout) const noexcept;
};

// The curve at `points`, in this layout.
CurveView view_of(const double* points, std::ptrdiff_t n, std::ptrdiff_t dim, bool is_flat,
                  PointLayout layout) noexcept;
// Writes the points of a curve in a layout.
void write_points(const CurveView& curve, PointLayout layout, double* to, runtime::Poller& poller);
// Whether every |number| is 0 or at least 2^-400.
bool squares_are_in_domain(const double* numbers, std::ptrdiff_t count) noexcept;

// Memory for points. Kernels read up to `padding` finite numbers behind those of a curve: the next
// curve, or zeros behind the last one of a block. So nothing is written where others may read.
class PointBlocks {
   public:
    static constexpr std::ptrdiff_t padding = 8;

    // A block for `count` numbers in all.
    void reserve(std::ptrdiff_t count);
    // The next of them.
    double* append(std::ptrdiff_t count) noexcept;

    // Keeps memory that belongs to others.
    void hold(std::shared_ptr<const void> block) { blocks_.push_back(std::move(block)); }
    // Takes those of `others`, for which room was made.
    void make_room(const PointBlocks& others) {
        blocks_.reserve(blocks_.size() + others.blocks_.size());
    }
    void take(PointBlocks& others) noexcept;

   private:
    std::vector<std::shared_ptr<const void>> blocks_;
    double* next_ = nullptr;
};

}  // namespace curvewise::pairwise
