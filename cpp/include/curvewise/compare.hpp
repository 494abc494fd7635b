/// \file
/// All measures of a pair of curves at once, under compatible conditions.
///
///     const curvewise::Comparison found = curvewise::compare(experiment, simulation);
///     std::printf("area %g, Fréchet %g\n", *found.area, found.frechet);
///
/// Time O(n m) for frechet and dtw and O(200 (n + m)) for pcm; memory O(n + m).
#pragma once

#include <optional>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/measure.hpp"

namespace curvewise {

class Control;

/// The conditions under which each measure is computed.
enum class Preset {
    scaled,  ///< all on curves scaled by P's box (normalize), area with Spacing::matched,
             ///< curve_length with mean_abs
    /// as in Table 4 of Jekel et al. (2018): area raw with Spacing::x; frechet, and dtw with
    /// symmetric2, on scaled curves; pcm and curve_length raw
    paper,
    raw  ///< every default, on unscaled curves
};

/// The names of the enumerators, in their order.
constexpr auto choice_names(Preset /*preset*/) noexcept {
    return names_up_to<Preset::raw>("scaled", "paper", "raw");
}

/// How a preset computes one measure.
struct Condition {
    Measure measure;  ///< with its options
    bool scaled;      ///< on curves scaled by P's box
};

/// One for each measure, in the order of the list (measure.hpp).
[[nodiscard]] CURVEWISE_EXPORT std::vector<Condition> conditions(Preset preset);

/// One value for each measure. Measures of the plane are empty if the curves do not have two
/// coordinates.
struct Comparison {
    /// A measure by name.
    struct Value {
        const char* measure;
        double value;
    };
    /// The values of all measures except the continuous Fréchet distance, in the order of the list
    /// (measure.hpp), and by name.
    std::vector<Value> values;
    std::optional<double> area;
    std::optional<double> pcm;
    double frechet = 0.0;
    double dtw = 0.0;
    std::optional<double> curve_length;
};

/// Throws the errors of the measures: std::invalid_argument, std::bad_alloc, Stopped. The control
/// watches one measure after the other, not their sum.
[[nodiscard]] CURVEWISE_EXPORT Comparison compare(const CurveView& P, const CurveView& Q,
                                                  Preset preset = Preset::scaled,
                                                  Control* control = nullptr);

}  // namespace curvewise
