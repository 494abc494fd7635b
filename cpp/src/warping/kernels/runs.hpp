// What bounds of normalised runs ask of an instruction-set level: how far all runs of a curve lie
// outside of boxes. As for strips, pointers and sizes only.
#pragma once

#include <cstddef>

namespace curvewise::kernels {

// The number of runs that are processed together, or a multiple of it; arrays of runs are padded to
// it.
inline constexpr std::ptrdiff_t runs_at_once = 32;

struct RunsAndBoxes {
    // Coordinate c of point i is points[c * stride + i]; run k is the points k to k + length - 1.
    const double* points;
    std::ptrdiff_t stride;
    std::ptrdiff_t count;
    std::ptrdiff_t length;
    std::ptrdiff_t dim;
    // For each point of a run a box, its lowest coordinates and then its highest.
    const double* boxes;
    // Output: the shift and the scale of coordinate c of run k, at [c * stride + k].
    double* means;
    double* scales;
    // The sum, or the largest, of the distances of each run's points to their boxes; written.
    double* totals;
};

using RunFunction = void (*)(const RunsAndBoxes& runs) noexcept;

}  // namespace curvewise::kernels
