// dtw and frechet of several pairs at once: short curves and narrow bands fill the lanes of SIMD
// vectors with pairs faster than with cells of one pair. If there is a cutoff, bounds come first:
// each point of the one curve costs at least its distance to the box of the other curve's points in
// its band (Keogh & Ratanamahatana 2005; several coordinates: Rath & Manmatha 2003).
#pragma once

#include <array>
#include <cstddef>

#include "pairwise/beside_effort.hpp"
#include "runtime/aligned_buffer.hpp"
#include "runtime/scratch.hpp"
#include "warping/kernels/beside.hpp"
#include "warping/matched_values.hpp"
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

    // By measurement.
    static pairwise::BesideEffort effort(const WarpingOptions& options, std::ptrdiff_t n,
                                         std::ptrdiff_t m, std::ptrdiff_t dim) noexcept;

    // Takes the first of these curves, which are ordered by their points, the most first. Returns
    // their number, 0 where the first one is not for this. Takes more if there is a cutoff, for
    // candidates().
    std::ptrdiff_t gather(const WarpingOptions& options, const Q* const* curves,
                          std::ptrdiff_t count, bool has_cutoff);

    // Writes the distances of P and every curve from number `first` on. False where P is not for
    // this: nothing is written then. Throws Stopped.
    bool distances(const WarpingOptions& options, const P& curve, std::ptrdiff_t first, double* out,
                   Poller& poller);
    // Writes the distances of pairs, whose Ps have the same number of points, and so do the Qs.
    // Takes their Qs as gather() does. False where they are not for this.
    bool pair_distances(const WarpingOptions& options, const P* const* Ps, const Q* const* Qs,
                        std::ptrdiff_t count, double* out, Poller& poller);
    // Writes the places of the curves from number `first` on, counted from there, whose distances
    // from P may be at most `cutoff`, returns their number, and counts the others' steps. There is
    // room for all. Writes the saved time, divided by that of the bounds. Returns -1 if it is
    // faster to compute all distances.
    std::ptrdiff_t candidates(const WarpingOptions& options, double cutoff, const P& curve,
                              std::ptrdiff_t first, std::ptrdiff_t* places, double& saved,
                              Poller& poller);
    // Writes a lower bound of the distance of P and each curve. One above `cutoff` may be any other
    // that is. Returns false if P, or one of the curves, lacks a bound.
    bool bounds(const WarpingOptions& options, double cutoff, const P& curve, double* out,
                Poller& poller);

   private:
    static constexpr std::ptrdiff_t most_lanes = 32;
    struct Sweep;

    Sweep sweep_with(const WarpingOptions& options, const P& curve) const noexcept;
    bool may_be_bounded(const WarpingOptions& options, const P& curve) const noexcept;
    // Writes the bound of lane l, in the unit of the table, to bounds[l], from lane `first` on. One
    // above `most` may be any other that is.
    void bound_lanes(const WarpingOptions& options, const Sweep& sweep, const P& curve, double most,
                     std::ptrdiff_t first, double* bounds);
    void limit_rows(const WarpingOptions& options, std::ptrdiff_t n);
    // Writes the values of the last row that count.
    void finish(const WarpingOptions& options, const PutOffRoot& root, std::ptrdiff_t n,
                std::ptrdiff_t first, double* out, Poller& poller) const;
    void enclose(const WarpingOptions& options, const PackedCurve& curve,
                 kernels::BoundsBeside& beside);

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
    AlignedBuffer points_of_each_;  // of P, interleaved
    // The boxes of P's points in the bands of the columns.
    std::array<BandedValues, kernels::most_dim_beside> boxes_;
    AlignedBuffer reversed_;
    AlignedBuffer sides_;  // of one box for all columns
};

}  // namespace curvewise::warping
