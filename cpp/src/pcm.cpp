// Partial curve mapping: the area between the shorter curve and the longer one, as a function of
// the offset at which the shorter one starts, minimised on a grid or over all offsets. One
// evaluation is a single walk along both curves, O(n + m).
#include "curvewise/pcm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "checks.hpp"
#include "offset_search.hpp"
#include "pair_measures.hpp"
#include "planar.hpp"

namespace curvewise {
namespace {

using detail::ArcCurve;
using detail::CheckedCurve;
using detail::PcmMeasure;

constexpr double equal_lengths = 1e-12;  // relative; within it P counts as the shorter curve

// Both curves, scaled by P's box, in their roles.
struct Roles {
    Roles(const ArcCurve& p, const ArcCurve& q) noexcept
        : maps_p(p.length() <= q.length() + equal_lengths * std::max(p.length(), q.length())),
          shorter(maps_p ? p : q),
          longer(maps_p ? q : p) {}

    bool maps_p;
    const ArcCurve& shorter;
    const ArcCurve& longer;
};

ArcCurve scaled_other(const CheckedCurve& Q, const detail::Box& box) {
    ArcCurve scaled(detail::box_scaled(Q.curve, box));
    detail::check_length(scaled.length(), Q.name.c_str(), "pcm");
    return scaled;
}

void check_options(const PcmOptions& options) {
    if (!options.continuous && options.offsets < 1) {
        throw std::invalid_argument("offsets is " + std::to_string(options.offsets) +
                                    "; give a whole number >= 1, or 'continuous'");
    }
}

// A curve too long for a double is infinitely far from everything.
detail::Offset best_offset(const Roles& roles, const PcmOptions& options, detail::Watch& watch) {
    const double infinity = std::numeric_limits<double>::infinity();
    if (!std::isfinite(roles.longer.length())) return {0.0, infinity};
    return options.continuous
               ? detail::best_of_all(roles.shorter, roles.longer, watch)
               : detail::best_of_grid(roles.shorter, roles.longer, options.offsets, watch);
}

// Where the shorter curve's vertices lie on the unscaled longer one.
std::vector<std::array<double, 2>> mapped_points(const Roles& roles, const CurveView& longer,
                                                 double offset) {
    std::vector<std::array<double, 2>> points;
    points.reserve(roles.shorter.arc_lengths().size());
    detail::ArcPosition position(roles.longer);
    for (const double s : roles.shorter.arc_lengths()) {
        position.move_to(s + offset);
        const auto k = static_cast<std::ptrdiff_t>(position.segment());
        const double h = position.fraction();
        const auto between = [&](std::ptrdiff_t c) {
            // Not a + h (b - a): b - a may overflow.
            return h == 1.0 ? longer(k + 1, c) : (1.0 - h) * longer(k, c) + h * longer(k + 1, c);
        };
        points.push_back({between(0), between(1)});
    }
    return points;
}

}  // namespace

detail::PcmMeasure::Reference::Reference(const CheckedCurve& P)
    : checked(P), box(P.curve), scaled(box_scaled(P.curve, box)) {
    check_length(scaled.length(), P.name.c_str(), "pcm");
}

detail::PcmMeasure::PcmMeasure(const PcmOptions& options)
    : PlanarMeasure("pcm"), options_((check_options(options), options)) {}

double detail::PcmMeasure::operator()(const Reference& P, const Other& Q,
                                      const PairCall& call) const {
    const ArcCurve q = scaled_other(Q.checked, P.box);
    return best_offset(Roles(P.scaled, q), options_, call.watch).area;
}

double pcm(const CurveView& P, const CurveView& Q, const PcmOptions& options, Control* control) {
    check_options(options);
    detail::check_pair(P, Q, {"pcm", 2, true});
    detail::Watch watch(control);
    watch.begin(P.size() + Q.size());
    const PcmMeasure::Reference p({P, 0.0, "P"});
    const ArcCurve q = scaled_other({Q, 0.0, "Q"}, p.box);
    const double value = best_offset(Roles(p.scaled, q), options, watch).area;
    watch.finish();
    return value;
}

PcmMatch pcm_match(const CurveView& P, const CurveView& Q, const PcmOptions& options,
                   Control* control) {
    check_options(options);
    detail::check_pair(P, Q, {"pcm", 2, true});
    detail::Watch watch(control);
    watch.begin(P.size() + Q.size());
    const PcmMeasure::Reference p({P, 0.0, "P"});
    const ArcCurve q = scaled_other({Q, 0.0, "Q"}, p.box);
    const Roles roles(p.scaled, q);
    const detail::Offset best = best_offset(roles, options, watch);
    watch.finish();
    PcmMatch match;
    match.value = best.area;
    match.offset = best.at;
    match.maps_p = roles.maps_p;
    if (!std::isfinite(roles.longer.length())) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        match.points.assign(roles.shorter.points().size(), {nan, nan});
        return match;
    }
    match.coverage = roles.shorter.length() / roles.longer.length();
    match.points = mapped_points(roles, roles.maps_p ? Q : P, best.at);
    return match;
}

}  // namespace curvewise
