// Partial curve mapping: the area between the shorter curve and the longer one, as a function of
// the offset at which the shorter one starts. The area is minimised on a grid or over all offsets.
// One evaluation is a single walk along both curves, O(n + m).
#include "curvewise/pcm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "curves/arc_length.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "planar/offset_search.hpp"
#include "runtime/scratch.hpp"

namespace curvewise {
namespace {

using curves::ArcCurve;
using curves::CheckedCurve;

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

// A curve scaled by a box.
ArcCurve scaled(const CheckedCurve& checked, const curves::Box& box, runtime::Poller& poller) {
    curves::check_length(checked.curve, checked.name, PcmOptions::measure, poller);
    return {curves::box_scaled(checked.curve, box, poller),
            curves::box_scaled_arc_lengths(checked.curve, box, poller)};
}

// A curve too long for a double is infinitely far from everything.
planar::Offset best_offset(const Roles& roles, const PcmOptions& options, runtime::Poller& poller) {
    const double infinity = std::numeric_limits<double>::infinity();
    if (!std::isfinite(roles.longer.length())) return {0.0, infinity, infinity};
    return options.continuous
               ? planar::best_of_all(roles.shorter, roles.longer, poller)
               : planar::best_of_grid(roles.shorter, roles.longer, options.offsets, poller);
}

// Where the shorter curve's vertices lie on the unscaled longer one.
std::vector<std::array<double, 2>> mapped_points(const Roles& roles, const CurveView& longer,
                                                 double offset, runtime::Poller& poller) {
    std::vector<std::array<double, 2>> points;
    points.reserve(roles.shorter.arc_lengths().size());
    curves::ArcPosition position(roles.longer.arc_lengths());
    for (const double s : roles.shorter.arc_lengths()) {
        poller.poll_in_loop(points.size());
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

class PcmMeasure : public pairwise::LinearMeasure {
   public:
    struct PreparedP {
        PreparedP(const CheckedCurve& P, runtime::Poller& poller)
            : checked(P), box(P.curve), curve(scaled(P, box, poller)) {}
        CheckedCurve checked;
        curves::Box box;
        ArcCurve curve;  // scaled by its own box
    };
    using PreparedQ = pairwise::UnpreparedCurve;

    explicit PcmMeasure(const PcmOptions& options) : options_(options) {
        if (!options.continuous) {
            curves::check_whole_number("offsets", options.offsets, offsets_range);
        }
    }
    static curves::Requirements requirements() noexcept { return {PcmOptions::measure, 2, true}; }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        const ArcCurve q = scaled(Q.checked, P.box, call.poller);
        return best_offset(Roles(P.curve, q), options_, call.poller).area;
    }

    PcmMatch match(const PreparedP& P, const PreparedQ& Q,
                   const pairwise::Call<Memory>& call) const {
        const ArcCurve q = scaled(Q.checked, P.box, call.poller);
        const Roles roles(P.curve, q);
        const planar::Offset best = best_offset(roles, options_, call.poller);
        PcmMatch match;
        match.value = best.area;
        match.offset = best.at;
        match.tolerance = best.tolerance;
        match.maps_p = roles.maps_p;
        if (!std::isfinite(roles.longer.length())) {
            const double nan = std::numeric_limits<double>::quiet_NaN();
            match.points.assign(roles.shorter.points().size(), {nan, nan});
            return match;
        }
        match.coverage = roles.shorter.length() / roles.longer.length();
        const CheckedCurve& longer = roles.maps_p ? Q.checked : P.checked;
        match.points = mapped_points(roles, longer.curve, best.at, call.poller);
        return match;
    }

   private:
    PcmOptions options_;
};

}  // namespace

double pcm(const CurveView& P, const CurveView& Q, const PcmOptions& options, Control* control) {
    return pairwise::evaluate(PcmMeasure(options), P, Q, control);
}

PcmMatch pcm_match(const CurveView& P, const CurveView& Q, const PcmOptions& options,
                   Control* control) {
    const PcmMeasure measure(options);
    return pairwise::with_pair(
        measure, P, Q, control,
        [&](const auto& p, const auto& q, const auto& call) { return measure.match(p, q, call); });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(const PcmOptions& options) {
    return std::make_unique<BatchOf<PcmMeasure>>(PcmMeasure(options));
}

}  // namespace curvewise
