// A curve as the kernels read it: one array per coordinate, padded to whole SIMD vectors, scaled
// into the safe range; rows of a table in order, columns in reverse. One allocation; O(n). Stored
// points in this order are used where they are.
#pragma once

#include <cstddef>

#include "curves/range_scale.hpp"
#include "curvewise/curve.hpp"
#include "pairwise/stored_curve.hpp"
#include "runtime/aligned_buffer.hpp"
#include "runtime/poller.hpp"

namespace curvewise::warping {

using curves::RangeScale;
using runtime::AlignedBuffer;
using runtime::Poller;

enum class PointOrder { forward, reversed };

class PackedCurve {
   public:
    PackedCurve(const CurveView& curve, const RangeScale& range, PointOrder order, Poller& poller);
    // One on the sphere is not scaled: its points go into space (curves/sphere.hpp).
    static PackedCurve of(const CurveView& curve, bool on_sphere, const RangeScale& range,
                          PointOrder order, Poller& poller) {
        if (on_sphere) return PackedCurve(curve, order, poller);
        return PackedCurve(curve, range, order, poller);
    }

    // Of stored points that need no scaling.
    PackedCurve(const pairwise::StoredCurve& stored, std::ptrdiff_t dim) noexcept
        : n_(stored.size),
          dim_(dim),
          stride_(stored.size),
          data_(stored.points),
          squares_are_in_domain_(stored.squares_are_in_domain) {}

    std::ptrdiff_t size() const noexcept { return n_; }
    std::ptrdiff_t dim() const noexcept { return dim_; }

    // Coordinate c of point i is data()[c * stride() + i]; in reverse order, at
    // [c * stride() + size() - 1 - i].
    const double* data() const noexcept { return data_; }
    std::ptrdiff_t stride() const noexcept { return stride_; }
    // Whether every |coordinate| is 0 or at least 2^-400. Differences of two such curves are then 0
    // or at least 2^-452, the last bit of such a coordinate. Their squares are 0 or at least
    // 2^-904, the domain of the fast square root.
    bool squares_are_in_domain() const noexcept { return squares_are_in_domain_; }

   private:
    PackedCurve(const CurveView& curve, PointOrder order, Poller& poller);  // on the sphere

    std::ptrdiff_t n_;
    std::ptrdiff_t dim_;
    std::ptrdiff_t stride_;
    AlignedBuffer storage_;
    const double* data_;
    bool squares_are_in_domain_ = true;
};

// The two sides of a table; owns neither.
struct PackedPair {
    const PackedCurve& p;  // forward
    const PackedCurve& q;  // reversed

    std::ptrdiff_t rows() const noexcept { return p.size(); }
    std::ptrdiff_t columns() const noexcept { return q.size(); }
    std::ptrdiff_t dim() const noexcept { return p.dim(); }
    bool squares_are_in_domain() const noexcept {
        return p.squares_are_in_domain() && q.squares_are_in_domain();
    }
};

}  // namespace curvewise::warping
