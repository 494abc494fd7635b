// Between numpy and the library: arrays as views.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>

#include "curvewise/curve.hpp"

namespace curvewise::bindings {

namespace py = pybind11;

// A float64 array of one or two dimensions, aligned; any strides.
using CurveArray = py::array_t<double, 0>;

CurveView view(const CurveArray& array);

// Points as columns make curves, too: x and y of 100 points are two points in 100 dimensions.
inline bool few_points_of_many_coordinates(const CurveView& P, const CurveView& Q) noexcept {
    constexpr std::ptrdiff_t few = 3, many = 10;  // those of curvewise/_curves.py
    return P.dim() > many && P.dim() == Q.dim() && P.size() <= few && Q.size() <= few;
}

// Has Python warn of them.
void warn_if_transposed(const CurveArray& P);

}  // namespace curvewise::bindings
