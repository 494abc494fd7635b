// Measures without options, and functions of one curve.
#include <cstdint>
#include <vector>

#include "bind_topics.hpp"
#include "curvewise/pointwise.hpp"
#include "curvewise/simplify.hpp"
#include "interruptible.hpp"
#include "numpy_view.hpp"

namespace curvewise::bindings {
namespace {

double entries(const CurveArray& curve) { return static_cast<double>(curve.size()); }

// The indices of the points that are kept.
py::array_t<std::int64_t> kept_rows(const CurveArray& curve, double tolerance, bool by_frechet) {
    const EdgeMeasure measure = by_frechet ? EdgeMeasure::frechet : EdgeMeasure::hausdorff;
    const CurveView points = view(curve);
    const double n = entries(curve);
    const std::vector<std::int64_t> rows = interruptible(n * n, py::none(), [&](Control* control) {
        return simplify(points, tolerance, measure, control);
    });
    return py::array_t<std::int64_t>(static_cast<py::ssize_t>(rows.size()), rows.data());
}

}  // namespace

void bind_pointwise(py::module_& module) {
    using Measure = double (*)(const CurveView&, const CurveView&, Control*);
    const auto bind = [&](const char* name, Measure measure) {
        module.def(name, [measure](const py::object& P, const py::object& Q) {
            const CurvePair pair(P, Q);
            const CurveView a = view(pair.P), b = view(pair.Q);
            return interruptible(entries(pair.P) + entries(pair.Q), py::none(),
                                 [&](Control* control) { return measure(a, b, control); });
        });
    };
    bind("sum_of_squares", sum_of_squares);
    bind("mse", mse);
    bind("mae", mae);
    module.def("simplify", kept_rows);
    module.def("normalize", [](const CurveArray& P, const CurveArray& C, const char* name) {
        py::array_t<double> out(std::vector<py::ssize_t>(C.shape(), C.shape() + C.ndim()));
        const CurveView p = view(P), c = view(C);
        double* const data = out.mutable_data();
        interruptible(entries(P) + entries(C), py::none(),
                      [&](Control* control) { normalize(p, c, data, name, control); });
        return out;
    });
}

}  // namespace curvewise::bindings
