// Two curves as the kernels read them: one array per coordinate, padded to whole SIMD vectors, Q
// in reverse, both scaled into the safe range. One allocation; O(n + m).
#pragma once

#include <cstddef>

#include "aligned_buffer.hpp"
#include "checks.hpp"
#include "curvewise/curve.hpp"

namespace curvewise::detail {

class PackedPair {
   public:
    PackedPair(const CurveView& P, const CurveView& Q, const RangeScale& range);

    std::ptrdiff_t rows() const noexcept { return n_; }
    std::ptrdiff_t columns() const noexcept { return m_; }
    std::ptrdiff_t dim() const noexcept { return dim_; }

    // Coordinate c of P's point i is p()[c * p_stride() + i]; of Q's point j it is
    // q()[c * q_stride() + columns() - 1 - j].
    const double* p() const noexcept { return storage_.data(); }
    const double* q() const noexcept { return storage_.data() + dim_ * p_stride_; }
    // Whether no |coordinate| but 0 is below 2^-400. Differences are then 0 or at least 2^-452, the
    // last bit of such a coordinate, and their squares 0 or at least 2^-904: what the fast square
    // root takes.
    bool squares_are_in_domain() const noexcept { return squares_are_in_domain_; }

    std::ptrdiff_t p_stride() const noexcept { return p_stride_; }
    std::ptrdiff_t q_stride() const noexcept { return q_stride_; }

   private:
    std::ptrdiff_t n_;
    std::ptrdiff_t m_;
    std::ptrdiff_t dim_;
    std::ptrdiff_t p_stride_;
    std::ptrdiff_t q_stride_;
    AlignedBuffer storage_;
    bool squares_are_in_domain_ = true;
};

}  // namespace curvewise::detail
