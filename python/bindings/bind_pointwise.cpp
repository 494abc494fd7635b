// Measures of curves of equal shape, and the scaling by P's box.
#include "bind_topics.hpp"
#include "curvewise/pointwise.hpp"
#include "interruptible.hpp"
#include "numpy_view.hpp"

namespace curvewise::bindings {

void bind_pointwise(py::module_& module) {
    const auto bind = [&](const char* name, double (*measure)(const CurveView&, const CurveView&)) {
        module.def(name, [measure](const CurveArray& P, const CurveArray& Q) {
            const CurveView a = view(P), b = view(Q);
            return unlocked(static_cast<double>(P.size()), [&] { return measure(a, b); });
        });
    };
    bind("sum_of_squares", sum_of_squares);
    bind("mse", mse);
    bind("mae", mae);
    module.def("normalize", [](const CurveArray& P, const CurveArray& C, const char* name) {
        py::array_t<double> out(std::vector<py::ssize_t>(C.shape(), C.shape() + C.ndim()));
        normalize(view(P), view(C), out.mutable_data(), name);
        return out;
    });
}

}  // namespace curvewise::bindings
