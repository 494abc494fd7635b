// Algorithm 1 of Jekel et al. (2018): refinement, then the areas of the quadrilaterals between
// the curves (quad.hpp). With Spacing::matched the curves are matched by a warping path instead
// (matched_curves.hpp), and areas have signs, which cancel within a piece. Closed curves take the
// beginning of Q with the least area (loop.hpp), or the symmetric difference of their polygons.
#include "curvewise/area.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "curves/polyline.hpp"
#include "curvewise/gradient.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "planar/area_gradient.hpp"
#include "planar/function_strips.hpp"
#include "planar/loop.hpp"
#include "planar/matched_curves.hpp"
#include "planar/quad.hpp"
#include "planar/refinement.hpp"
#include "planar/symmetric_difference.hpp"

namespace curvewise {
namespace {

using curves::Point;
using curves::Polyline;
using curves::RangeScale;
using planar::Measured;
using planar::Quad;

class AreaMeasure : public pairwise::LinearMeasure {
   public:
    using PreparedP = pairwise::UnpreparedCurve;
    using PreparedQ = pairwise::UnpreparedCurve;

    explicit AreaMeasure(const AreaOptions& options) : options_(options) { check_closed(); }
    static curves::Requirements requirements() noexcept { return {AreaOptions::measure, 2, true}; }
    // A curve that is not a function of x has no area, not even to itself.
    bool is_zero_to_itself(const curves::CheckedCurve& /*checked*/) const noexcept {
        return options_.spacing != Spacing::function;
    }
    static constexpr bool checks_p = true;
    void check_p(const PreparedP& P, runtime::Poller& poller) const {
        if (options_.spacing == Spacing::function) planar::check_is_function(P.checked, poller);
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        if (options_.crossing == Crossing::polygon) {
            double sum = 0.0;
            for_each_trapezoid(P, Q, range, call.poller,
                               [&](const Quad&, double area) { sum += area; });
            return range.restore(sum, 2);
        }
        const double sum = options_.closed ? best_start(P, Q, range, call.poller).sum
                                           : open_sum(P.checked, Q.checked, range, call.poller);
        if (options_.spacing == Spacing::function) {
            return range.restore(sum, options_.squared ? 3 : 2);
        }
        return range.restore(sum, options_.squared ? 4 : 2);
    }

    // The quadrilaterals and their areas.
    AreaQuads quads(const PreparedP& P, const PreparedQ& Q,
                    const pairwise::Call<Memory>& call) const {
        const RangeScale range = range_of(P, Q);
        if (!options_.closed) return quads_of(P.checked, Q.checked, range, call.poller);
        if (options_.crossing == Crossing::polygon) {
            AreaQuads result;
            for_each_trapezoid(P, Q, range, call.poller, [&](const Quad& quad, double area) {
                append(result, quad, area, range);
            });
            return result;
        }
        const planar::Loop q(Q.checked, call.poller);
        return quads_of(planar::Loop(P.checked, call.poller).from(0),
                        q.from(best_start(P, Q, range, call.poller).at), range, call.poller);
    }

    static RangeScale range_of(const PreparedP& P, const PreparedQ& Q) noexcept {
        return RangeScale(std::max(P.checked.largest, Q.checked.largest));
    }

   private:
    void check_closed() const {
        if (options_.crossing == Crossing::polygon && !options_.closed) {
            throw std::invalid_argument("crossing='polygon' is for closed curves; add closed=True");
        }
        if (options_.crossing == Crossing::polygon && options_.squared) {
            throw std::invalid_argument(
                "crossing='polygon' has no squared; leave out squared=True");
        }
        if (options_.closed && options_.spacing == Spacing::function) {
            throw std::invalid_argument(
                "closed=True has no spacing='function'; choose from distance, x, arc_length, "
                "matched");
        }
    }

    // The sum of the areas of curves as they are, or of their squares, in `range`. A sum above
    // `limit` may be that of the first areas alone.
    double open_sum(const curves::CheckedCurve& P, const curves::CheckedCurve& Q,
                    const RangeScale& range, runtime::Poller& poller,
                    double limit = std::numeric_limits<double>::infinity()) const {
        double sum = 0.0;
        if (options_.spacing == Spacing::function) {
            planar::FunctionStrips strips(P, Q, range, poller);
            strips.for_each(poller, [&](const Quad& strip) {
                sum += options_.squared ? planar::strip_squares(strip) : planar::strip_area(strip);
            });
            return sum;
        }
        const auto add = [&](double area) { sum += options_.squared ? area * area : area; };
        if (options_.spacing == Spacing::matched) {
            for (const double piece : planar::matched_areas(P.curve, Q.curve, range, poller)) {
                add(std::abs(piece));
            }
        } else if (options_.closed) {
            for_each_quad(P, Q, range, poller, [&](const Quad& quad) {
                add(planar::measured_area(quad, options_.crossing));
                return sum <= limit;
            });
        } else {
            for_each_quad(P, Q, range, poller, [&](const Quad& quad) {
                add(planar::measured_area(quad, options_.crossing));
            });
        }
        return sum;
    }

    // Where Q begins for the least sum, and that sum.
    struct Start {
        std::ptrdiff_t at;
        double sum;
    };
    Start best_start(const PreparedP& P, const PreparedQ& Q, const RangeScale& range,
                     runtime::Poller& poller) const {
        const planar::Loop p(P.checked, poller), q(Q.checked, poller);
        Start best{0, std::numeric_limits<double>::infinity()};
        for (std::ptrdiff_t j = 0; j < q.size(); ++j) {
            const double sum = open_sum(p.from(0), q.from(j), range, poller, best.sum);
            if (sum < best.sum) best = {j, sum};
        }
        return best;
    }

    // Calls visit(trapezoid, area) for those of the symmetric difference.
    template <class Visit>
    static void for_each_trapezoid(const PreparedP& P, const PreparedQ& Q, const RangeScale& range,
                                   runtime::Poller& poller, Visit visit) {
        planar::SymmetricDifference(polyline(P.checked.curve, range, poller),
                                    polyline(Q.checked.curve, range, poller), poller)
            .for_each(visit);
    }

    static void append(AreaQuads& result, const Quad& quad, double area, const RangeScale& range) {
        const auto restored = [&](const Point& point) -> std::array<double, 2> {
            return {range.restore(point.x, 1), range.restore(point.y, 1)};
        };
        result.quads.push_back(
            {restored(quad.a), restored(quad.b), restored(quad.c), restored(quad.d)});
        result.areas.push_back(range.restore(area, 2));
    }

    // The quadrilaterals between curves as they are.
    AreaQuads quads_of(const curves::CheckedCurve& P, const curves::CheckedCurve& Q,
                       const RangeScale& range, runtime::Poller& poller) const {
        AreaQuads result;
        // So that nothing is copied to make room, which takes long where there are millions.
        const auto most = static_cast<std::size_t>(P.curve.size() + Q.curve.size());
        result.quads.reserve(most);
        result.areas.reserve(most);
        if (options_.spacing == Spacing::function) {
            planar::FunctionStrips strips(P, Q, range, poller);
            strips.for_each(poller, [&](const Quad& strip) {
                append(result, strip, planar::strip_area(strip), range);
            });
        } else if (options_.spacing == Spacing::matched) {
            const auto visit = [&](const auto& curves, auto first, auto end, double area) {
                for (std::size_t i = first; i < end; ++i) {
                    const Quad quad = planar::quad_at(curves, i);
                    const double part = quad.signed_area();
                    append(result, quad, area < 0.0 ? -part : part, range);
                }
            };
            planar::for_each_piece(planar::match(P.curve, Q.curve, range, poller), poller, visit);
        } else {
            for_each_quad(P, Q, range, poller, [&](const Quad& quad) {
                const Measured measured = measure(quad, options_.crossing);
                append(result, measured.quad, measured.area, range);
            });
        }
        return result;
    }

    // Calls visit(quad) for one quadrilateral after the other, in the given range, while it
    // returns true or nothing.
    template <class Visit>
    void for_each_quad(const curves::CheckedCurve& P, const curves::CheckedCurve& Q,
                       const RangeScale& range, runtime::Poller& poller, Visit visit) const {
        const planar::FacingCurves curves =
            planar::face(P.curve, Q.curve, range, options_.spacing, poller);
        for (std::size_t i = 0; i + 1 < curves.A.size(); ++i) {
            poller.poll_in_loop(i);
            if constexpr (std::is_void_v<decltype(visit(planar::quad_at(curves, i)))>) {
                visit(planar::quad_at(curves, i));
            } else if (!visit(planar::quad_at(curves, i))) {
                return;
            }
        }
    }

    AreaOptions options_;
};

}  // namespace

double area(const CurveView& P, const CurveView& Q, const AreaOptions& options, Control* control) {
    return pairwise::evaluate(AreaMeasure(options), P, Q, control);
}

AreaQuads area_quads(const CurveView& P, const CurveView& Q, const AreaOptions& options,
                     Control* control) {
    const AreaMeasure measure(options);
    return pairwise::with_pair(
        measure, P, Q, control,
        [&](const auto& p, const auto& q, const auto& call) { return measure.quads(p, q, call); });
}

double value_and_gradients(const AreaOptions& options, const CurveView& P, const CurveView& Q,
                           const Gradients& out, Control* control) {
    if (options.closed) {
        throw std::invalid_argument("area has no gradient with closed=True; leave it out");
    }
    if (options.spacing == Spacing::arc_length || options.spacing == Spacing::function) {
        throw std::invalid_argument(
            std::string("area has no gradient with spacing='") +
            choice_names(options.spacing)[static_cast<std::size_t>(options.spacing)] +
            "'; choose from distance, x, matched");
    }
    return pairwise::with_pair(
        AreaMeasure(options), P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
            return planar::area_and_gradients(p.checked.curve, q.checked.curve, options,
                                              AreaMeasure::range_of(p, q), out, call.poller);
        });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(const AreaOptions& options) {
    return std::make_unique<BatchOf<AreaMeasure>>(AreaMeasure(options));
}

}  // namespace curvewise
