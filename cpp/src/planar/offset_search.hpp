// Partial curve mapping's inner problem: the offset o, from 0 to T - S, at which the area
//
//   f(o) = sum of w_i d_i(o),   d_i(o) = |a_i - L(s_i + o)|,   w_i = (s_{i+1} - s_{i-1}) / 2
//
// is smallest; a_i are the vertices of the shorter curve, L the longer one by arc length.
#pragma once

#include <cstddef>

#include "curves/arc_length.hpp"
#include "runtime/poller.hpp"

namespace curvewise::detail {

struct Offset {
    double at;
    double area;
};

// Both throw Stopped where the poller says so.
//
// The first of the best among `count` evenly spaced offsets. O(count (n + m)).
Offset best_of_grid(const ArcCurve& shorter, const ArcCurve& longer, std::ptrdiff_t count,
                    Poller& poller);

// The best of all offsets, to 1e-12 S; never above the grid of 200.
Offset best_of_all(const ArcCurve& shorter, const ArcCurve& longer, Poller& poller);

}  // namespace curvewise::detail
