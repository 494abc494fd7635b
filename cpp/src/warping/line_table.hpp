// The table of DTW (symmetric1) between one curve in one dimension, P, and many, Q, one after the
// other, without the pruned cells (kernels/line.inl.hpp). The columns of each row are kept while
// the numbers of points do not change. O(n m) time, O(n + m) memory.
#pragma once

#include <cstddef>
#include <optional>

#include "curvewise/ground_distance.hpp"
#include "runtime/aligned_buffer.hpp"
#include "runtime/scratch.hpp"
#include "warping/live_columns.hpp"
#include "warping/packed_curve.hpp"

namespace curvewise::warping {

class LineTable {
   public:
    // The last value, or infinity if the last cell is pruned. `window` is the same for the same
    // numbers of points.
    double value(const PackedPair& curves, Metric metric, std::optional<std::ptrdiff_t> window,
                 const CostToGo& cost_to_go);

   private:
    void assign(std::ptrdiff_t rows, std::ptrdiff_t columns, std::optional<std::ptrdiff_t> window);

    std::ptrdiff_t rows_ = -1;
    std::ptrdiff_t columns_ = -1;
    runtime::ScratchVector<double> first_step_;
    runtime::ScratchVector<double> last_step_;
    runtime::AlignedBuffer row_;
    runtime::AlignedBuffer q_;
};

}  // namespace curvewise::warping
