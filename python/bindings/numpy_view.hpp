// Between numpy and the library: arrays as views.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "curvewise/curve.hpp"

namespace curvewise::bindings {

namespace py = pybind11;

// A float64 array of one or two dimensions, aligned; any strides.
using CurveArray = py::array_t<double, 0>;

CurveView view(const CurveArray& array);

}  // namespace curvewise::bindings
