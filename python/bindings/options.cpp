#include "options.hpp"

#include "numpy_view.hpp"

namespace curvewise::bindings {
namespace {

GroundDistance ground_distance(const py::object& metric, const py::object& p) {
    const auto chosen = choose<Metric>("metric", metric,
                                       {{"euclidean", Metric::euclidean},
                                        {"sqeuclidean", Metric::sqeuclidean},
                                        {"cityblock", Metric::cityblock},
                                        {"chebyshev", Metric::chebyshev},
                                        {"minkowski", Metric::minkowski}});
    if (p.is_none()) return {chosen, 2.0};
    if (chosen != Metric::minkowski) {
        throw py::value_error("p applies to metric='minkowski' only, not to " +
                              py::repr(metric).cast<std::string>());
    }
    const double order = PyFloat_AsDouble(p.ptr());
    if (PyErr_Occurred() || !(order >= 1.0)) {
        PyErr_Clear();
        throw py::value_error("p is " + py::repr(p).cast<std::string>() +
                              "; minkowski needs 1 <= p <= inf");
    }
    return {chosen, order};
}

}  // namespace

std::ptrdiff_t thread_count(const py::object& workers) {
    return whole_number("workers", workers, -1, "give a whole number >= 1, or -1 for all cores");
}

FrechetOptions frechet_options(const py::object& metric, const py::object& p,
                               const py::object& workers) {
    return {ground_distance(metric, p), thread_count(workers)};
}

DtwOptions dtw_options(const py::object& metric, const py::object& p,
                       const py::object& step_pattern, const py::object& window,
                       const py::object& open_begin, const py::object& open_end,
                       const py::object& workers) {
    DtwOptions options;
    options.ground = ground_distance(metric, p);
    options.step_pattern = choose<StepPattern>(
        "step_pattern", step_pattern,
        {{"symmetric1", StepPattern::symmetric1}, {"symmetric2", StepPattern::symmetric2}});
    if (!window.is_none()) {
        options.window = whole_number("window", window, 0, "give a whole number >= 0, or None");
    }
    options.open_begin = is_true(open_begin);
    options.open_end = is_true(open_end);
    options.workers = thread_count(workers);
    return options;
}

AreaOptions area_options(const py::object& spacing, const py::object& crossing,
                         const py::object& squared) {
    return {choose<Spacing>("spacing", spacing,
                            {{"distance", Spacing::distance},
                             {"x", Spacing::x},
                             {"arc_length", Spacing::arc_length}}),
            choose<Crossing>("crossing", crossing,
                             {{"rearrange", Crossing::rearrange}, {"split", Crossing::split}}),
            is_true(squared)};
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

Measure measure(const py::object& name, const py::tuple& options) {
    if (is_text(name, "dtw")) {
        return dtw_options(options[0], options[1], options[2], options[3], options[4], options[5],
                           py::int_(1));
    }
    if (is_text(name, "frechet")) return frechet_options(options[0], options[1], py::int_(1));
    if (is_text(name, "area")) return area_options(options[0], options[1], options[2]);
    if (is_text(name, "pcm")) return pcm_options(options[0]);
    return curve_length_options(options[0]);
}

}  // namespace curvewise::bindings
