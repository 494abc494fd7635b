// The part of the Fréchet table that a path can lie in: the cells that can be reached from the
// first over ground distances of at most the value of the last, and from which the last can be
// reached. Every predecessor with which a cell of the path is compared is either one of them, with
// the value that it has in the whole table, or larger than they are. So a search for the path that
// looks at these cells only decides as one that looks at all of them, ties included.
//
// Two recursions over the blocks of the table (block_recursion.hpp), one from either end. Free
// blocks say nothing of the values in them, so these are left to the sweep.
#pragma once

#include "warping/live_columns.hpp"
#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

// Columns, row by row, that hold these cells; `value` is the last value of the problem's table,
// whose ground distance has bounds. Counts nothing as done. Throws Stopped where the poller says
// so.
SweptColumns frechet_corridor(const SweepProblem& problem, double value);

}  // namespace curvewise::warping
