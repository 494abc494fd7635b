// Between numpy and the library: arrays as views.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>

#include "curvewise/curve.hpp"

namespace curvewise::bindings {

namespace py = pybind11;

// A float64 array of one or two dimensions, aligned; any strides. Other objects are not converted
// to it, and numpy is not called.
class CurveArray : public py::object {
   public:
    using py::object::object;
    explicit CurveArray(const py::object& given);
    static bool check_(py::handle given) noexcept;

    const double* data() const { return reinterpret_cast<const double*>(array().data); }
    py::ssize_t ndim() const { return array().nd; }
    const py::ssize_t* shape() const { return array().dimensions; }
    py::ssize_t shape(int axis) const { return array().dimensions[axis]; }
    py::ssize_t strides(int axis) const { return array().strides[axis]; }
    py::ssize_t size() const { return ndim() == 1 ? shape(0) : shape(0) * shape(1); }

   private:
    const py::detail::PyArray_Proxy& array() const { return *py::detail::array_proxy(ptr()); }
};

CurveView view(const CurveArray& array);

// A view of one curve of a list, which may also be of float32, and is not converted either.
CurveView listed_view(const py::object& array);

// Two curves in the forms that a user passes. The package's as_curves() converts an object that is
// not a CurveArray, or rejects it.
struct CurvePair {
    CurvePair(const py::object& P, const py::object& Q);
    CurveArray P;
    CurveArray Q;
};

// More coordinates than points: x and y of 100 points, as rows, are two points in 100 dimensions.
inline bool is_layout_in_doubt(const CurveView& P, const CurveView& Q) noexcept {
    return P.dim() > P.size() && P.size() == Q.size() && P.dim() == Q.dim();
}

// Has Python warn of it.
void ask_about_layout(const CurveArray& P);

}  // namespace curvewise::bindings
