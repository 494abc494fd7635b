// Batches: lists of curves against each other, and a prepared curve against others.
#include <algorithm>
#include <variant>
#include <vector>

#include "bind_topics.hpp"
#include "curve_list.hpp"
#include "curvewise/pairwise.hpp"
#include "interruptible.hpp"
#include "options.hpp"

namespace curvewise::bindings {
namespace {

using Out = py::array_t<double, py::array::c_style>;

BatchOptions batch_options(const py::object& workers, double cutoff) {
    return {whole_number("workers", workers, workers_range), cutoff};
}

// An upper bound of the elementary steps ahead: checks and preparation, and the pairs.
double work(const Measure& measure, const Curves& a, const Curves& b) {
    return std::visit(
        [&](const auto& options) {
            return 100.0 + a.entries() + b.entries() +
                   a.size() * b.size() * options.work(a.longest(), b.longest(), a.dim());
        },
        measure);
}

void cdist_into(const py::list& XA, const py::object& XB, const py::object& name,
                const py::dict& options, Out out, const py::object& workers, double cutoff,
                const py::object& progress) {
    const Measure chosen = read_measure(name, options);
    const BatchOptions batch = batch_options(workers, cutoff);
    const Curves a(XA);
    double* const data = out.mutable_data();
    if (XB.is_none()) {
        interruptible(work(chosen, a, a), progress,
                      [&](Control* control) { cdist(a.views, chosen, data, batch, control); });
        return;
    }
    const Curves b(XB.cast<py::list>());
    interruptible(work(chosen, a, b), progress,
                  [&](Control* control) { cdist(a.views, b.views, chosen, data, batch, control); });
}

void check_batch_of(const py::list& XA, const py::object& XB, const py::object& name,
                    const py::dict& options) {
    const Measure chosen = read_measure(name, options);
    const Curves a(XA);
    if (XB.is_none()) {
        interruptible(a.entries(), py::none(),
                      [&](Control* control) { check_batch(a.views, chosen, control); });
        return;
    }
    const Curves b(XB.cast<py::list>());
    interruptible(a.entries() + b.entries(), py::none(),
                  [&](Control* control) { check_batch(a.views, b.views, chosen, control); });
}

void pdist_into(const py::list& X, const py::object& name, const py::dict& options, Out out,
                const py::object& workers, double cutoff, const py::object& progress) {
    const Measure chosen = read_measure(name, options);
    const BatchOptions batch = batch_options(workers, cutoff);
    const Curves curves(X);
    double* const data = out.mutable_data();
    interruptible(work(chosen, curves, curves), progress,
                  [&](Control* control) { pdist(curves.views, chosen, data, batch, control); });
}

// A prepared curve, with the data for the estimate of a call's work.
class PreparedCurve {
   public:
    PreparedCurve(const CurveArray& P, const py::object& name, const py::dict& options)
        : measure_(read_measure(name, options)), n_(P.shape(0)), prepared_(prepare(P)) {}

    double value(const CurveArray& Q) const {
        const CurveView q = view(Q);
        return interruptible(work(q), py::none(),
                             [&](Control* control) { return prepared_(q, control); });
    }
    double value_within(const CurveArray& Q, double cutoff) const {
        const CurveView q = view(Q);
        BatchOptions batch;
        batch.cutoff = cutoff;
        return interruptible(work(q), py::none(),
                             [&](Control* control) { return prepared_(q, batch, control); });
    }

    py::array_t<double> values(const py::list& Qs, const py::object& workers, double cutoff) const {
        const BatchOptions batch = batch_options(workers, cutoff);
        const Curves curves(Qs);
        py::array_t<double> out(static_cast<py::ssize_t>(curves.views.size()));
        double* const data = out.mutable_data();
        interruptible(work(curves.size(), curves.longest(), curves.dim()), py::none(),
                      [&](Control* control) { prepared_(curves.views, data, batch, control); });
        return out;
    }

   private:
    Prepared prepare(const CurveArray& P) const {
        const CurveView p = view(P);
        // Read, copied, and measured.
        const double steps = 4.0 * static_cast<double>(P.size());
        return interruptible(steps, py::none(),
                             [&](Control* control) { return Prepared(p, measure_, control); });
    }

    double work(const CurveView& q) const {
        return work(1.0, static_cast<double>(q.size()), static_cast<double>(q.dim()));
    }
    double work(double count, double m, double dim) const {
        const double n = static_cast<double>(n_);
        return std::visit(
            [&](const auto& options) { return count * (m * dim + options.work(n, m, dim)); },
            measure_);
    }

    Measure measure_;
    py::ssize_t n_;
    Prepared prepared_;
};

}  // namespace

void bind_pairwise(py::module_& module) {
    module.def("cdist", cdist_into);
    module.def("check_batch", check_batch_of);
    module.def("pdist", pdist_into);
    module.def("is_symmetric", [](const py::object& name, const py::dict& options) {
        return is_symmetric(read_measure(name, options));
    });
    py::class_<PreparedCurve>(module, "Prepared")
        .def(py::init<const CurveArray&, const py::object&, const py::dict&>())
        .def("value", &PreparedCurve::value)
        .def("value_within", &PreparedCurve::value_within)
        .def("values", &PreparedCurve::values);
}

}  // namespace curvewise::bindings
