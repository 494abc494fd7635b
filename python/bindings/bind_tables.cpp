// dtw and frechet: distances, paths and tables.
#include "bind_topics.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "numpy_view.hpp"

namespace curvewise::bindings {
namespace {

double cells(const CurveArray& P, const CurveArray& Q) {
    return static_cast<double>(P.shape(0)) * static_cast<double>(Q.shape(0));
}

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

py::tuple as_tuple(const Alignment& alignment) {
    const auto length = static_cast<py::ssize_t>(alignment.path.size());
    return py::make_tuple(
        alignment.distance,
        py::array_t<std::int64_t>({length, py::ssize_t{2}}, alignment.path.front().data()));
}

py::array_t<double> allocate_table(const CurveArray& P, const CurveArray& Q) {
    try {
        return py::array_t<double>({P.shape(0), Q.shape(0)});
    } catch (const py::error_already_set&) {  // numpy names the size in units of its choice
        const double size = cells(P, Q) * sizeof(double) / (1024.0 * 1024.0 * 1024.0);
        PyErr_Format(PyExc_MemoryError, "no memory for a table of shape (%zd, %zd), %s GiB",
                     P.shape(0), Q.shape(0),
                     py::str("{:.3g}").format(size).cast<std::string>().c_str());
        throw py::error_already_set();
    }
}

template <class Fill>
py::array_t<double> table(const CurveArray& P, const CurveArray& Q, Fill fill) {
    py::array_t<double> out = allocate_table(P, Q);
    double* const data = out.mutable_data();
    unlocked(cells(P, Q), [&] { fill(data); });
    return out;
}

void bind_dtw(py::module_& module) {
    module.def("dtw", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                         const py::object& p, const py::object& step_pattern,
                         const py::object& window, const py::object& open_begin,
                         const py::object& open_end, const py::object& workers) {
        const auto options =
            dtw_options(metric, p, step_pattern, window, open_begin, open_end, workers);
        const CurveView a = view(P), b = view(Q);
        return unlocked(cells(P, Q), [&] { return dtw(a, b, options); });
    });
    module.def("dtw_path", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                              const py::object& p, const py::object& step_pattern,
                              const py::object& window, const py::object& open_begin,
                              const py::object& open_end, const py::object& workers) {
        const auto options =
            dtw_options(metric, p, step_pattern, window, open_begin, open_end, workers);
        const CurveView a = view(P), b = view(Q);
        return as_tuple(unlocked(cells(P, Q), [&] { return dtw_path(a, b, options); }));
    });
    module.def("dtw_table", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                               const py::object& p, const py::object& step_pattern,
                               const py::object& window, const py::object& open_begin,
                               const py::object& open_end) {
        const auto options =
            dtw_options(metric, p, step_pattern, window, open_begin, open_end, py::int_(1));
        return table(P, Q, [&](double* out) { dtw_table(view(P), view(Q), out, options); });
    });
}

void bind_frechet(py::module_& module) {
    module.def("frechet", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                             const py::object& p, const py::object& workers) {
        const FrechetOptions options = frechet_options(metric, p, workers);
        const CurveView a = view(P), b = view(Q);
        return unlocked(cells(P, Q), [&] { return frechet(a, b, options); });
    });
    module.def(
        "frechet_path", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                           const py::object& p, const py::object& workers) {
            const FrechetOptions options = frechet_options(metric, p, workers);
            const CurveView a = view(P), b = view(Q);
            return as_tuple(unlocked(cells(P, Q), [&] { return frechet_path(a, b, options); }));
        });
    module.def("frechet_table", [](const CurveArray& P, const CurveArray& Q,
                                   const py::object& metric, const py::object& p) {
        const FrechetOptions options = frechet_options(metric, p, py::int_(1));
        return table(P, Q, [&](double* out) { frechet_table(view(P), view(Q), out, options); });
    });
}

}  // namespace

void bind_tables(py::module_& module) {
    bind_dtw(module);
    bind_frechet(module);
}

}  // namespace curvewise::bindings
