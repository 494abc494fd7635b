#include "numpy_view.hpp"

namespace curvewise::bindings {
namespace {

CurveArray taken(const py::object& given) {
    if (CurveArray::check_(given)) return py::reinterpret_borrow<CurveArray>(given);
    return {};
}

}  // namespace

CurveArray::CurveArray(const py::object& given) : py::object(given) {
    if (!check_(given)) throw py::type_error("not a float64 array of one or two dimensions");
}

bool CurveArray::check_(py::handle given) noexcept {
    static const PyTypeObject* const type = py::detail::npy_api::get().PyArray_Type_;
    if (Py_TYPE(given.ptr()) != type) return false;
    const py::detail::PyArray_Proxy& array = *py::detail::array_proxy(given.ptr());
    const py::detail::PyArrayDescr_Proxy& descr = *py::detail::array_descriptor_proxy(array.descr);
    const bool is_float64 =
        descr.type_num == py::detail::npy_api::NPY_DOUBLE_ && descr.byteorder == '=';
    const bool is_aligned = (array.flags & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
    return is_float64 && is_aligned && array.nd >= 1 && array.nd <= 2;
}

CurvePair::CurvePair(const py::object& given_p, const py::object& given_q)
    : P(taken(given_p)), Q(taken(given_q)) {
    if (P && Q) return;
    const py::object inputs = py::module_::import("curvewise.curves.inputs");
    const py::tuple curves = inputs.attr("as_curves")(given_p, given_q);
    P = curves[0].cast<CurveArray>();
    Q = curves[1].cast<CurveArray>();
}

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
