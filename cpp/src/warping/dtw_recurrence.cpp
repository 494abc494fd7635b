#include "warping/dtw_recurrence.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "runtime/workers.hpp"

namespace curvewise::warping {

namespace {

// Where paths may begin and end that leave out some points. Their costs are compared undivided.
FreeEnds relaxed_ends(const DtwOptions& options) {
    const auto& [p_begin, p_end, q_begin, q_end] = options.relax;
    if (*std::min_element(options.relax.begin(), options.relax.end()) < relax_range.least) {
        throw std::invalid_argument("relax is (" + std::to_string(p_begin) + ", " +
                                    std::to_string(p_end) + ", " + std::to_string(q_begin) + ", " +
                                    std::to_string(q_end) + "); " + relax_range.advice);
    }
    if (!options.own_steps.rows.empty() || options.step_pattern != StepPattern::symmetric1) {
        throw std::invalid_argument("relax needs step_pattern='symmetric1'");
    }
    const auto refuse_beside = [](bool is_given, const char* option) {
        if (is_given) {
            throw std::invalid_argument(std::string("relax cannot be combined with ") + option);
        }
    };
    refuse_beside(options.window || options.window_fraction, "window");
    refuse_beside(options.open_begin || options.open_end, "open_begin and open_end");
    refuse_beside(options.normalize, "normalize");
    return {p_begin, p_end, q_begin, q_end};
}

// Where paths may begin and end. Values of ends that differ in the weight of their paths are
// compared by weight; where it is not known, and for beginnings, they cannot be.
FreeEnds open_ends(const DtwOptions& options, Per per, const std::string& name) {
    if (!options.open_begin && !options.open_end) return {};
    if (options.window || options.window_fraction) {
        throw std::invalid_argument("open_begin and open_end cannot be combined with window");
    }
    if (options.open_begin && per != Per::rows) {
        throw std::invalid_argument(
            "open_begin needs step_pattern='symmetric1' without a penalty, or a step pattern "
            "normalised by N, such as 'asymmetric'; " +
            name + " is not");
    }
    if (per == Per::one) {
        throw std::invalid_argument(
            "open_end needs step_pattern='symmetric1' without a penalty, or a step pattern whose "
            "paths all have one weight, such as 'symmetric2' or 'asymmetric'; those of " +
            name + " differ");
    }
    FreeEnds ends;
    ends.q_begin = options.open_begin ? FreeEnds::all : 0;
    ends.q_end = options.open_end ? FreeEnds::all : 0;
    ends.per = per;
    return ends;
}

}  // namespace

Recurrence recurrence_of(const DtwOptions& options) {
    const auto place = static_cast<std::size_t>(options.step_pattern);
    const bool is_own = !options.own_steps.rows.empty();
    const std::string name = is_own ? "of one's own" : std::string(step_patterns[place].name);
    const StepRows rows = is_own ? options.own_steps : step_rows(step_patterns[place]);
    const FreeEnds ends =
        is_relaxed(options) ? relaxed_ends(options) : open_ends(options, rows.per, name);
    if (options.normalize && rows.per == Per::one) {
        throw std::invalid_argument(
            "normalize needs a step pattern whose paths all have one "
            "weight, such as 'symmetric2'; those of " +
            name + " differ");
    }
    if (!(options.penalty >= 0.0)) {
        throw std::invalid_argument("penalty is " + std::to_string(options.penalty) + "; " +
                                    penalty_range.advice);
    }
    runtime::resolve_workers(options.workers);
    Recurrence result{DtwOptions::measure, steps_of(rows), options.ground};
    for (Step& step : result.steps) {
        if (step.rows != step.columns) step.constant = options.penalty;
    }
    result.per = options.normalize ? rows.per : Per::one;
    result.window = options.window;
    result.window_fraction = options.window_fraction;
    result.cutoff = options.cutoff;
    result.ends = ends;
    return result;
}

Recurrence recurrence_of_path(DtwOptions options) {
    options.normalize = false;
    return recurrence_of(options);
}

}  // namespace curvewise::warping
