// The functions that lower bounds need from an instruction-set level: distances of the points of
// one curve from the boxes around the runs of another, and the intervals and sums of these
// distances. As for strips, only pointers and sizes cross the boundary.
#pragma once

#include <cstddef>

namespace curvewise::kernels {

struct PointsAndBoxes {
    // Coordinate c of point i is points[c * stride + i]; padded as for a strip.
    const double* points;
    std::ptrdiff_t stride;
    std::ptrdiff_t count;
    std::ptrdiff_t dim;
    // Box after box, its lowest coordinates and then its highest.
    const double* boxes;
    std::ptrdiff_t box_count;
    // Where not null, point i looks at boxes first_box[i]..last_box[i] only, or at a few more. Both
    // never fall, or never rise, from point to point.
    const std::ptrdiff_t* first_box;
    const std::ptrdiff_t* last_box;
    // If not null: each point has its own box, and there are no others. Coordinate c of the lowest
    // corner of point i's is low[c * corner_stride + i]; padded.
    const double* low;
    const double* high;
    std::ptrdiff_t corner_stride;
    // The distance of every point to the nearest of its boxes; padded.
    double* least;
    // In one dimension, if each point has its own box, and not null: the nearest number in it;
    // padded.
    double* nearest;
};

using LeastFunction = void (*)(const PointsAndBoxes& sides) noexcept;

// The least and the greatest of every `length` values that follow each other.
struct SlidingWindow {
    const double* values;  // `count` + `length` - 1 of them, padded
    std::ptrdiff_t count;
    std::ptrdiff_t length;
    // The same number of entries as there are values; the first `count` are the answer. Padded.
    double* low;
    double* high;
};

using ExtremesFunction = void (*)(const SlidingWindow& window) noexcept;

// Added up in some order.
using SumFunction = double (*)(const double* terms, std::ptrdiff_t count) noexcept;

}  // namespace curvewise::kernels
