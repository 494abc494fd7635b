// dtw or frechet of two packed curves: the cumulative table between them, and the results that are
// read off it: the value, the path, or all of it.
//
// For Fréchet with the Euclidean distance, or on the sphere, the table holds squares, and one root,
// or arc, is taken at the end. Both are monotone, so the value is bitwise identical. The path is
// decided on the squares, that is, before the rounding of a root can make two of them equal. Time
// O(n m), memory O(n + m), except for the table.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "curves/range_scale.hpp"
#include "curvewise/alignment.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "curvewise/warping_info.hpp"
#include "pairwise/measure.hpp"
#include "warping/ground_distance.hpp"
#include "warping/path.hpp"
#include "warping/sweep_problem.hpp"
#include "warping/window.hpp"

namespace curvewise::warping {

// The options of either measure, as the sweep takes them, checked.
struct WarpingOptions {
    const char* measure;
    kernels::Rule rule;
    GroundDistance ground;
    std::ptrdiff_t workers;
    bool prune = false;
    double cutoff = std::numeric_limits<double>::infinity();
    Window window = {};
    bool open_begin = false;
    bool open_end = false;
    bool normalize = false;

    // What a distance is divided by.
    double divisor(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept {
        return normalize ? static_cast<double>(n) + static_cast<double>(m) : 1.0;
    }
};

WarpingOptions checked_options(const DtwOptions& options);
WarpingOptions checked_options(const FrechetOptions& options);
class WarpingProblem {
   public:
    WarpingProblem(const WarpingOptions& options, const PackedPair& curves, const RangeScale& range,
                   const pairwise::Call<SweepMemory>& call);

    // One above `cutoff` may come back as any other that is. `looks_at_ends`: first at the
    // distances of the ends, unless these are known to be within it.
    double distance(double cutoff, bool looks_at_ends = true);
    // The same, for curves within the usual range, without the cells that `cost_to_go` prunes.
    // `cost_to_go` is in the unit of the table; most_in_table() gives its cutoff.
    double narrowed_distance(const CostToGo& cost_to_go);
    // A little above the cutoff in the unit of the table, so that the rounding of squares and roots
    // gives nothing up.
    double most_in_table(double cutoff) const noexcept { return root_.most_under(cutoff); }

    // The distance, and how it was found.
    WarpingInfo info();
    // Counts twice the cells of the table as done.
    Alignment alignment() const;
    void write_table(double* out) const;

   private:
    std::optional<double> frechet_with_info(WarpingInfo& info) const;
    std::optional<double> dtw_with_info(WarpingInfo& info) const;
    double restore(double value) const noexcept { return range_.restore(root_(value), degree_); }
    bool is_frechet() const noexcept { return sweep_.rule == kernels::Rule::frechet; }
    double last_value(const SweepProblem& problem) const;
    std::optional<double> pruned_value() const;
    std::optional<Path> pruned_path() const;
    std::optional<Path> frechet_path_in_corridor() const;
    double cost_of_ends() const;
    double cell(std::ptrdiff_t i, std::ptrdiff_t j) const;

    RangeScale range_;
    int degree_;       // of homogeneity in the coordinates
    PutOffRoot root_;  // of the values that the table holds
    bool prune_;
    SweepProblem sweep_;
};

}  // namespace curvewise::warping
