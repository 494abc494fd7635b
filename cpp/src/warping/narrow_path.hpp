// The path of DTW through a table with few active cells in a row, see cheap_cells.hpp. Rows are
// swept a SIMD vector at a time, each time from the first column to the last that can be active.
// Two bits a cell store where its path comes from. Then the path is read off backwards.
//
// The cells are bitwise identical to those of the sweep. A pruned cell is on no path that costs at
// most `most`, and is larger than the predecessors of such a path. Time O(computed cells), memory
// two bits each, four if a vector has two lanes.
#pragma once

#include <cstddef>

#include "warping/path.hpp"
#include "warping/sweep_problem.hpp"

namespace curvewise::warping {

// Whether find_narrow_path takes this: steps of equal weight, |dx| + |dy| in the plane.
bool has_narrow_path(const SweepProblem& problem) noexcept;

// From the first cell to the last; no cell of the path may cost more than `most`. In one thread.
// Throws Stopped.
Path find_narrow_path(const SweepProblem& problem, double most);

}  // namespace curvewise::warping
