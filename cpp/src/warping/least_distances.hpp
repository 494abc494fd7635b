// Lower bounds of the smallest ground distance of every point of one curve to any point of another,
// that is, of the smallest entry of each row, or column, of the table. For each leaf box of the one
// curve, a search finds the nearest leaf boxes of the other. It starts at the last search's result,
// climbs from there, and opens boxes that may be nearer, up to a maximum number. The distances of
// the box's points to all boxes that were found, large and small, are then lower bounds. Every
// bound holds exactly (see box_tree.hpp). Time: O(n) searches of O(log m) boxes for similar curves,
// and never more than O(n). Memory: O(1).
#pragma once

#include "runtime/poller.hpp"
#include "warping/box_tree.hpp"

namespace curvewise::warping {

// One bound for each point of `from`. The metric must have box bounds. Throws Stopped where the
// poller says so; counts nothing as done.
void least_distances(const BoxTree& from, const BoxTree& to, Metric metric, Poller& poller,
                     double* bounds);

}  // namespace curvewise::warping
