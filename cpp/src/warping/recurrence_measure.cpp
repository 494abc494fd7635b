// Any recurrence as a measure (pairwise/measure.hpp): its value, its path and its table, by the
// sweep of recurrence_sweep.hpp; in one thread a pair.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "curvewise/recurrence.hpp"
#include "pairwise/batch_of.hpp"
#include "pairwise/evaluate.hpp"
#include "runtime/scratch.hpp"
#include "warping/ground_distance.hpp"
#include "warping/packed_side.hpp"
#include "warping/recurrence_sweep.hpp"
#include "warping/window.hpp"

namespace curvewise {
namespace {

using curves::RangeScale;
using runtime::Poller;
using warping::IndexPairs;
using warping::PackedCurve;
using warping::PointOrder;
using warping::RecurrenceProblem;
using warping::RecurrenceSweep;
using warping::StepTable;

constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse_gap(double gap) {
    char number[32];
    std::snprintf(number, sizeof number, "%.10g", gap);
    throw std::invalid_argument(std::string("gap is ") + number +
                                "; metric='haversine' takes it for a longitude and a latitude: "
                                "give a number from -90 to 90");
}

[[noreturn]] void refuse_no_epsilon(const std::string& measure) {
    throw std::invalid_argument(measure +
                                " with metric='haversine' needs epsilon: degrees have "
                                "no deviation in metres");
}

// The points of a curve, preceded by a point whose coordinates are all 0.
runtime::ScratchVector<double> led(const CurveView& curve) {
    runtime::ScratchVector<double> points(
        static_cast<std::size_t>((curve.size() + 1) * curve.dim()), 0.0);
    double* next = points.data() + curve.dim();
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) *next++ = curve(i, c);
    }
    return points;
}

// A quarter of the larger standard deviation of all coordinates of either curve, in a range.
double quarter_of_deviation(const CurveView& P, const CurveView& Q, const RangeScale& range) {
    const auto deviation = [&](const CurveView& curve) {
        const double count = static_cast<double>(curve.size() * curve.dim());
        const auto mean = [&](auto term) {
            double sum = 0.0;
            for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
                for (std::ptrdiff_t c = 0; c < curve.dim(); ++c)
                    sum += term(range.shrink(curve(i, c)));
            }
            return sum / count;
        };
        const double middle = mean([](double x) { return x; });
        return std::sqrt(mean([=](double x) { return (x - middle) * (x - middle); }));
    };
    return std::max(deviation(P), deviation(Q)) / 4.0;
}

// The largest cost of a step that does not come from the points.
double largest_constant(const Recurrence& recurrence) noexcept {
    double largest = 0.0;
    for (const Step& step : recurrence.steps) {
        largest = std::max(largest, step.constant);
        for (const StepTerm& term : step.terms) {
            if (term.from == CostFrom::offset) largest = std::max(largest, term.weight);
        }
    }
    return largest;
}

// Whether all that steps add is at least 0.
bool costs_are_positive(const Recurrence& recurrence) noexcept {
    if (recurrence.pair == PairCost::together) return false;
    return std::none_of(recurrence.steps.begin(), recurrence.steps.end(), [](const Step& step) {
        return step.constant < 0.0 ||
               std::any_of(step.terms.begin(), step.terms.end(),
                           [](const StepTerm& term) { return term.weight < 0.0; });
    });
}

// Whether a step leads from (i, i) to (i + 1, i + 1) and adds only costs of such cells.
bool has_step_of_diagonal(const Recurrence& recurrence) noexcept {
    const auto is_on_diagonal = [](const StepTerm& term) {
        return term.weight == 0.0 || (term.rows == term.columns && (term.from == CostFrom::pair ||
                                                                    term.from == CostFrom::offset));
    };
    return std::any_of(recurrence.steps.begin(), recurrence.steps.end(), [&](const Step& step) {
        return step.rows == 1 && step.columns == 1 && step.constant == 0.0 &&
               std::all_of(step.terms.begin(), step.terms.end(), is_on_diagonal);
    });
}

// The same steps, which cost nothing: of their table a cell is 0 where a path leads to it.
Recurrence without_costs(Recurrence recurrence) {
    for (Step& step : recurrence.steps) {
        step.constant = 0.0;
        for (StepTerm& term : step.terms) term.weight = 0.0;
    }
    // The cost of the first cell is finite, too, for any distance of its points.
    recurrence.pair = PairCost::apart;
    recurrence.threshold = infinity;
    recurrence.gaps = Gaps::none;
    return recurrence;
}

class RecurrenceMeasure : public pairwise::SweptMeasure {
   public:
    using Memory = warping::RecurrenceMemory;
    using PreparedP = warping::PackedSide<PointOrder::forward>;
    using PreparedQ = warping::PackedSide<PointOrder::reversed>;

    explicit RecurrenceMeasure(Recurrence recurrence)
        : recurrence_(std::move(recurrence)),
          steps_(recurrence_, RangeScale(1.0)),
          costs_are_positive_(costs_are_positive(recurrence_)) {
        warping::check_ground_distance(recurrence_.ground);
        if (needs_points()) warping::refuse_own_distances(recurrence_.ground);
        curves::check_limit("cutoff", recurrence_.cutoff, may_be_negative());
        window().check();
        check_number("gap", recurrence_.gap);
        if (warping::takes_degrees(recurrence_.ground.metric)) check_on_sphere();
        check_number("steepness", recurrence_.steepness);
    }
    curves::Requirements requirements() const noexcept {
        return warping::requirements(recurrence_.measure, recurrence_.ground);
    }
    void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const { window().check_sizes(n, m); }
    bool may_be_negative() const noexcept {
        return recurrence_.per != Per::matches && !costs_are_positive_;
    }
    bool is_zero_to_itself(const curves::CheckedCurve& checked) const {
        if (may_be_negative() || !has_step_of_diagonal(recurrence_)) return false;
        return recurrence_.pair != PairCost::apart ||
               threshold_of(checked.curve, checked.curve, range_of(checked.largest)) > 0.0;
    }

    // Calls use(problem).
    template <class Use>
    auto with_curves(const PreparedP& P, const PreparedQ& Q, Poller& poller, Use use) const {
        const RangeScale range = range_of(std::max(P.checked.largest, Q.checked.largest));
        const double threshold = threshold_of(P.checked.curve, Q.checked.curve, range);
        const bool is_led = recurrence_.border == Border::origin;
        if (range.is_identity() && !is_led) {
            return use(
                RecurrenceProblem{recurrence_, steps_, {P.packed, Q.packed}, range, threshold});
        }
        const auto pack = [&](const curves::CheckedCurve& checked, PointOrder order) {
            const CurveView& curve = checked.curve;
            const runtime::ScratchVector<double> points =
                is_led ? led(curve) : runtime::ScratchVector<double>();
            return PackedCurve::of(
                is_led ? CurveView(points.data(), curve.size() + 1, curve.dim()) : curve,
                checked.on_sphere, range, order, poller);
        };
        const PackedCurve p = pack(P.checked, PointOrder::forward);
        const PackedCurve q = pack(Q.checked, PointOrder::reversed);
        return use(RecurrenceProblem{
            recurrence_, StepTable(recurrence_, range), {p, q}, range, threshold});
    }

    double operator()(const PreparedP& P, const PreparedQ& Q,
                      const pairwise::Call<Memory>& call) const {
        const std::ptrdiff_t n = P.packed.size(), m = Q.packed.size();
        const double cutoff = std::min(call.cutoff, recurrence_.cutoff);
        const double found = with_curves(P, Q, call.poller, [&](const RecurrenceProblem& problem) {
            const bool may_give_up =
                problem.range.is_identity() && costs_are_positive_ && paths_visit_all_rows();
            // The most that a value is divided by.
            const double most = warping::divisor(recurrence_.per, n, m);
            const double give_up = may_give_up ? warping::undivided(cutoff, most) : infinity;
            double sum = 0.0;
            std::ptrdiff_t rows = n, columns = m;
            for_each_table(problem.curves, [&](std::ptrdiff_t coordinate) {
                const RecurrenceSweep::End end =
                    RecurrenceSweep(problem, coordinate, call.poller, call.memory).end(give_up);
                sum += end.value;
                if (recurrence_.ends.are_free()) rows = end.row + 1, columns = end.column + 1;
            });
            return finished(restored(sum, problem.range), rows, columns);
        });
        return found > recurrence_.cutoff ? infinity : found;
    }

    Alignment path(const PreparedP& P, const PreparedQ& Q,
                   const pairwise::Call<Memory>& call) const {
        if (recurrence_.by_coordinate && P.packed.dim() > 1) {
            throw std::invalid_argument(
                std::string(recurrence_.measure) +
                " has no path for curves of several coordinates, of which each has its own; take "
                "them one by one");
        }
        const std::ptrdiff_t n = P.packed.size(), m = Q.packed.size();
        Alignment found;
        with_curves(P, Q, call.poller, [&](const RecurrenceProblem& problem) {
            const RecurrenceSweep::End end =
                RecurrenceSweep(problem, -1, call.poller, call.memory).end(infinity);
            found.distance = finished(restored(end.value, problem.range), n, m);
            const IndexPairs path =
                end.value < infinity
                    ? RecurrenceSweep(problem, -1, call.poller, call.memory).path(end)
                    : path_of_any_cost(problem, call);
            const bool is_led = recurrence_.border == Border::origin && !path.empty();
            found.path.assign(path.begin() + is_led, path.end());
            if (is_led) {  // without the point before the first
                for (auto& [i, j] : found.path) --i, --j;
            }
        });
        return found;
    }

    void write_table(const PreparedP& P, const PreparedQ& Q, const pairwise::Call<Memory>& call,
                     double* out) const {
        const std::ptrdiff_t n = P.packed.size(), m = Q.packed.size();
        std::fill_n(out, n * m, 0.0);
        with_curves(P, Q, call.poller, [&](const RecurrenceProblem& problem) {
            const std::ptrdiff_t rows = problem.curves.rows(), width = problem.curves.columns();
            const std::ptrdiff_t led = rows - n;
            runtime::ScratchVector<double> table(static_cast<std::size_t>(rows * width));
            for_each_table(problem.curves, [&](std::ptrdiff_t coordinate) {
                RecurrenceSweep(problem, coordinate, call.poller, call.memory)
                    .write_table(table.data());
                for (std::ptrdiff_t i = 0; i < n; ++i) {
                    const double* const row = table.data() + (i + led) * width + led;
                    for (std::ptrdiff_t j = 0; j < m; ++j) {
                        out[i * m + j] += restored(row[j], problem.range);
                    }
                }
            });
        });
    }

   private:
    // If every path is infinite, one of them; empty if the steps admit no path.
    static IndexPairs path_of_any_cost(const RecurrenceProblem& problem,
                                       const pairwise::Call<Memory>& call) {
        const Recurrence recurrence = without_costs(problem.recurrence);
        const StepTable steps(recurrence, problem.range);
        const RecurrenceProblem reachable{recurrence, steps, problem.curves, problem.range,
                                          infinity};
        const bool was_counting = call.poller.set_counting(false);
        const RecurrenceSweep::End end =
            RecurrenceSweep(reachable, -1, call.poller, call.memory).end(infinity);
        call.poller.set_counting(was_counting);
        if (end.value == infinity) return {};
        return RecurrenceSweep(reachable, -1, call.poller, call.memory).path(end);
    }

    warping::Window window() const noexcept {
        return {recurrence_.window, recurrence_.window_fraction};
    }

    // Besides the distances of pairs.
    bool needs_points() const noexcept {
        return recurrence_.gaps != Gaps::none || recurrence_.by_coordinate ||
               recurrence_.border == Border::origin || recurrence_.pair != PairCost::distance;
    }

    static void check_number(const char* name, double value) {
        if (!std::isfinite(value)) {
            throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                                        "; give a number");
        }
    }

    void check_on_sphere() const {
        if (recurrence_.gaps == Gaps::to_point && !(std::abs(recurrence_.gap) <= 90.0)) {
            refuse_gap(recurrence_.gap);
        }
        if (recurrence_.pair == PairCost::apart && recurrence_.threshold == infinity) {
            refuse_no_epsilon(recurrence_.measure);
        }
    }

    template <class Use>
    void for_each_table(const warping::PackedPair& curves, Use use) const {
        if (!recurrence_.by_coordinate || curves.dim() == 1) return use(-1);
        for (std::ptrdiff_t c = 0; c < curves.dim(); ++c) use(c);
    }

    // The range of curves of this largest magnitude.
    RangeScale range_of(double largest) const noexcept {
        const RangeScale range = warping::range_of(recurrence_.ground, largest);
        if (recurrence_.gaps == Gaps::to_point) return range.with_coordinate(recurrence_.gap);
        if (warping::is_count(recurrence_)) return range;
        return range.beside(largest_constant(recurrence_),
                            warping::degree(recurrence_.ground.metric));
    }

    // In units of a range. One that is not 0 stays so: equal points are below it.
    double threshold_of(const CurveView& P, const CurveView& Q, const RangeScale& range) const {
        const int degree = warping::degree(recurrence_.ground.metric);
        if (recurrence_.pair == PairCost::apart && recurrence_.threshold == infinity) {
            return range.restore(quarter_of_deviation(P, Q, range), 1 - degree);
        }
        const double given = recurrence_.threshold;
        return given > 0.0 ? std::max(range.restore(given, -degree),
                                      std::numeric_limits<double>::denorm_min())
                           : given;
    }

    double restored(double value, const RangeScale& range) const noexcept {
        if (warping::is_count(recurrence_)) return value;
        return range.restore(value, warping::degree(recurrence_.ground.metric));
    }

    // The final value for the first n and m points of the curves.
    double finished(double value, std::ptrdiff_t n, std::ptrdiff_t m) const noexcept {
        if (recurrence_.per != Per::matches) return value / warping::divisor(recurrence_.per, n, m);
        return std::max(0.0, 1.0 + value / static_cast<double>(std::min(n, m)));
    }

    // Whether each path visits a row of every `reach` rows that follow each other.
    bool paths_visit_all_rows() const noexcept {
        return recurrence_.ends.p_begin == 0 && recurrence_.ends.p_end == 0;
    }

    Recurrence recurrence_;
    StepTable steps_;
    bool costs_are_positive_;
};

}  // namespace

bool Recurrence::is_symmetric() const {
    if (per == Per::rows || per == Per::columns) return false;
    if (ends.p_begin != ends.q_begin || ends.p_end != ends.q_end) return false;
    // Each kind of cost with P and Q exchanged, in the order of CostFrom.
    constexpr CostFrom turned[] = {CostFrom::pair,   CostFrom::column_gap,  CostFrom::row_gap,
                                   CostFrom::offset, CostFrom::column_move, CostFrom::row_move};
    static_assert(static_cast<std::size_t>(CostFrom::column_move) + 1 == std::size(turned));
    const auto mirrors = [&](const Step& one, const Step& other) {
        return one.rows == other.columns && one.columns == other.rows &&
               one.constant == other.constant &&
               std::equal(one.terms.begin(), one.terms.end(), other.terms.begin(),
                          other.terms.end(), [&](const StepTerm& a, const StepTerm& b) {
                              return a.rows == b.columns && a.columns == b.rows &&
                                     a.weight == b.weight &&
                                     a.from == turned[static_cast<std::size_t>(b.from)];
                          });
    };
    return std::all_of(steps.begin(), steps.end(), [&](const Step& one) {
        return std::any_of(steps.begin(), steps.end(),
                           [&](const Step& other) { return mirrors(one, other); });
    });
}

double warp(const Recurrence& recurrence, const CurveView& P, const CurveView& Q,
            Control* control) {
    return pairwise::evaluate(RecurrenceMeasure(recurrence), P, Q, control);
}

Alignment warp_path(const Recurrence& recurrence, const CurveView& P, const CurveView& Q,
                    Control* control) {
    const RecurrenceMeasure measure(recurrence);
    return pairwise::with_pair(
        measure, P, Q, control,
        [&](const auto& p, const auto& q, const auto& call) { return measure.path(p, q, call); });
}

void warp_table(const Recurrence& recurrence, const CurveView& P, const CurveView& Q, double* out,
                Control* control) {
    const RecurrenceMeasure measure(recurrence);
    pairwise::with_pair(measure, P, Q, control,
                        [&](const auto& p, const auto& q, const auto& call) {
                            measure.write_table(p, q, call, out);
                        });
}

std::unique_ptr<const pairwise::BatchMeasure> pairwise::batch_measure(
    const Recurrence& recurrence) {
    warping::refuse_own_distances(recurrence.ground);
    return std::make_unique<BatchOf<RecurrenceMeasure>>(RecurrenceMeasure(recurrence));
}

}  // namespace curvewise
