// The continuous Fréchet distance as a measure: curves boxed once, the search called for their
// number of coordinates.
#include "curvewise/frechet_continuous.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "continuous/boxed_side.hpp"
#include "continuous/coupling.hpp"
#include "continuous/leash_bounds.hpp"
#include "continuous/leash_search.hpp"
#include "continuous/plain_range.hpp"
#include "continuous/vertex_walk.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "runtime/growing_list.hpp"
#include "runtime/workers.hpp"

namespace curvewise {
namespace {

using continuous::BoxedCurve;
using continuous::CurveSummary;
using continuous::FreeSet;
using continuous::LeashSearch;
using continuous::PathEnds;
using continuous::plain_scale;
using continuous::Radius;
using continuous::VertexWalk;
using continuous::Vertices;
using continuous::with_dimension;
using curves::CheckedCurve;
using curves::RangeScale;
using runtime::Poller;

constexpr double infinity = std::numeric_limits<double>::infinity();

class FrechetContinuousMeasure : public pairwise::Distance {
   public:
    using Memory = continuous::LeashMemory;
    static constexpr bool is_swept = false;
    using PreparedP = continuous::BoxedSide;
    using PreparedQ = PreparedP;
    using Call = pairwise::Call<Memory>;

    explicit FrechetContinuousMeasure(const FrechetContinuousOptions& options)
        : workers_(runtime::resolve_workers(options.workers)) {}
    static curves::Requirements requirements() noexcept {
        return {FrechetContinuousOptions::measure, 1, false};
    }
    static void check_sizes(std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/) noexcept {}
    std::ptrdiff_t workers() const noexcept { return workers_; }
    static std::int64_t steps(std::int64_t n, std::int64_t count, std::int64_t points) noexcept {
        return n * count + points;
    }

    template <class Use>
    static auto with_search_of(const PreparedP& P, const PreparedQ& Q, const BoxedCurve& p,
                               const BoxedCurve& q, const RangeScale& range, const Call& call,
                               PathEnds ends, Use use) {
        return with_dimension(p.dim(), [&](auto dim) {
            LeashSearch<dim> search(P.checked.curve, Q.checked.curve, p, q, range, call.poller,
                                    call.memory, ends);
            return use(search);
        });
    }

    // Calls use(search), the longer curve being the first.
    template <class Use>
    static auto with_search(const PreparedP& P, const PreparedQ& Q, const Call& call, Use use) {
        const bool swap = P.boxed.size() < Q.boxed.size();
        return with_ordered_search(swap ? Q : P, swap ? P : Q, call, PathEnds::corners(), use);
    }
    template <class Use>
    static auto with_ordered_search(const PreparedP& first, const PreparedQ& second,
                                    const Call& call, PathEnds ends, Use use) {
        const RangeScale range =
            plain_scale(std::max(first.checked.largest, second.checked.largest));
        if (range.is_identity()) {
            return with_search_of(first, second, first.boxed, second.boxed, range, call, ends, use);
        }
        const BoxedCurve p(first.checked.curve, range, call.poller);
        const BoxedCurve q(second.checked.curve, range, call.poller);
        return with_search_of(first, second, p, q, range, call, ends, use);
    }

    double operator()(const PreparedP& P, const PreparedQ& Q, const Call& call) const {
        return with_search(P, Q, call, [&](auto& search) { return search.value(call.cutoff); });
    }

    class Bounds;

   private:
    std::ptrdiff_t workers_;
};

// See leash_bounds.hpp.
class FrechetContinuousMeasure::Bounds {
   public:
    static constexpr int levels = 3;
    static constexpr std::uint64_t format = 0;
    void reserve(const FrechetContinuousMeasure& /*measure*/,
                 const std::vector<CurveView>& curves) {
        kept_.make_room(static_cast<std::ptrdiff_t>(curves.size()));
    }
    void keep(const PreparedQ& Q) { kept_.push_back({Q.checked, Q.boxed}); }
    pairwise::RowShape row_shape(const FrechetContinuousMeasure& /*measure*/) const noexcept {
        return kept_[0].row_shape();
    }
    void write_row(std::ptrdiff_t j, double* row) const noexcept { kept_[j].write_row(row); }
    void make_room(const Bounds& others) { kept_.make_room(others.kept_); }
    void take(Bounds& others) noexcept { kept_.take(others.kept_); }

    class Query {
       public:
        Query(const FrechetContinuousMeasure& measure, const Bounds& bounds, const PreparedP& P)
            : measure_(measure), kept_(bounds.kept_), P_(P), summary_(P.checked, P.boxed) {}
        void quick(std::ptrdiff_t first, std::ptrdiff_t count, double* bounds) const {
            kept_.in_parts(first, count, [&](const CurveSummary* others, std::ptrdiff_t part) {
                for (std::ptrdiff_t k = 0; k < part; ++k) *bounds++ = quick_bound(others[k]);
            });
        }
        void quick(std::ptrdiff_t first, const pairwise::BoundTree::Leaf& leaf,
                   double* bounds) const {
            for (std::ptrdiff_t k = 0; k < leaf.count; ++k) {
                bounds[k] = quick_bound(kept_[first + leaf.places[k]]);
            }
        }
        void of_boxes(const double* boxes, std::ptrdiff_t count, double* bounds) const {
            const std::ptrdiff_t dim = P_.boxed.dim();
            const std::ptrdiff_t width = summary_.row_shape().width;
            for (const double* box = boxes; box != boxes + count * 2 * width; box += 2 * width) {
                // Then all curves in the box are plain: the plain range is an interval, and 0. If P
                // and one of the curves are 0, the bound is.
                const bool is_bounded = is_plain(box[width - 1]) && is_plain(box[2 * width - 1]);
                *bounds++ = is_bounded ? summary_.bound_of_box(box, dim) : 0.0;
            }
        }
        double refined(std::ptrdiff_t /*j*/, const PreparedQ& Q, int level) const {
            if (!is_plain(Q.checked.largest)) return 0.0;
            return continuous::run_bound(P_.boxed, Q.boxed, level == 1 ? 8 : 32);
        }
        double value(std::ptrdiff_t /*j*/, const PreparedQ& Q, const Call& call) const {
            return measure_(P_, Q, call);
        }
        bool is_within(std::ptrdiff_t /*j*/, const PreparedQ& Q, const Call& call) const {
            return with_search(P_, Q, call,
                               [&](auto& search) { return search.is_within(call.cutoff); });
        }

       private:
        double quick_bound(const CurveSummary& other) const noexcept {
            return is_plain(other.largest()) ? summary_.bound(other, P_.boxed.dim()) : 0.0;
        }
        bool is_plain(double largest) const noexcept {
            return plain_scale(std::max(summary_.largest(), largest)).is_identity();
        }

        const FrechetContinuousMeasure& measure_;
        const runtime::GrowingList<CurveSummary>& kept_;
        const PreparedP& P_;
        CurveSummary summary_;
    };

   private:
    runtime::GrowingList<CurveSummary> kept_;
};

// Calls use(search) for two checked curves.
template <class Use>
auto with_search(const CurveView& P, const CurveView& Q, const FrechetContinuousOptions& options,
                 Control* control, Use use) {
    return pairwise::with_pair(FrechetContinuousMeasure(options), P, Q, control,
                               [&](const auto& p, const auto& q, const auto& call) {
                                   return FrechetContinuousMeasure::with_search(p, q, call, use);
                               });
}

// A single point was searched as an edge of no length.
void cut(Matching& found, const CurveView& P, const CurveView& Q) noexcept {
    for (std::array<double, 2>& pair : found.parameters) {
        pair[0] = std::min(pair[0], static_cast<double>(P.size() - 1));
        pair[1] = std::min(pair[1], static_cast<double>(Q.size() - 1));
    }
}

// Whether curves in the usual range, the longer one first, are within a distance. The ends and a
// walk over vertices come first, since they need no boxes.
template <int Dim>
bool is_within(const CheckedCurve& P, const CheckedCurve& Q, const Radius& radius,
               bool is_continuous, Poller& poller) {
    const auto vertices_of = [](const CurveView& curve) {
        return Vertices{curve.row_major(), curve.size(), curve.dim()};
    };
    VertexWalk<Dim> walk(vertices_of(P.curve), vertices_of(Q.curve),
                         continuous::ExactSigns(Q.curve, P.curve), radius);
    if (walk.misses_ends()) return false;
    if (walk.succeeds(poller, LeashSearch<Dim>::few_dead_ends)) return true;
    const BoxedCurve p(P.curve.row_major(), P.curve, poller),
        q(Q.curve.row_major(), Q.curve, poller);
    continuous::LeashMemory memory;
    LeashSearch<Dim> search(P.curve, Q.curve, p, q, RangeScale(1.0), poller, memory);
    return is_continuous ? search.is_within_after(walk, radius)
                         : search.is_coupled_within(radius.given());
}

}  // namespace

double frechet_continuous(const CurveView& P, const CurveView& Q,
                          const FrechetContinuousOptions& options, Control* control) {
    return pairwise::evaluate(FrechetContinuousMeasure(options), P, Q, control);
}

Interval frechet_continuous_bounds(const CurveView& P, const CurveView& Q,
                                   const FrechetContinuousOptions& options, Control* control) {
    return with_search(P, Q, options, control, [](auto& search) {
        const double high = search.value(infinity);
        const bool is_exact = high < infinity && !search.is_within(high, FreeSet::open);
        return Interval{is_exact ? high : continuous::next_below(high), high};
    });
}

Matching frechet_continuous_path(const CurveView& P, const CurveView& Q,
                                 const FrechetContinuousOptions& options, Control* control) {
    const bool swapped = P.size() < Q.size();  // with_search() puts the longer curve first
    Matching found = with_search(P, Q, options, control, [](auto& search) {
        auto [distance, parameters] = search.matching(search.value(infinity));
        return Matching{distance, std::move(parameters)};
    });
    if (swapped) {
        for (std::array<double, 2>& pair : found.parameters) std::swap(pair[0], pair[1]);
    }
    cut(found, P, Q);
    return found;
}

Matching frechet_continuous_part(const CurveView& P, const CurveView& Q,
                                 const FrechetContinuousOptions& options, Control* control) {
    Matching found =
        pairwise::with_pair(FrechetContinuousMeasure(options), P, Q, control,
                            [](const auto& p, const auto& q, const auto& call) {
                                return FrechetContinuousMeasure::with_ordered_search(
                                    p, q, call, PathEnds::anywhere(), [](auto& search) {
                                        auto [distance, parameters] = search.part();
                                        return Matching{distance, std::move(parameters)};
                                    });
                            });
    cut(found, P, Q);
    return found;
}

bool frechet_within(const CurveView& P, const CurveView& Q, double distance, bool continuous,
                    Control* control) {
    if (!(distance >= 0.0)) {
        std::ostringstream message;
        message << "distance is " << distance << "; give a number >= 0";
        throw std::invalid_argument(message.str());
    }
    const FrechetContinuousMeasure measure{FrechetContinuousOptions()};
    const auto decide = [&](const CheckedCurve& p, const CheckedCurve& q, Poller& poller) {
        const RangeScale range = plain_scale(std::max(p.largest, q.largest));
        if (range.is_identity() && P.row_major() != nullptr && Q.row_major() != nullptr) {
            const Radius radius(distance, range, P.dim(), FreeSet::closed);
            const bool swap = P.size() < Q.size();
            return with_dimension(P.dim(), [&](auto dim) {
                return is_within<dim>(swap ? q : p, swap ? p : q, radius, continuous, poller);
            });
        }
        const auto use = [&](const auto& first, const auto& second, const auto& call) {
            return FrechetContinuousMeasure::with_search(first, second, call, [&](auto& search) {
                return continuous ? search.is_within(distance) : search.is_coupled_within(distance);
            });
        };
        return pairwise::with_prepared(measure, p, q, poller, use);
    };
    return pairwise::with_checked_pair(measure, P, Q, control, decide);
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(
    const FrechetContinuousOptions& options) {
    return std::make_unique<BatchOf<FrechetContinuousMeasure>>(FrechetContinuousMeasure(options));
}

}  // namespace curvewise
