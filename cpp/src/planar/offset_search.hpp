// Partial curve mapping's inner problem: the offset o, from 0 to T - S, at which the area
//
//   f(o) = sum of w_i d_i(o),   d_i(o) = |a_i - L(s_i + o)|,   w_i = (s_{i+1} - s_{i-1}) / 2
//
// is smallest; a_i are the vertices of the shorter curve, L the longer one by arc length.
#pragma once

#include <cstddef>
#include <cstdint>

#include "curves/arc_length.hpp"
#include "runtime/poller.hpp"

namespace curvewise::planar {

using curves::ArcCurve;
using runtime::Poller;

struct Offset {
    double at;
    double area;
    double tolerance = 0.0;  // of the best: the smallest area of all offsets is less by no more
};

// Both throw Stopped where the poller says so.
//
// The first of the best among `count` evenly spaced offsets. O(count (n + m)).
Offset best_of_grid(const ArcCurve& shorter, const ArcCurve& longer, std::ptrdiff_t count,
                    Poller& poller);

// How many evaluations the search over all offsets may take.
struct SearchEffort {
    // Those for a tolerance of 1e-12. A zigzag against half of itself has as many equal minima as
    // segments, and takes some 20 evaluations for each.
    std::int64_t patience = std::int64_t{1} << 20;
    // After them, the tolerance doubles with each further `impatience` evaluations, so that the
    // search ends for all curves.
    std::int64_t impatience = std::int64_t{1} << 14;
};

// The best of all offsets, to 1e-12 of S, or to 1e-13 of the value if that is more. This accuracy
// holds for up to `effort.patience` evaluations. The result is never above the best of pcm's
// default grid.
Offset best_of_all(const ArcCurve& shorter, const ArcCurve& longer, Poller& poller,
                   const SearchEffort& effort = {});

}  // namespace curvewise::planar
