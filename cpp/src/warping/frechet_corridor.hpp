// The part of the Fréchet table that can contain a path. These are the cells that can be reached
// from the first, and from which the last can be reached, over ground distances of at most the
// value of the last. The path search compares the predecessors of each cell on the path. Each
// predecessor is either in this part, with its value in the whole table, or larger than the
// predecessors in it. So a search within these cells decides as a search of all cells does, ties
// included.
//
// Two recursions over the blocks of the table (block_recursion.hpp) find the part, one from either
// end. Free blocks do not give the values in them, so the sweep computes them.
#pragma once

#include "warping/live_columns.hpp"
#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

// Columns, row by row, that hold these cells; `value` is the last value of the problem's table,
// whose ground distance has bounds. Counts nothing as done. Throws Stopped where the poller says
// so.
SweptColumns frechet_corridor(const SweepProblem& problem, double value);

}  // namespace curvewise::warping
