/// \file
/// A distance with the path that attains it (a warping path for DTW, a coupling for Fréchet), as
/// dtw_path and frechet_path return it.
///
///     for (const auto& [i, j] : alignment.path) draw_line(P(i, 0), P(i, 1), Q(j, 0), Q(j, 1));
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace curvewise {

/// A distance, and the path that attains it.
struct Alignment {
    double distance = 0.0;
    /// Index pairs (i, j): point i of P is matched to point j of Q. Each step is (1, 0), (0, 1) or
    /// (1, 1). Empty if a step pattern admits no path; the distance is then infinity.
    std::vector<std::array<std::int64_t, 2>> path;
};

}  // namespace curvewise
