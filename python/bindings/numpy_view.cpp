#include "numpy_view.hpp"

namespace curvewise::bindings {

CurveView view(const CurveArray& array) {
    constexpr auto item = static_cast<py::ssize_t>(sizeof(double));
    const double* const data = array.data();
    if (array.ndim() == 1) return {data, array.shape(0), 1, array.strides(0) / item, 0};
    // A stride of 0 is kept for flat lists; that of a single column is never used.
    const py::ssize_t col_stride = array.shape(1) == 1 ? 1 : array.strides(1) / item;
    return {data, array.shape(0), array.shape(1), array.strides(0) / item, col_stride};
}

void warn_if_transposed(const CurveArray& P) {
    py::module_::import("curvewise.curves.inputs").attr("warn_if_transposed")(P, "P");
}

}  // namespace curvewise::bindings
