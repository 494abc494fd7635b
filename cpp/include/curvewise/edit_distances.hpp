/// \file
/// The edit distances between curves, and weighted dtw. Each is a struct of options and its
/// recurrence (recurrence.hpp), with the definitions and defaults of aeon 1.6. Exact. Time O(n m),
/// memory O(n + m). Errors and threads are as for dtw().
///
///     curvewise::MsmOptions options;
///     options.cost = 0.5;
///     const double distance = curvewise::evaluate(options, experiment, simulation);
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/ground_distance.hpp"
#include "curvewise/options.hpp"
#include "curvewise/recurrence.hpp"

namespace curvewise {

class Control;

/// The common options. Each struct also names the costs of its steps, in visit_costs().
struct EditOptions {
    static constexpr bool is_planar = false;  ///< for curves of any dimension
    static constexpr bool has_ground = true;  ///< among its options

    GroundDistance ground = {};
    /// As for dtw().
    std::optional<std::ptrdiff_t> window = {};
    std::optional<double> window_fraction = {};
    /// A larger distance becomes infinity, and its computation may end early. At least 0.
    double cutoff = std::numeric_limits<double>::infinity();

    static constexpr bool is_symmetric() noexcept { return true; }
    double work(double n, double m, double dim) const noexcept {
        return 2.0 * n * m * ground.weight(dim);
    }

   protected:
    Recurrence recurrence(const char* measure, std::vector<Step> steps) const {
        Recurrence result{measure, std::move(steps), ground};
        result.window = window;
        result.window_fraction = window_fraction;
        result.cutoff = cutoff;
        return result;
    }
};

inline constexpr RealNumberRange any_number_range{std::numeric_limits<double>::lowest(),
                                                  "give a number"};
inline constexpr RealNumberRange least_zero_range{0.0, "give a number >= 0"};
inline constexpr RealNumberRange threshold_range{0.0, "give a number >= 0, or None"};

/// Edit distance with real penalty (Chen & Ng 2004): a deleted point costs its distance from the
/// point whose coordinates are all `gap`. Paths that begin with deleted points pay for all points
/// of that curve, as in aeon.
struct ErpOptions : EditOptions {
    static constexpr const char* measure = "erp";
    double gap = 0.0;

    template <class Visit>
    void visit_costs(Visit& visit) {
        visit("gap", gap, any_number_range);
    }

    Recurrence recurrence() const {
        Recurrence result =
            EditOptions::recurrence(measure, {{1, 1, 0.0, {{0, 0, 1.0}}},
                                              {1, 0, 0.0, {{0, 0, 1.0, CostFrom::row_gap}}},
                                              {0, 1, 0.0, {{0, 0, 1.0, CostFrom::column_gap}}}});
        result.gaps = Gaps::to_point;
        result.gap = gap;
        result.border = Border::all_gaps;
        return result;
    }
};

/// Edit distance on real sequences (Chen, Özsu & Oria 2005), over the points of the longer curve.
/// Points at least `epsilon` apart cost 1, and so does a deleted point. Infinity selects the
/// default: a quarter of the larger standard deviation of all coordinates of either curve.
struct EdrOptions : EditOptions {
    static constexpr const char* measure = "edr";
    double epsilon = std::numeric_limits<double>::infinity();

    template <class Visit>
    void visit_costs(Visit& visit) {
        visit("epsilon", epsilon, threshold_range);
    }

    Recurrence recurrence() const {
        Recurrence result = EditOptions::recurrence(
            measure, {{1, 1, 0.0, {{0, 0, 1.0}}}, {1, 0, 1.0, {}}, {0, 1, 1.0, {}}});
        result.pair = PairCost::apart;
        result.threshold = epsilon;
        result.border = Border::zero;
        result.per = Per::longer;
        return result;
    }
};

/// Longest common subsequence (Vlachos, Kollios & Gunopulos 2002): 1 minus the share of the points
/// of the shorter curve that are matched, each to a point at most `epsilon` away.
struct LcssOptions : EditOptions {
    static constexpr const char* measure = "lcss";
    double epsilon = 1.0;

    template <class Visit>
    void visit_costs(Visit& visit) {
        visit("epsilon", epsilon, least_zero_range);
    }

    Recurrence recurrence() const {
        Recurrence result = EditOptions::recurrence(
            measure, {{1, 1, 0.0, {{0, 0, 1.0}}}, {1, 0, 0.0, {}}, {0, 1, 0.0, {}}});
        result.pair = PairCost::together;
        result.threshold = epsilon;
        result.border = Border::zero;
        result.per = Per::matches;
        return result;
    }
};

/// Move-split-merge (Stefan, Athitsos & Das 2013), of each coordinate alone, and their sum. It has
/// its own costs, the differences of numbers.
struct MsmOptions : EditOptions {
    static constexpr const char* measure = "msm";
    static constexpr bool has_ground = false;
    double cost = 1.0;

    template <class Visit>
    void visit_costs(Visit& visit) {
        visit("cost", cost, least_zero_range);
    }

    Recurrence recurrence() const {
        Recurrence result =
            EditOptions::recurrence(measure, {{1, 1, 0.0, {{0, 0, 1.0}}},
                                              {1, 0, cost, {{0, 0, 1.0, CostFrom::row_move}}},
                                              {0, 1, cost, {{0, 0, 1.0, CostFrom::column_move}}}});
        result.ground = {Metric::cityblock};
        result.by_coordinate = true;
        return result;
    }
};

/// Time warp edit distance (Marteau 2009), at the times 0, 1, 2, ...; `stiffness` is his nu,
/// `penalty` his lambda.
struct TweOptions : EditOptions {
    static constexpr const char* measure = "twe";
    double stiffness = 0.001;
    double penalty = 1.0;

    template <class Visit>
    void visit_costs(Visit& visit) {
        visit("stiffness", stiffness, least_zero_range);
        visit("penalty", penalty, least_zero_range);
    }

    Recurrence recurrence() const {
        const double deletion = stiffness + penalty;
        Recurrence result = EditOptions::recurrence(
            measure,
            {{1, 1, 0.0, {{0, 0, 1.0}, {1, 1, 1.0}, {0, 0, 2.0 * stiffness, CostFrom::offset}}},
             {1, 0, deletion, {{0, 0, 1.0, CostFrom::row_gap}}},
             {0, 1, deletion, {{0, 0, 1.0, CostFrom::column_gap}}}});
        result.gaps = Gaps::to_previous;
        result.border = Border::origin;
        return result;
    }
};

/// Weighted dtw (Jeong, Jeong & Omitaomu 2011): ground distances are divided by
/// 1 + exp(-steepness (|i - j| - max(n, m) / 2)).
struct WdtwOptions : EditOptions {
    static constexpr const char* measure = "wdtw";
    double steepness = 0.05;

    WdtwOptions() { ground.metric = Metric::sqeuclidean; }

    template <class Visit>
    void visit_costs(Visit& visit) {
        visit("steepness", steepness, least_zero_range);
    }

    Recurrence recurrence() const {
        Recurrence result = EditOptions::recurrence(
            measure,
            {{1, 1, 0.0, {{0, 0, 1.0}}}, {1, 0, 0.0, {{0, 0, 1.0}}}, {0, 1, 0.0, {{0, 0, 1.0}}}});
        result.pair = PairCost::weighted;
        result.steepness = steepness;
        return result;
    }
};

/// All of them, for measure.hpp.
using EditDistance =
    std::variant<ErpOptions, EdrOptions, LcssOptions, MsmOptions, TweOptions, WdtwOptions>;

template <class Options>
inline constexpr bool is_edit_distance = std::is_base_of_v<EditOptions, Options>;

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Options, class Visit, class = std::enable_if_t<is_edit_distance<Options>>>
void visit_options(Options& options, Visit&& visit) {
    if constexpr (Options::has_ground) visit(options.ground);
    options.visit_costs(visit);
    visit("window", options.window, options.window_fraction, window_range);
    visit("cutoff", options.cutoff, cutoff_range);
}

/// For code that treats all measures in the same way (measure.hpp).
template <class Options, class = std::enable_if_t<is_edit_distance<Options>>>
double evaluate(const Options& options, const CurveView& P, const CurveView& Q,
                Control* control = nullptr) {
    return warp(options.recurrence(), P, Q, control);
}

}  // namespace curvewise
