// Presets: for each measure, whether its curves are scaled and which of its options are not the
// default.
#include "curvewise/compare.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "curvewise/area.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "curvewise/pcm.hpp"
#include "curvewise/pointwise.hpp"

namespace curvewise {
namespace {

struct Conditions {
    bool scales_planar;  // area, pcm and curve_length on scaled curves
    bool scales_tables;  // frechet and dtw
    AreaOptions area;
    DtwOptions dtw;
    CurveLengthOptions curve_length;
};

Conditions conditions(Preset preset) {
    Conditions result{};
    result.scales_planar = preset == Preset::scaled;
    result.scales_tables = preset != Preset::raw;
    if (preset == Preset::scaled) {
        result.area.crossing = Crossing::split;
        result.curve_length.scale = LengthScale::mean_abs;
    }
    if (preset == Preset::paper) {
        result.area.spacing = Spacing::x;
        result.dtw.step_pattern = StepPattern::symmetric2;
    }
    return result;
}

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

}  // namespace

Comparison compare(const CurveView& P, const CurveView& Q, Preset preset, Control* control) {
    const Conditions given = conditions(preset);
    std::optional<Scaled> p, q;
    if (preset != Preset::raw) {
        p.emplace(P, P, "P");
        q.emplace(P, Q, "Q");
    }
    const CurveView P1 = given.scales_planar ? p->view() : P;
    const CurveView Q1 = given.scales_planar ? q->view() : Q;
    const CurveView P2 = given.scales_tables ? p->view() : P;
    const CurveView Q2 = given.scales_tables ? q->view() : Q;
    Comparison result;
    if (P.dim() == 2) {
        result.area = area(P1, Q1, given.area, control);
        result.pcm = pcm(P1, Q1, {}, control);
    }
    result.frechet = frechet(P2, Q2, {}, control);
    result.dtw = dtw(P2, Q2, given.dtw, control);
    if (P.dim() == 2) result.curve_length = curve_length(P1, Q1, given.curve_length, control);
    return result;
}

}  // namespace curvewise
