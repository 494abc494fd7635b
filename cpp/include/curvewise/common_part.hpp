/// \file
/// The common part of two curves: the longest section of P that has a section of Q within a
/// distance. The distance of sections is the discrete Fréchet distance, and the length of a section
/// is the sum of the ground distances of its neighbouring points.
///
///     max over i <= k, j <= l with frechet(P[i..k], Q[j..l]) <= distance of length(P[i..k])
///
/// Among equally long sections, P's ends first, and Q's begins and then ends first. Sections begin
/// and end at points of the curves. This is one section, and not the sum of all that match, as the
/// partial Fréchet similarity of Buchin, Buchin & Wang (Exact algorithms for partial curve matching
/// via the Fréchet distance, SODA 2009).
///
/// Each pair of points within the distance keeps the earliest start that reaches it. Time O(n m),
/// memory O(n + m). Throws as frechet() does, and std::invalid_argument for a distance that is nan
/// or negative, and for a custom ground distance.
#pragma once

#include <cstddef>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/ground_distance.hpp"

namespace curvewise {

class Control;

/// Which distances common_part() compares.
struct CommonPartOptions {
    static constexpr const char* measure = "common_part";

    GroundDistance ground = {};

    /// The elementary steps, of some nanoseconds each, roughly.
    double work(double n, double m, double dim) const noexcept {
        return 2.0 * n * m * ground.weight(dim);
    }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(CommonPartOptions& options, Visit&& visit) {
    visit(options.ground);
}

/// Some consecutive points of a curve.
struct Section {
    std::ptrdiff_t begin = 0;  ///< the first point
    std::ptrdiff_t end = 0;    ///< one behind the last point
};

/// The longest section of P, and its section of Q. Without points if all are too far apart.
struct CommonPart {
    double length = 0.0;  ///< of the section of P
    Section p;
    Section q;
};

/// The common part within a distance, in units of the ground distance.
[[nodiscard]] CURVEWISE_EXPORT CommonPart common_part(const CurveView& P, const CurveView& Q,
                                                      double distance,
                                                      const CommonPartOptions& options = {},
                                                      Control* control = nullptr);

}  // namespace curvewise
