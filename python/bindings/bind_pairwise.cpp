// Batches: lists of curves against each other, and a prepared curve against others.
#include <vector>

#include "bind_topics.hpp"
#include "curvewise/pairwise.hpp"
#include "interruptible.hpp"
#include "numpy_view.hpp"
#include "options.hpp"

namespace curvewise::bindings {
namespace {

// The arrays that a list of curves looks at, and the views.
struct Curves {
    explicit Curves(const py::list& list) {
        arrays.reserve(list.size());
        views.reserve(list.size());
        for (const py::handle& item : list) {
            arrays.push_back(item.cast<CurveArray>());
            views.push_back(view(arrays.back()));
        }
    }

    double points() const noexcept {
        double sum = 0.0;
        for (const CurveArray& array : arrays) sum += static_cast<double>(array.size());
        return sum;
    }

    std::vector<CurveArray> arrays;
    std::vector<CurveView> views;
};

using Out = py::array_t<double, py::array::c_style>;

BatchOptions batch_options(const py::object& workers, double cutoff) {
    return {thread_count(workers), cutoff};
}

// An upper bound of the steps ahead.
double steps(const Curves& a, const Curves& b) { return 100.0 + a.points() * b.points(); }

void cdist_into(const py::list& XA, const py::object& XB, const py::object& name,
                const py::tuple& options, Out out, const py::object& workers, double cutoff,
                const py::object& progress) {
    const Measure chosen = measure(name, options);
    const BatchOptions batch = batch_options(workers, cutoff);
    const Curves a(XA);
    double* const data = out.mutable_data();
    if (XB.is_none()) {
        interruptible(steps(a, a), progress,
                      [&](Control* control) { cdist(a.views, chosen, data, batch, control); });
        return;
    }
    const Curves b(XB.cast<py::list>());
    interruptible(steps(a, b), progress,
                  [&](Control* control) { cdist(a.views, b.views, chosen, data, batch, control); });
}

void pdist_into(const py::list& X, const py::object& name, const py::tuple& options, Out out,
                const py::object& workers, double cutoff, const py::object& progress) {
    const Measure chosen = measure(name, options);
    const BatchOptions batch = batch_options(workers, cutoff);
    const Curves curves(X);
    double* const data = out.mutable_data();
    interruptible(steps(curves, curves), progress,
                  [&](Control* control) { pdist(curves.views, chosen, data, batch, control); });
}

double prepared_value(const Prepared& prepared, const CurveArray& Q) {
    const CurveView q = view(Q);
    return interruptible(static_cast<double>(Q.size()) * 1e3, py::none(),
                         [&](Control* control) { return prepared(q, control); });
}

py::array_t<double> prepared_values(const Prepared& prepared, const py::list& Qs,
                                    const py::object& workers) {
    const BatchOptions batch = batch_options(workers, BatchOptions{}.cutoff);
    const Curves curves(Qs);
    py::array_t<double> out(static_cast<py::ssize_t>(curves.views.size()));
    double* const data = out.mutable_data();
    interruptible(curves.points() * 1e3, py::none(),
                  [&](Control* control) { prepared(curves.views, data, batch, control); });
    return out;
}

}  // namespace

void bind_pairwise(py::module_& module) {
    module.def("cdist", cdist_into);
    module.def("pdist", pdist_into);
    module.def("is_symmetric", [](const py::object& name, const py::tuple& options) {
        return is_symmetric(measure(name, options));
    });
    py::class_<Prepared>(module, "Prepared")
        .def(py::init([](const CurveArray& P, const py::object& name, const py::tuple& options) {
            return Prepared(view(P), measure(name, options));
        }))
        .def("value", prepared_value)
        .def("values", prepared_values);
}

}  // namespace curvewise::bindings
