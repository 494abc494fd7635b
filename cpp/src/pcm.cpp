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
#include "planar.hpp"

namespace curvewise {
namespace {

using detail::ArcCurve;
using detail::Box;
using detail::Point;
using detail::Polyline;
using detail::RangeScale;

constexpr double equal_lengths = 1e-12;  // relative; within it P counts as the shorter curve

// Both curves, scaled by P's box, in their roles.
struct Roles {
    ArcCurve shorter;
    ArcCurve longer;
    bool maps_p;
};

Roles assign_roles(const Polyline& P, const Polyline& Q) {
    const Box box(P);
    ArcCurve p(box.scaled(P));
    ArcCurve q(box.scaled(Q));
    detail::check_length(p.length(), "P", "pcm");
    detail::check_length(q.length(), "Q", "pcm");
    if (p.length() <= q.length() + equal_lengths * std::max(p.length(), q.length())) {
        return {std::move(p), std::move(q), true};
    }
    return {std::move(q), std::move(p), false};
}

void check_options(const PcmOptions& options) {
    if (!options.continuous && options.offsets < 1) {
        throw std::invalid_argument("offsets is " + std::to_string(options.offsets) +
                                    "; give a whole number >= 1, or 'continuous'");
    }
}

// A curve too long for a double is infinitely far from everything.
detail::Offset best_offset(const Roles& roles, const PcmOptions& options) {
    const double infinity = std::numeric_limits<double>::infinity();
    if (!std::isfinite(roles.longer.length())) return {0.0, infinity};
    return options.continuous ? detail::best_of_all(roles.shorter, roles.longer)
                              : detail::best_of_grid(roles.shorter, roles.longer, options.offsets);
}

}  // namespace

double pcm(const CurveView& P, const CurveView& Q, const PcmOptions& options) {
    check_options(options);
    const RangeScale range = detail::check_pair(P, Q, {"pcm", 2, true});
    return best_offset(assign_roles(polyline(P, range), polyline(Q, range)), options).area;
}

PcmMatch pcm_match(const CurveView& P, const CurveView& Q, const PcmOptions& options) {
    check_options(options);
    const RangeScale range = detail::check_pair(P, Q, {"pcm", 2, true});
    const Polyline p = polyline(P, range);
    const Polyline q = polyline(Q, range);
    const Roles roles = assign_roles(p, q);
    const detail::Offset best = best_offset(roles, options);
    PcmMatch match;
    match.value = best.area;
    match.offset = best.at;
    match.coverage = roles.shorter.length() / roles.longer.length();
    match.maps_p = roles.maps_p;
    const Polyline& unscaled = roles.maps_p ? q : p;
    detail::ArcPosition position(roles.longer);
    for (const double s : roles.shorter.arc_lengths()) {
        position.move_to(s + best.at);
        const Point point = interpolate(unscaled[position.segment()],
                                        unscaled[position.segment() + 1], position.fraction());
        match.points.push_back({range.restore(point.x, 1), range.restore(point.y, 1)});
    }
    return match;
}

}  // namespace curvewise
