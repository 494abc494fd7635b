// A lower bound of the discrete Fréchet distance: each point of either curve is matched to some
// point of the other, so the distance is at least that of any point to its nearest. The
// largest of these, the discrete Hausdorff distance, is often the Fréchet distance of similar
// curves itself.
//
// Only the largest is wanted: a search ends at the first point within the bound found so far
// (Taha & Hanbury 2015, "early breaking"), and a run of points is done with when one point of the
// other curve is within the bound of their box. On similar curves most runs are, and the time is a
// small part of the O((n + m) log(n + m)) of searches for every point.
#pragma once

#include "runtime/poller.hpp"
#include "warping/box_tree.hpp"
#include "warping/kernels/strip.hpp"

namespace curvewise::warping {

// `bound`, a lower bound that is known already, raised to the distance of every point to its
// nearest, to the bit, or to less where that takes longer than some `most_cells` of a sweep. Throws
// Stopped where the poller says so; counts nothing as done.
double nearest_point_bound(const BoxTree& P, const BoxTree& Q, Metric metric, double bound,
                           double most_cells, Poller& poller);

}  // namespace curvewise::warping
