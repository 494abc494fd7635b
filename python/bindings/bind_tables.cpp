// dtw and frechet: distances, paths and tables.
#include "bind_topics.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "interruptible.hpp"
#include "numpy_view.hpp"
#include "options.hpp"

namespace curvewise::bindings {
namespace {

double cells(const CurveArray& P, const CurveArray& Q) {
    return static_cast<double>(P.shape(0)) * static_cast<double>(Q.shape(0));
}

// Steps of a sweep: a cell costs more the more coordinates there are.
double steps(const CurveArray& P, const CurveArray& Q) {
    return static_cast<double>(P.size()) * static_cast<double>(Q.shape(0));
}

// As long as the table's sweep may take.
template <class Function>
auto sweep_unlocked(const CurveArray& P, const CurveArray& Q, Function function) {
    return interruptible(steps(P, Q), py::none(), function);
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
    sweep_unlocked(P, Q, [&](Control* control) { fill(data, control); });
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
        return sweep_unlocked(P, Q, [&](Control* control) { return dtw(a, b, options, control); });
    });
    module.def("dtw_path", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                              const py::object& p, const py::object& step_pattern,
                              const py::object& window, const py::object& open_begin,
                              const py::object& open_end, const py::object& workers) {
        const auto options =
            dtw_options(metric, p, step_pattern, window, open_begin, open_end, workers);
        const CurveView a = view(P), b = view(Q);
        return as_tuple(sweep_unlocked(
            P, Q, [&](Control* control) { return dtw_path(a, b, options, control); }));
    });
    module.def("dtw_table", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                               const py::object& p, const py::object& step_pattern,
                               const py::object& window, const py::object& open_begin,
                               const py::object& open_end) {
        const auto options =
            dtw_options(metric, p, step_pattern, window, open_begin, open_end, py::int_(1));
        return table(P, Q, [&](double* out, Control* control) {
            dtw_table(view(P), view(Q), out, options, control);
        });
    });
}

void bind_frechet(py::module_& module) {
    module.def("frechet", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                             const py::object& p, const py::object& workers) {
        const FrechetOptions options = frechet_options(metric, p, workers);
        const CurveView a = view(P), b = view(Q);
        return sweep_unlocked(P, Q,
                              [&](Control* control) { return frechet(a, b, options, control); });
    });
    module.def(
        "frechet_path", [](const CurveArray& P, const CurveArray& Q, const py::object& metric,
                           const py::object& p, const py::object& workers) {
            const FrechetOptions options = frechet_options(metric, p, workers);
            const CurveView a = view(P), b = view(Q);
            return as_tuple(sweep_unlocked(
                P, Q, [&](Control* control) { return frechet_path(a, b, options, control); }));
        });
    module.def("frechet_table", [](const CurveArray& P, const CurveArray& Q,
                                   const py::object& metric, const py::object& p) {
        const FrechetOptions options = frechet_options(metric, p, py::int_(1));
        return table(P, Q, [&](double* out, Control* control) {
            frechet_table(view(P), view(Q), out, options, control);
        });
    });
}

}  // namespace

void bind_tables(py::module_& module) {
    bind_dtw(module);
    bind_frechet(module);
}

}  // namespace curvewise::bindings
