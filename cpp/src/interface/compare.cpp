// Presets: for each measure, whether its curves are scaled and which of its options are not the
// default.
#include "curvewise/compare.hpp"

#include <algorithm>
#include <cstddef>

#include "curvewise/pointwise.hpp"

namespace curvewise {
namespace {

// A curve in P's box.
class Scaled {
   public:
    Scaled(const CurveView& P, const CurveView& curve, const char* name)
        : n_(curve.size()),
          dim_(curve.dim()),
          values_(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, n_ * dim_))) {
        normalize(P, curve, values_.data(), name);
    }
    CurveView view() const noexcept { return {values_.data(), n_, dim_}; }

   private:
    std::ptrdiff_t n_;
    std::ptrdiff_t dim_;
    std::vector<double> values_;
};

Condition condition(Preset preset, PcmOptions options) {
    return {options, preset == Preset::scaled};
}

Condition condition(Preset preset, FrechetOptions options) {
    return {options, preset != Preset::raw};
}

Condition condition(Preset preset, AreaOptions options) {
    if (preset == Preset::paper) options.spacing = Spacing::x;
    if (preset == Preset::scaled) {
        options.spacing = Spacing::matched;
        options.crossing = Crossing::split;  // for whoever chooses another spacing
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

// Where a Comparison has the value of a measure.
std::optional<double>& place(Comparison& found, const AreaOptions& /*of*/) { return found.area; }
std::optional<double>& place(Comparison& found, const PcmOptions& /*of*/) { return found.pcm; }
double& place(Comparison& found, const FrechetOptions& /*of*/) { return found.frechet; }
double& place(Comparison& found, const DtwOptions& /*of*/) { return found.dtw; }
std::optional<double>& place(Comparison& found, const CurveLengthOptions& /*of*/) {
    return found.curve_length;
}

bool is_optional(const double& /*place*/) noexcept { return false; }
bool is_optional(const std::optional<double>& /*place*/) noexcept { return true; }

}  // namespace

std::vector<Condition> conditions(Preset preset) {
    std::vector<Condition> result;
    for_each_measure([&](const auto& options) { result.push_back(condition(preset, options)); });
    return result;
}

Comparison compare(const CurveView& P, const CurveView& Q, Preset preset, Control* control) {
    std::optional<Scaled> p, q;
    if (preset != Preset::raw) {
        p.emplace(P, P, "P");
        q.emplace(P, Q, "Q");
    }
    Comparison result;
    for (const Condition& given : conditions(preset)) {
        std::visit(
            [&](const auto& options) {
                auto& value = place(result, options);
                if (is_optional(value) && P.dim() != 2) return;
                value = given.scaled ? evaluate(options, p->view(), q->view(), control)
                                     : evaluate(options, P, Q, control);
            },
            given.measure);
    }
    return result;
}

}  // namespace curvewise
