/// \file
/// Partial curve mapping (Witowski & Stander 2012, as in section 2.1 of Jekel et al. 2018). Both
/// curves are scaled by P's bounding box. The shorter one, of length S, is laid onto the longer
/// one, of length T, at an offset along it, vertex by vertex at equal arc length. The measure is
/// the smallest area between the two over the offsets 0 to T - S. Not symmetric (P's box scales). A
/// curve that is a section of the other scores 0 by design: see PcmMatch::coverage. Memory O(n +
/// m). Throws std::invalid_argument for a curve that is not finite, has fewer than 2 points, not 2
/// coordinates, or no length. Throws std::bad_alloc and Stopped. Safe from any number of threads.
///
///     const curvewise::PcmMatch match = curvewise::pcm_match(experiment, simulation);
///     if (match.coverage < 0.5) std::puts("less than half of the longer curve is compared");
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// At which offsets pcm() lays one curve onto the other.
struct PcmOptions {
    static constexpr const char* measure = "pcm";
    static constexpr bool is_planar = true;  ///< for curves of two coordinates only

    /// The number of evenly spaced offsets, at least 1 (1: no offset). Time O(offsets (n + m)).
    std::ptrdiff_t offsets = 200;
    /// Search all offsets instead, by branch and bound: to 1e-12 of S, or to 1e-13 of the value if
    /// that is more. `offsets` is not used. 10^3 evaluations of O(n + m) are usual. After 2^20
    /// evaluations, the tolerance doubles with every 2^14 more. So a curve of up to 10^6 boxes in
    /// length takes at most 2.1 million. PcmMatch::tolerance is the final tolerance.
    bool continuous = false;

    static constexpr bool is_symmetric() noexcept { return false; }
    /// The approximate number of elementary steps, of some nanoseconds each, for curves of n and m
    /// points. It is unknown for the search over all offsets.
    constexpr double work(double n, double m, double /*dim*/) const noexcept {
        return continuous ? std::numeric_limits<double>::infinity()
                          : static_cast<double>(offsets) * (n + m);
    }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(PcmOptions& options, Visit&& visit) {
    visit("offsets", options.offsets, options.continuous, offsets_range);
}

/// The place of the shorter curve on the longer one. (A curve longer than the largest double: value
/// is infinite, offset and coverage 0, points nan.)
struct PcmMatch {
    double value = 0.0;
    double offset = 0.0;    // arc length on the longer curve, after scaling
    double coverage = 0.0;  ///< S / T
    // whether P is the shorter curve, whose vertices are mapped; otherwise Q is
    bool maps_p = true;
    std::vector<std::array<double, 2>> points;  ///< their places on the other, in original units
    /// The largest possible difference between `value` and the smallest area of all offsets. For a
    /// grid it is S times half a step, or times all of the range if there is only one offset. For a
    /// search over all offsets it is the final tolerance.
    double tolerance = 0.0;
    /// (A curve longer than the largest double: value and tolerance are infinite, offset and
    /// coverage 0, points nan.)
};

/// The smallest area, in units of the scaled axes.
[[nodiscard]] CURVEWISE_EXPORT double pcm(const CurveView& P, const CurveView& Q,
                                          const PcmOptions& options = {},
                                          Control* control = nullptr);
/// The same, with the offset that attains it.
[[nodiscard]] CURVEWISE_EXPORT PcmMatch pcm_match(const CurveView& P, const CurveView& Q,
                                                  const PcmOptions& options = {},
                                                  Control* control = nullptr);

/// For code that treats all measures in the same way (measure.hpp).
[[nodiscard]] inline double evaluate(const PcmOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return pcm(P, Q, options, control);
}

}  // namespace curvewise
