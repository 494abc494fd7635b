// What the bounds of dtw and frechet need of many stored curves: the summary of each, and boxes
// around runs of its points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "curves/checks.hpp"
#include "pairwise/bound_tree.hpp"
#include "runtime/growing_list.hpp"
#include "warping/box_tree.hpp"
#include "warping/kept_boxes.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

using curves::CheckedCurve;

// Writes the 4 * dim numbers of the summary of the curve of a tree: its first point, its last, its
// lowest coordinates, its highest.
void write_summary(const BoxTree& tree, double* summary) noexcept;

// The stored data of a Q besides its points.
struct KeptCurve {
    std::ptrdiff_t points;
    const double* numbers;  // the largest |coordinate|, then the summary
    const std::uint16_t* boxes;

    double largest() const noexcept { return numbers[0]; }
    // The first point, the last, the lowest coordinates, the highest.
    const double* summary() const noexcept { return numbers + 1; }
};

// That of every Q. While one thread adds more, others may read what they know of.
class KeptBounds {
   public:
    // For these curves, packed with `dim` coordinates.
    void reserve(const std::vector<CurveView>& curves, std::ptrdiff_t dim);
    void keep(const CheckedCurve& Q, const PackedCurve& packed, PointOrder order);
    // What files name the data of this form; to be changed with the numbers, or with KeptBoxes.
    static constexpr std::uint64_t format = 1;
    // How many doubles it takes for a curve: its numbers, then its boxes in whole doubles.
    static std::ptrdiff_t stored_size(std::ptrdiff_t points, std::ptrdiff_t dim) noexcept;
    void write(std::ptrdiff_t j, double* to) const noexcept;
    // Refers to what was written, which must outlive this.
    void look_at(std::ptrdiff_t points, std::ptrdiff_t dim, const double* stored);
    // Adds those of `others`, for which room was made, and leaves it empty.
    void make_room(const KeptBounds& others);
    void take(KeptBounds& others) noexcept;

    const KeptCurve& operator[](std::ptrdiff_t j) const noexcept { return curves_[j]; }
    // Calls use(curves, their number) for consecutive parts of `count` curves from `first` on.
    template <class Use>
    void in_parts(std::ptrdiff_t first, std::ptrdiff_t count, Use&& use) const {
        curves_.in_parts(first, count, use);
    }
    // The row of curve j for trees over the first bounds (pairwise/bound_tree.hpp): its summary,
    // its largest |coordinate|, its number of points. Its shape is that of no row if the metric has
    // no bounds.
    pairwise::RowShape row_shape(const GroundDistance& ground) const noexcept;
    void write_row(std::ptrdiff_t j, double* row) const noexcept;
    // The boxes of a level above 0, in `room`.
    BoxLevel boxes(std::ptrdiff_t j, int level, std::ptrdiff_t dim, BoxRoom& room) const {
        const KeptCurve& curve = curves_[j];
        return KeptBoxes{j, curve.points, curve.boxes}.read(limit_of(level),
                                                            curve.summary() + 2 * dim, dim, room);
    }
    // The index of a level of the bounds in KeptBoxes::most_boxes: the finest boxes are the last
    // level's.
    static constexpr std::size_t limit_of(int level) noexcept {
        return static_cast<std::size_t>(3 - level);
    }

   private:
    std::ptrdiff_t dim_ = 0;  // of those that keep() has added
    runtime::GrowingList<KeptCurve> curves_;
    runtime::GrowingRuns<double> numbers_;
    runtime::GrowingRuns<std::uint16_t> boxes_;
};

}  // namespace curvewise::warping
