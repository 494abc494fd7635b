// One function per topic, each adding its part to the module.
#pragma once

#include <pybind11/pybind11.h>

namespace curvewise::bindings {

void bind_materials(pybind11::module_& module);  // points of material
void bind_measures(pybind11::module_& module);   // of one pair
void bind_nearest(pybind11::module_& module);    // Index
void bind_options(pybind11::module_& module);    // their names, defaults and choices
void bind_pairwise(pybind11::module_& module);   // cdist, pdist and Prepared
void bind_pointwise(pybind11::module_& module);  // sum_of_squares, mse, mae and normalize

}  // namespace curvewise::bindings
