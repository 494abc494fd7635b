// A custom ground distance: a matrix or a callable. The library requests the distances of a block
// of points. Python's curvewise.curves.own_distance computes and checks them.
#pragma once

#include <type_traits>

#include "curvewise/block_distances.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "numpy_view.hpp"

namespace curvewise::bindings {

// Whether a metric is not a name, and may be a function or a matrix.
bool is_own_metric(const py::object& metric);

// That of one call, whose curves it must not outlive. An exception of Python's stays set in this
// thread, and the call ends by Stopped (interruptible.hpp).
class OwnDistances {
   public:
    OwnDistances(const CurveArray& P, const CurveArray& Q) noexcept : P_(P), Q_(Q) {}
    OwnDistances(const OwnDistances&) = delete;
    OwnDistances(OwnDistances&&) = delete;
    OwnDistances& operator=(const OwnDistances&) = delete;
    OwnDistances& operator=(OwnDistances&&) = delete;
    ~OwnDistances() = default;

    // The library's view of a metric, as long as this lives.
    const BlockDistances* of(const py::object& metric);

    // Whether the measure of these options takes one.
    template <class Options>
    static constexpr bool are_taken_by =
        std::is_same_v<Options, DtwOptions> || std::is_same_v<Options, FrechetOptions>;

   private:
    void write(const TableBlock& block, double* out) const;

    const CurveArray& P_;
    const CurveArray& Q_;
    py::object blocks_;
    BlockDistances function_;
};

}  // namespace curvewise::bindings
