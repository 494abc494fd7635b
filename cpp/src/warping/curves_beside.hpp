// dtw and frechet of one curve with several others at once: short curves and narrow bands fill the
// lanes of SIMD vectors with pairs faster than with cells of one pair.
#pragma once

#include <array>
#include <cstddef>

#include "runtime/aligned_buffer.hpp"
#include "runtime/scratch.hpp"
#include "warping/packed_side.hpp"
#include "warping/warping_problem.hpp"

namespace curvewise::warping {

// The curves that take Q's place, interleaved, and the memory of the sweep. For one thread, which
// keeps it from one group of curves to the next.
class CurvesBeside {
   public:
    using P = PackedSide<PointOrder::forward>;
    using Q = PackedSide<PointOrder::reversed>;

    // How many curves of m points at most; 1 where curves of n points are compared with them
    // one by one, in no more time.
    static std::ptrdiff_t most(const WarpingOptions& options, std::ptrdiff_t n, std::ptrdiff_t m,
                               std::ptrdiff_t dim) noexcept;

    // Takes the first of these curves, of which none has fewer points than the next. Returns their
    // number, 0 where the first one is not for this.
    std::ptrdiff_t gather(const WarpingOptions& options, const Q* const* curves,
                          std::ptrdiff_t count);

    // Writes the distances of P and every curve from number `first` on. False where P is not for
    // this: nothing is written then. Throws Stopped.
    bool distances(const WarpingOptions& options, const P& curve, std::ptrdiff_t first, double* out,
                   Poller& poller);

   private:
    static constexpr std::ptrdiff_t most_lanes = 32;

    void interleave(const Q& curve, std::ptrdiff_t lane) noexcept;
    void limit_rows(const WarpingOptions& options, std::ptrdiff_t n);

    std::ptrdiff_t count_ = 0;
    std::ptrdiff_t stride_ = 0;
    std::ptrdiff_t columns_ = 0;  // of the longest
    std::ptrdiff_t dim_ = 0;
    bool squares_are_in_domain_ = true;
    std::array<std::ptrdiff_t, most_lanes> sizes_{};
    AlignedBuffer points_;
    AlignedBuffer row_;
    // The band, row by row: the first columns, then the last, of so many columns.
    runtime::ScratchVector<std::ptrdiff_t> ends_;
    std::ptrdiff_t columns_of_ends_ = 0;
};

}  // namespace curvewise::warping
