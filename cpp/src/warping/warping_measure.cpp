// dtw and frechet: one measure class over the cumulative table (warping_problem.hpp), with its
// lower bounds for searches (pair_bounds.hpp), and their paths and tables.
#include <algorithm>
#include <limits>
#include <optional>

#include "curves/range_scale.hpp"
#include "curves/sphere.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "runtime/stopwatch.hpp"
#include "warping/curves_beside.hpp"
#include "warping/dtw_recurrence.hpp"
#include "warping/packed_side.hpp"
#include "warping/pair_bounds.hpp"
#include "warping/warping_problem.hpp"

namespace curvewise {
namespace {

using curves::RangeScale;
using runtime::Poller;
using warping::Band;
using warping::CostToGo;
using warping::PackedCurve;
using warping::PointOrder;
using warping::SweepMemory;
using warping::WarpingOptions;
using warping::WarpingProblem;
using warping::Window;

constexpr double infinity = std::numeric_limits<double>::infinity();

class WarpingMeasure : public pairwise::SweptMeasure {
   public:
    using Memory = SweepMemory;
    using PreparedP = warping::PackedSide<PointOrder::forward>;
    using PreparedQ = warping::PackedSide<PointOrder::reversed>;

    // The measure for dtw or frechet.
    template <class Options>
    explicit WarpingMeasure(const Options& options) : options_(warping::checked_options(options)) {}
    curves::Requirements requirements() const noexcept {
        return warping::requirements(options_.measure, options_.ground);
    }
    void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const {
        options_.window.check_sizes(n, m);
    }
    std::ptrdiff_t workers() const noexcept { return options_.workers; }

    // Calls use(problem).
    template <class Use>
    auto with_problem(const PreparedP& P, const PreparedQ& Q, const pairwise::Call<Memory>& call,
                      Use use) const {
        const RangeScale range =
            warping::range_of(options_.ground, std::max(P.checked.largest, Q.checked.largest));
        if (range.is_identity()) {
            WarpingProblem problem(options_, {P.packed, Q.packed}, range, call);
            return use(problem);
        }
        const PackedCurve p(P.checked.curve, range, PointOrder::forward, call.poller);
        const PackedCurve q(Q.checked.curve, range, PointOrder::reversed, call.poller);
        WarpingProblem problem(options_, {p, q}, range, call);
        return use(problem);
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        return value(P, Q, call, [](WarpingProblem& problem, double cutoff) {
            return problem.distance(cutoff);
        });
    }

    // What compute(problem, cutoff of the undivided distance) returns, divided.
    template <class Compute>
    double value(const PreparedP& P, const PreparedQ& Q, const pairwise::Call<Memory>& call,
                 Compute compute) const {
        const double divisor = options_.divisor(P.packed.size(), Q.packed.size());
        const double cutoff = warping::undivided(std::min(call.cutoff, options_.cutoff), divisor);
        const double found =
            with_problem(P, Q, call,
                         [&](WarpingProblem& problem) { return compute(problem, cutoff); }) /
            divisor;
        return found > options_.cutoff ? infinity : found;
    }

    class Bounds;
    class Beside;

   private:
    WarpingOptions options_;
};

// See warping::CurvesBeside.
class WarpingMeasure::Beside {
   public:
    static std::ptrdiff_t most(const WarpingMeasure& measure, std::ptrdiff_t n, std::ptrdiff_t m,
                               std::ptrdiff_t dim) noexcept {
        return warping::CurvesBeside::most(measure.options_, n, m, dim);
    }
    static pairwise::BesideEffort effort(const WarpingMeasure& measure, std::ptrdiff_t n,
                                         std::ptrdiff_t m, std::ptrdiff_t dim) noexcept {
        return warping::CurvesBeside::effort(measure.options_, n, m, dim);
    }
    std::ptrdiff_t gather(const WarpingMeasure& measure, const PreparedQ* const* curves,
                          std::ptrdiff_t count, bool has_cutoff) {
        return curves_.gather(measure.options_, curves, count, has_cutoff);
    }
    bool values(const WarpingMeasure& measure, const PreparedP& P, std::ptrdiff_t first,
                double* out, Poller& poller) {
        return curves_.distances(measure.options_, P, first, out, poller);
    }
    std::ptrdiff_t candidates(const WarpingMeasure& measure, double cutoff, const PreparedP& P,
                              std::ptrdiff_t first, std::ptrdiff_t* places, double& saved,
                              Poller& poller) {
        return curves_.candidates(measure.options_, cutoff, P, first, places, saved, poller);
    }
    bool bounds(const WarpingMeasure& measure, double cutoff, const PreparedP& P, double* out,
                Poller& poller) {
        return curves_.bounds(measure.options_, cutoff, P, out, poller);
    }
    bool pair_values(const WarpingMeasure& measure, const PreparedP* const* Ps,
                     const PreparedQ* const* Qs, std::ptrdiff_t count, double* out,
                     Poller& poller) {
        return curves_.pair_distances(measure.options_, Ps, Qs, count, out, poller);
    }

   private:
    warping::CurvesBeside curves_;
};

// See warping::PairBounds.
class WarpingMeasure::Bounds {
   public:
    static constexpr int levels = warping::PairBounds::levels;
    static constexpr std::uint64_t format = warping::KeptBounds::format;
    static std::ptrdiff_t stored_size(std::ptrdiff_t points, std::ptrdiff_t dim) noexcept {
        return warping::KeptBounds::stored_size(points, dim);
    }
    void write(std::ptrdiff_t j, double* to) const noexcept { kept_.write(j, to); }
    void look_at(std::ptrdiff_t points, std::ptrdiff_t dim, const double* stored) {
        kept_.look_at(points, dim, stored);
    }
    void reserve(const WarpingMeasure& measure, const std::vector<CurveView>& curves) {
        if (curves.empty()) return;
        const bool on_sphere = measure.requirements().on_sphere;
        kept_.reserve(curves, on_sphere ? curves::sphere_dim : curves[0].dim());
    }
    void keep(const PreparedQ& Q) { kept_.keep(Q.checked, Q.packed, PointOrder::reversed); }
    pairwise::RowShape row_shape(const WarpingMeasure& measure) const noexcept {
        return kept_.row_shape(measure.options_.ground);
    }
    void write_row(std::ptrdiff_t j, double* row) const noexcept { kept_.write_row(j, row); }
    void make_room(const Bounds& others) { kept_.make_room(others.kept_); }
    void take(Bounds& others) noexcept { kept_.take(others.kept_); }

    class Query {
       public:
        Query(const WarpingMeasure& measure, const Bounds& bounds, const PreparedP& P)
            : measure_(measure),
              P_(P),
              bounds_(measure.options_, bounds.kept_, P.checked, P.packed) {}
        void quick(std::ptrdiff_t first, std::ptrdiff_t count, double* bounds) const {
            bounds_.first().quick(first, count, bounds);
        }
        void quick(std::ptrdiff_t first, const pairwise::BoundTree::Leaf& leaf,
                   double* bounds) const {
            bounds_.first().quick(first, leaf, bounds);
        }
        void of_boxes(const double* boxes, std::ptrdiff_t count, double* bounds) const {
            bounds_.first().of_boxes(boxes, count, bounds);
        }
        double refined(std::ptrdiff_t j, const PreparedQ& Q, int level) {
            return bounds_.refined(j, Q.packed, level);
        }
        double value(std::ptrdiff_t j, const PreparedQ& Q, const pairwise::Call<Memory>& call) {
            const WarpingOptions& options = measure_.options_;
            if (!options.prune || !(call.cutoff < options.cutoff)) return measure_(P_, Q, call);
            return measure_.value(P_, Q, call, [&](WarpingProblem& problem, double cutoff) {
                const std::optional<CostToGo> cost_to_go =
                    bounds_.cost_to_go(j, Q.packed, problem.most_in_table(cutoff));
                if (!cost_to_go) return problem.distance(cutoff, !bounds_.has_looked_at_ends(j));
                if (bounds_.is_hopeless(*cost_to_go)) return infinity;
                if (!bounds_.is_of_lines()) return problem.narrowed_distance(*cost_to_go);
                call.poller.count_steps(P_.packed.size() * Q.packed.size());
                return bounds_.line_value(Q.packed, *cost_to_go);
            });
        }
        bool is_within(std::ptrdiff_t j, const PreparedQ& Q, const pairwise::Call<Memory>& call) {
            return value(j, Q, call) <= call.cutoff;
        }

       private:
        const WarpingMeasure& measure_;
        const PreparedP& P_;
        warping::PairBounds bounds_;
    };

   private:
    warping::KeptBounds kept_;
};

Alignment path(const WarpingMeasure& measure, const CurveView& P, const CurveView& Q,
               Control* control) {
    return pairwise::with_pair(
        measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
            call.poller.begin(2 * P.size() * Q.size());
            return measure.with_problem(
                p, q, call, [](const WarpingProblem& problem) { return problem.alignment(); });
        });
}

WarpingInfo info(const WarpingMeasure& measure, const CurveView& P, const CurveView& Q,
                 Control* control) {
    return pairwise::with_pair(
        measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
            return measure.with_problem(p, q, call,
                                        [](WarpingProblem& problem) { return problem.info(); });
        });
}

void table(const WarpingMeasure& measure, const CurveView& P, const CurveView& Q, double* out,
           Control* control) {
    pairwise::with_pair(
        measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
            measure.with_problem(p, q, call,
                                 [&](const WarpingProblem& problem) { problem.write_table(out); });
        });
}

// Calls swept(measure) if dtw's own sweep has the options, else interpreted().
template <class Swept, class Interpreted>
auto as_swept(const DtwOptions& options, Swept swept, Interpreted interpreted) {
    if (warping::is_swept_by_dtw(options)) return swept(WarpingMeasure(options));
    return interpreted();
}

// The value of a recurrence, whose band is filled as a whole.
WarpingInfo info_of_recurrence(const DtwOptions& options, const CurveView& P, const CurveView& Q,
                               Control* control) {
    runtime::Stopwatch all;
    WarpingInfo info;
    info.value = warp(warping::recurrence_of(options), P, Q, control);
    const Band band(P.size(), Q.size(),
                    Window{options.window, options.window_fraction}.between(P.size(), Q.size()));
    for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
        info.cells_swept += band.columns(i).last - band.columns(i).first + 1;
    }
    info.share = static_cast<double>(info.cells_swept) /
                 (static_cast<double>(P.size()) * static_cast<double>(Q.size()));
    info.phases.push_back({"all", all.lap()});
    return info;
}

}  // namespace

bool DtwOptions::is_symmetric() const {
    if (warping::is_swept_by_dtw(*this)) return !open_begin && !open_end;
    return warping::recurrence_of(*this).is_symmetric();
}

double dtw(const CurveView& P, const CurveView& Q, const DtwOptions& options, Control* control) {
    return as_swept(
        options,
        [&](const WarpingMeasure& measure) { return pairwise::evaluate(measure, P, Q, control); },
        [&] { return warp(warping::recurrence_of(options), P, Q, control); });
}

double frechet(const CurveView& P, const CurveView& Q, const FrechetOptions& options,
               Control* control) {
    return pairwise::evaluate(WarpingMeasure(options), P, Q, control);
}

Alignment dtw_path(const CurveView& P, const CurveView& Q, const DtwOptions& options,
                   Control* control) {
    return as_swept(
        options, [&](const WarpingMeasure& measure) { return path(measure, P, Q, control); },
        [&] { return warp_path(warping::recurrence_of_path(options), P, Q, control); });
}

Alignment frechet_path(const CurveView& P, const CurveView& Q, const FrechetOptions& options,
                       Control* control) {
    return path(WarpingMeasure(options), P, Q, control);
}

WarpingInfo dtw_info(const CurveView& P, const CurveView& Q, const DtwOptions& options,
                     Control* control) {
    return as_swept(
        options, [&](const WarpingMeasure& measure) { return info(measure, P, Q, control); },
        [&] { return info_of_recurrence(options, P, Q, control); });
}

WarpingInfo frechet_info(const CurveView& P, const CurveView& Q, const FrechetOptions& options,
                         Control* control) {
    return info(WarpingMeasure(options), P, Q, control);
}

void dtw_table(const CurveView& P, const CurveView& Q, double* out, const DtwOptions& options,
               Control* control) {
    as_swept(
        options, [&](const WarpingMeasure& measure) { table(measure, P, Q, out, control); },
        [&] { warp_table(warping::recurrence_of_path(options), P, Q, out, control); });
}

void frechet_table(const CurveView& P, const CurveView& Q, double* out,
                   const FrechetOptions& options, Control* control) {
    table(WarpingMeasure(options), P, Q, out, control);
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(const DtwOptions& options) {
    warping::refuse_own_distances(options.ground);
    using Batch = std::unique_ptr<const BatchMeasure>;
    return as_swept(
        options,
        [](WarpingMeasure measure) -> Batch {
            return std::make_unique<BatchOf<WarpingMeasure>>(std::move(measure));
        },
        [&]() -> Batch { return batch_measure(warping::recurrence_of(options)); });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(
    const FrechetOptions& options) {
    warping::refuse_own_distances(options.ground);
    return std::make_unique<BatchOf<WarpingMeasure>>(WarpingMeasure(options));
}

}  // namespace curvewise
