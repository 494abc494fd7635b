// The path of DTW through a table that is swept at once, without the cells that cost too much.
//
// No cell of the best path costs more than a whole path does, whichever. Two paths are walked
// through: the straight one, and that which always goes on to the nearest of the next three cells.
// What costs more than the cheaper of them is dead, and the sweep leaves it out as it goes
// (strip_narrower.hpp; narrow_path.hpp for |dx| + |dy| in the plane). Curves that are alike leave
// an eighth to a third of the table. Bounds of what is still to come would leave less of it
// (dtw_pruned.hpp), and take longer than that saves.
//
// Time O(n m), and O(n + m) for the two paths: some 2 % of the sweep where it leaves nothing out.
#pragma once

#include <cstddef>
#include <optional>

#include "warping/path.hpp"
#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

// As find_path does, of a DTW problem. Returns nothing where that is as fast: where the table is
// small or large, or its columns are limited; and where a path may begin anywhere, or with a ground
// distance that has no bounds by boxes.
std::optional<Path> find_path_of_cheap_cells(const SweepProblem& problem, bool open_end);

}  // namespace curvewise::warping
