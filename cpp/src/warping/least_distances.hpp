// Lower bounds of the smallest ground distance of every point of one curve to any of another: of
// the smallest entry of each row, or column, of the table. For each leaf box of the one curve, a
// search finds the leaf boxes of the other that come nearest: it starts where the last one ended,
// climbs from there, and looks into what may be nearer, so many boxes at most. The distances of
// the box's points to all boxes that were found, large and small, then bound theirs from below.
// Every bound holds to the bit (see box_tree.hpp). Time O(n) searches of O(log m) boxes where the
// curves are alike, and never more than O(n); memory O(1).
#pragma once

#include "runtime/poller.hpp"
#include "warping/box_tree.hpp"

namespace curvewise::warping {

// One bound for each point of `from`. The metric must have box bounds. Throws Stopped where the
// poller says so; counts nothing as done.
void least_distances(const BoxTree& from, const BoxTree& to, Metric metric, Poller& poller,
                     double* bounds);

}  // namespace curvewise::warping
