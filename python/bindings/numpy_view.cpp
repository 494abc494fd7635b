#include "numpy_view.hpp"

#include <limits>

namespace curvewise::bindings {

CurveView view(const CurveArray& array) {
    constexpr auto item = static_cast<py::ssize_t>(sizeof(double));
    const double* const data = array.data();
    if (array.ndim() == 1) return {data, array.shape(0), 1, array.strides(0) / item, 0};
    // A stride of 0 is kept for flat lists; that of a single column is never used.
    const py::ssize_t col_stride = array.shape(1) == 1 ? 1 : array.strides(1) / item;
    return {data, array.shape(0), array.shape(1), array.strides(0) / item, col_stride};
}

bool is_text(const py::object& given, std::string_view text) {
    return PyUnicode_Check(given.ptr()) &&
           PyUnicode_CompareWithASCIIString(given.ptr(), std::string(text).c_str()) == 0;
}

std::ptrdiff_t whole_number(const char* option, const py::object& given, std::ptrdiff_t least,
                            const char* advice) {
    if (PyIndex_Check(given.ptr()) && !PyBool_Check(given.ptr())) {
        // Without an exception type, a number out of range is cut to the range.
        const Py_ssize_t value = PyNumber_AsSsize_t(given.ptr(), nullptr);
        if (!PyErr_Occurred() && value >= least) return value;
        PyErr_Clear();
    }
    throw py::value_error(std::string(option) + " is " + py::repr(given).cast<std::string>() +
                          "; " + advice);
}

bool is_true(const py::object& given) {
    const int truth = PyObject_IsTrue(given.ptr());
    if (truth < 0) throw py::error_already_set();
    return truth == 1;
}

}  // namespace curvewise::bindings
