// area, pcm and curve_length, with their quadrilaterals, matches and residuals.
#include "bind_topics.hpp"
#include "curvewise/area.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/pcm.hpp"
#include "numpy_view.hpp"

namespace curvewise::bindings {
namespace {

double points(const CurveArray& P, const CurveArray& Q) {
    return static_cast<double>(P.shape(0) + Q.shape(0));
}

AreaOptions area_options(const py::object& spacing, const py::object& crossing, bool squared) {
    return {choose<Spacing>("spacing", spacing,
                            {{"distance", Spacing::distance},
                             {"x", Spacing::x},
                             {"arc_length", Spacing::arc_length}}),
            choose<Crossing>("crossing", crossing,
                             {{"rearrange", Crossing::rearrange}, {"split", Crossing::split}}),
            squared};
}

PcmOptions pcm_options(const py::object& offsets) {
    if (is_text(offsets, "continuous")) return {200, true};
    return {whole_number("offsets", offsets, 1, "give a whole number >= 1, or 'continuous'"),
            false};
}

CurveLengthOptions curve_length_options(const py::object& scale) {
    return {choose<LengthScale>("scale", scale,
                                {{"mean", LengthScale::mean},
                                 {"mean_abs", LengthScale::mean_abs},
                                 {"range", LengthScale::range}})};
}

py::tuple area_quads_arrays(const CurveArray& P, const CurveArray& Q, const py::object& spacing,
                            const py::object& crossing) {
    const AreaOptions options = area_options(spacing, crossing, false);
    const CurveView a = view(P), b = view(Q);
    const AreaQuads found = unlocked(points(P, Q), [&] { return area_quads(a, b, options); });
    const auto count = static_cast<py::ssize_t>(found.areas.size());
    return py::make_tuple(
        py::array_t<double>({count, py::ssize_t{4}, py::ssize_t{2}}, found.quads[0][0].data()),
        py::array_t<double>(count, found.areas.data()));
}

py::tuple pcm_match_tuple(const CurveArray& P, const CurveArray& Q, const py::object& offsets) {
    const PcmOptions options = pcm_options(offsets);
    const CurveView a = view(P), b = view(Q);
    const PcmMatch match = unlocked(200.0 * points(P, Q), [&] { return pcm_match(a, b, options); });
    const auto count = static_cast<py::ssize_t>(match.points.size());
    return py::make_tuple(
        match.value, match.offset, match.coverage, match.maps_p ? "P" : "Q",
        py::array_t<double>({count, py::ssize_t{2}}, match.points.front().data()));
}

}  // namespace

void bind_planar(py::module_& module) {
    module.def("area", [](const CurveArray& P, const CurveArray& Q, const py::object& spacing,
                          const py::object& crossing, const py::object& squared) {
        const AreaOptions options = area_options(spacing, crossing, is_true(squared));
        const CurveView a = view(P), b = view(Q);
        return unlocked(points(P, Q), [&] { return area(a, b, options); });
    });
    module.def("area_quads", area_quads_arrays);
    module.def("pcm", [](const CurveArray& P, const CurveArray& Q, const py::object& offsets) {
        const PcmOptions options = pcm_options(offsets);
        const CurveView a = view(P), b = view(Q);
        return unlocked(200.0 * points(P, Q), [&] { return pcm(a, b, options); });
    });
    module.def("pcm_match", pcm_match_tuple);
    module.def("curve_length",
               [](const CurveArray& P, const CurveArray& Q, const py::object& scale) {
                   const CurveLengthOptions options = curve_length_options(scale);
                   const CurveView a = view(P), b = view(Q);
                   return unlocked(points(P, Q), [&] { return curve_length(a, b, options); });
               });
    module.def("curve_length_residuals",
               [](const CurveArray& P, const CurveArray& Q, const py::object& scale) {
                   const CurveLengthOptions options = curve_length_options(scale);
                   py::array_t<double> out({P.shape(0), py::ssize_t{2}});
                   double* const data = out.mutable_data();
                   const CurveView a = view(P), b = view(Q);
                   unlocked(points(P, Q), [&] { curve_length_residuals(a, b, data, options); });
                   return out;
               });
}

}  // namespace curvewise::bindings
