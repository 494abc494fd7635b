/// \file
/// The result of dtw_info and frechet_info for one computation: the computed share of the table,
/// and the reason.
///
///     const curvewise::WarpingInfo info = curvewise::frechet_info(experiment, simulation);
///     std::printf("%g from %.2f %% of the table\n", info.value, 100.0 * info.share);
#pragma once

#include <cstdint>
#include <vector>

namespace curvewise {

/// A value, and how it was found.
struct WarpingInfo {
    /// A step of the computation.
    struct Phase {
        const char* name;
        double seconds;
    };

    double value = 0.0;
    /// Whether a part of the table was skipped. Otherwise all of it was swept, for one of three
    /// reasons: the caller turned pruning off, the curves are short, or the bounds showed early
    /// that they would not help.
    bool pruned = false;
    std::int64_t cells_swept = 0;
    double share = 0.0;  ///< of the n m cells of the table; above 1 if some were swept twice
    /// Bounds that were known before the last step, in units of the value.
    double lower = 0.0;
    double upper = 0.0;
    std::vector<Phase> phases;
};

}  // namespace curvewise
