#include "numpy_view.hpp"

namespace curvewise::bindings {
namespace {

CurveArray taken(const py::object& given) {
    if (CurveArray::check_(given)) return py::reinterpret_borrow<CurveArray>(given);
    return {};
}

// An aligned array of one or two dimensions, of that type, in this machine's byte order.
bool is_curve_of(py::handle given, int type_num) noexcept {
    static const PyTypeObject* const type = py::detail::npy_api::get().PyArray_Type_;
    if (Py_TYPE(given.ptr()) != type) return false;
    const py::detail::PyArray_Proxy& array = *py::detail::array_proxy(given.ptr());
    const py::detail::PyArrayDescr_Proxy& descr = *py::detail::array_descriptor_proxy(array.descr);
    const bool is_of_type = descr.type_num == type_num && descr.byteorder == '=';
    const bool is_aligned = (array.flags & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
    return is_of_type && is_aligned && array.nd >= 1 && array.nd <= 2;
}

template <class Number>
CurveView view_of(const py::detail::PyArray_Proxy& array) {
    constexpr auto item = static_cast<py::ssize_t>(sizeof(Number));
    const auto* const data = reinterpret_cast<const Number*>(array.data);
    const py::ssize_t rows = array.dimensions[0], row_stride = array.strides[0] / item;
    if (array.nd == 1) return {data, rows, 1, row_stride, 0};
    // A stride of 0 marks flat lists; the stride of a single column is never used.
    const py::ssize_t columns = array.dimensions[1];
    return {data, rows, columns, row_stride, columns == 1 ? 1 : array.strides[1] / item};
}

}  // namespace

CurveArray::CurveArray(const py::object& given) : py::object(given) {
    if (!check_(given)) throw py::type_error("not a float64 array of one or two dimensions");
}

bool CurveArray::check_(py::handle given) noexcept {
    return is_curve_of(given, py::detail::npy_api::NPY_DOUBLE_);
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
    return view_of<double>(*py::detail::array_proxy(array.ptr()));
}

CurveView listed_view(const py::object& array) {
    if (is_curve_of(array, py::detail::npy_api::NPY_FLOAT_)) {
        return view_of<float>(*py::detail::array_proxy(array.ptr()));
    }
    return view(array.cast<CurveArray>());
}

void ask_about_layout(const CurveArray& P) {
    py::module_::import("curvewise.curves.layouts").attr("ask_about_curves")(P);
}

}  // namespace curvewise::bindings
