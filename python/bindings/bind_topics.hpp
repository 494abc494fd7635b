// One function per topic, each adding its part to the module.
#pragma once

#include <pybind11/pybind11.h>

namespace curvewise::bindings {

void bind_tables(pybind11::module_& module);     // dtw and frechet
void bind_planar(pybind11::module_& module);     // area, pcm and curve_length
void bind_pairwise(pybind11::module_& module);   // cdist, pdist and Prepared
void bind_pointwise(pybind11::module_& module);  // sum_of_squares, mse, mae and normalize

}  // namespace curvewise::bindings
