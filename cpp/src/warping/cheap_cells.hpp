// The path of DTW through a table that is swept at once, without the cells that cost too much.
//
// No cell of the best path costs more than any whole path. Two paths are computed: the straight
// one, and the one that always continues to the nearest of the next three cells. A cell that costs
// more than the cheaper of them is pruned, and the sweep skips it (strip_narrower.hpp;
// narrow_path.hpp for |dx| + |dy| in the plane). For similar curves, an eighth to a third of the
// table remains. Bounds of the rest of a path would leave less of it (dtw_pruned.hpp), but take
// longer than they save.
//
// Time: O(n m), and O(n + m) for the two paths, about 2 % of a sweep that skips nothing.
#pragma once

#include <cstddef>
#include <optional>

#include "warping/path.hpp"
#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

// The same as find_path, for a DTW problem. Returns nullopt if find_path is as fast: if the table
// is small or large, or its columns are limited. The same holds if a path may begin anywhere, or if
// the ground distance has no bounds by boxes.
std::optional<Path> find_path_of_cheap_cells(const SweepProblem& problem, bool open_end);

}  // namespace curvewise::warping
