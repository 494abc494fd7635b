// A lower bound of the discrete Fréchet distance: each point of either curve is matched to some
// point of the other, so the distance is at least that of any point to its nearest, and that of
// the two first points and of the two last. The largest of these, the discrete Hausdorff distance
// joined with the ends, is often the Fréchet distance of similar curves itself.
//
// Only the largest is wanted: a search ends at the first point within the bound found so far
// (Taha & Hanbury 2015, "early breaking"), and a run of points is done with when one point of the
// other curve is within the bound of their box. On similar curves most runs are, and the time is a
// small part of the O((n + m) log(n + m)) of searches for every point.
#pragma once

#include "kernels/strip.hpp"
#include "warping/box_tree.hpp"
#include "watch.hpp"

namespace curvewise::detail {

// The bound, in the ground distance `cost`: the distance of a pair of points, to the bit. Throws
// Stopped where the watch says so; counts nothing as done.
double hausdorff_bound(const BoxTree& P, const BoxTree& Q, kernels::Cost cost, Watch& watch);

}  // namespace curvewise::detail
