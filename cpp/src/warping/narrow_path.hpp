// The path of DTW through a table of which few cells a row are live, see cheap_cells.hpp: rows are
// swept a SIMD vector at a time, each time from the first column to the last that can be live, with
// two bits a cell for where its path comes from. Then the path is read off backwards.
//
// The cells are those of the sweep, to the bit: what is dead is on no path that costs at most
// `most`, and is larger than what such a path comes from. Time O(cells looked at), memory two bits
// each, four where a vector has two lanes.
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
