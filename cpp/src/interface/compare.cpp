// Presets: for each measure, whether its curves are scaled and which of its options are not the
// default.
#include "curvewise/compare.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "curvewise/pointwise.hpp"

namespace curvewise {
namespace {

// A curve in P's box.
class Scaled {
   public:
    Scaled(const CurveView& P, const CurveView& curve, const char* name, Control* control)
        : n_(curve.size()),
          dim_(curve.dim()),
          values_(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, n_ * dim_))) {
        normalize(P, curve, values_.data(), name, control);
    }
    CurveView view() const noexcept { return {values_.data(), n_, dim_}; }

   private:
    std::ptrdiff_t n_;
    std::ptrdiff_t dim_;
    std::vector<double> values_;
};

// For measures without further conditions.
template <class Options>
Condition condition(Preset preset, Options options) {
    return {options, preset == Preset::scaled};
}

Condition condition(Preset preset, FrechetOptions options) {
    return {options, preset != Preset::raw};
}

Condition condition(Preset preset, FrechetContinuousOptions options) {
    return {options, preset != Preset::raw};
}

Condition condition(Preset preset, AreaOptions options) {
    if (preset == Preset::paper) options.spacing = Spacing::x;
    if (preset == Preset::scaled) {
        options.spacing = Spacing::matched;
        // For calls that choose another spacing: "rearrange" jumps where curves cross, and an
        // identification takes these jumps for minima.
        options.crossing = Crossing::split;
    }
    return {options, preset == Preset::scaled};
}

Condition condition(Preset preset, DtwOptions options) {
    if (preset == Preset::paper) options.step_pattern = StepPattern::symmetric2;
    return {options, preset != Preset::raw};
}

Condition condition(Preset preset, CurveLengthOptions options) {
    if (preset == Preset::scaled) options.scale = LengthScale::mean_abs;
    return {options, preset == Preset::scaled};
}

// A Comparison has the five measures of the paper. The continuous Fréchet distance would say nearly
// the same as the discrete one.
template <class Options>
constexpr bool is_compared =
    !std::is_same_v<Options, FrechetContinuousOptions> &&
    !std::is_same_v<Options, HausdorffOptions> &&
    !std::is_same_v<Options, HausdorffContinuousOptions> && !is_edit_distance<Options>;

// The values that a Comparison has as members, too.
template <class Options>
void keep(Comparison& /*found*/, const Options& /*of*/, double /*value*/) {}
void keep(Comparison& found, const AreaOptions& /*of*/, double value) { found.area = value; }
void keep(Comparison& found, const PcmOptions& /*of*/, double value) { found.pcm = value; }
void keep(Comparison& found, const FrechetOptions& /*of*/, double value) { found.frechet = value; }
void keep(Comparison& found, const DtwOptions& /*of*/, double value) { found.dtw = value; }
void keep(Comparison& found, const CurveLengthOptions& /*of*/, double value) {
    found.curve_length = value;
}

}  // namespace

std::vector<Condition> conditions(Preset preset) {
    std::vector<Condition> result;
    for_each_measure([&](const auto& options) { result.push_back(condition(preset, options)); });
    return result;
}

Comparison compare(const CurveView& P, const CurveView& Q, Preset preset, Control* control) {
    std::optional<Scaled> p, q;
    if (preset != Preset::raw) {
        p.emplace(P, P, "P", control);
        q.emplace(P, Q, "Q", control);
    }
    const auto value = [&](const auto& options, bool scaled) {
        return scaled ? evaluate(options, p->view(), q->view(), control)
                      : evaluate(options, P, Q, control);
    };
    Comparison result;
    for (const Condition& given : conditions(preset)) {
        std::visit(
            [&](const auto& options) {
                if constexpr (is_compared<std::decay_t<decltype(options)>>) {
                    if (options.is_planar && P.dim() != 2) return;
                    result.values.push_back({options.measure, value(options, given.scaled)});
                    keep(result, options, result.values.back().value);
                }
            },
            given.measure);
    }
    return result;
}

}  // namespace curvewise
