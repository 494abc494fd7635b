// A lower bound of the discrete Fréchet distance. Each point of either curve is matched to some
// point of the other, so the distance is at least the distance of any point to its nearest. The
// largest of these, the discrete Hausdorff distance, is often the Fréchet distance of similar
// curves itself.
//
// Only the largest is needed. So a search ends at the first point within the bound found so far
// (Taha & Hanbury 2015, "early breaking"). A run of points is finished once one point of the other
// curve is within the bound of their box. For similar curves most runs are. The time is then a
// small part of the O((n + m) log(n + m)) of searches for every point.
#pragma once

#include "runtime/poller.hpp"
#include "warping/box_tree.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {

// Raises `bound`, a known lower bound, to the exact distance of every point to its nearest. The
// result is less if that would take longer than about `most_cells` of a sweep. Throws Stopped if
// the poller stops the call; counts no work as done.
double nearest_point_bound(const BoxTree& P, const BoxTree& Q, Metric metric, double bound,
                           double most_cells, Poller& poller);

}  // namespace curvewise::warping
