// area, pcm and curve_length, with their quadrilaterals, matches and residuals.
#include <limits>

#include "bind_topics.hpp"
#include "curvewise/area.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/pcm.hpp"
#include "interruptible.hpp"
#include "numpy_view.hpp"
#include "options.hpp"

namespace curvewise::bindings {
namespace {

double points(const CurveArray& P, const CurveArray& Q) {
    return static_cast<double>(P.shape(0) + Q.shape(0));
}

// Nobody knows how many evaluations the search over all offsets takes.
double steps(const CurveArray& P, const CurveArray& Q, const PcmOptions& options) {
    if (options.continuous) return std::numeric_limits<double>::infinity();
    return static_cast<double>(options.offsets) * points(P, Q);
}

py::tuple area_quads_arrays(const CurveArray& P, const CurveArray& Q, const py::object& spacing,
                            const py::object& crossing) {
    const AreaOptions options = area_options(spacing, crossing, py::bool_(false));
    const CurveView a = view(P), b = view(Q);
    const AreaQuads found = interruptible(points(P, Q), py::none(), [&](Control* control) {
        return area_quads(a, b, options, control);
    });
    const auto count = static_cast<py::ssize_t>(found.areas.size());
    return py::make_tuple(
        py::array_t<double>({count, py::ssize_t{4}, py::ssize_t{2}}, found.quads[0][0].data()),
        py::array_t<double>(count, found.areas.data()));
}

py::tuple pcm_match_tuple(const CurveArray& P, const CurveArray& Q, const py::object& offsets) {
    const PcmOptions options = pcm_options(offsets);
    const CurveView a = view(P), b = view(Q);
    const PcmMatch match = interruptible(steps(P, Q, options), py::none(), [&](Control* control) {
        return pcm_match(a, b, options, control);
    });
    const auto count = static_cast<py::ssize_t>(match.points.size());
    return py::make_tuple(
        match.value, match.offset, match.coverage, match.maps_p ? "P" : "Q",
        py::array_t<double>({count, py::ssize_t{2}}, match.points.front().data()));
}

}  // namespace

void bind_planar(py::module_& module) {
    module.def("area", [](const CurveArray& P, const CurveArray& Q, const py::object& spacing,
                          const py::object& crossing, const py::object& squared) {
        const AreaOptions options = area_options(spacing, crossing, squared);
        const CurveView a = view(P), b = view(Q);
        return interruptible(points(P, Q), py::none(),
                             [&](Control* control) { return area(a, b, options, control); });
    });
    module.def("area_quads", area_quads_arrays);
    module.def("pcm", [](const CurveArray& P, const CurveArray& Q, const py::object& offsets) {
        const PcmOptions options = pcm_options(offsets);
        const CurveView a = view(P), b = view(Q);
        return interruptible(steps(P, Q, options), py::none(),
                             [&](Control* control) { return pcm(a, b, options, control); });
    });
    module.def("pcm_match", pcm_match_tuple);
    module.def("curve_length",
               [](const CurveArray& P, const CurveArray& Q, const py::object& scale) {
                   const CurveLengthOptions options = curve_length_options(scale);
                   const CurveView a = view(P), b = view(Q);
                   return interruptible(points(P, Q), py::none(), [&](Control* control) {
                       return curve_length(a, b, options, control);
                   });
               });
    module.def("curve_length_residuals",
               [](const CurveArray& P, const CurveArray& Q, const py::object& scale) {
                   const CurveLengthOptions options = curve_length_options(scale);
                   py::array_t<double> out({P.shape(0), py::ssize_t{2}});
                   double* const data = out.mutable_data();
                   const CurveView a = view(P), b = view(Q);
                   interruptible(points(P, Q), py::none(), [&](Control* control) {
                       curve_length_residuals(a, b, data, options, control);
                   });
                   return out;
               });
}

}  // namespace curvewise::bindings
