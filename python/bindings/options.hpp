// From Python's options, by position, to the library's. Errors are ValueErrors that list what is
// valid.
#pragma once

#include <pybind11/pybind11.h>

#include "curvewise/area.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/frechet.hpp"
#include "curvewise/pairwise.hpp"
#include "curvewise/pcm.hpp"

namespace curvewise::bindings {

namespace py = pybind11;

FrechetOptions frechet_options(const py::object& metric, const py::object& p,
                               const py::object& workers);
DtwOptions dtw_options(const py::object& metric, const py::object& p,
                       const py::object& step_pattern, const py::object& window,
                       const py::object& open_begin, const py::object& open_end,
                       const py::object& workers);
AreaOptions area_options(const py::object& spacing, const py::object& crossing,
                         const py::object& squared);
PcmOptions pcm_options(const py::object& offsets);
CurveLengthOptions curve_length_options(const py::object& scale);

std::ptrdiff_t thread_count(const py::object& workers);

// One of the five by its name, with its own options in the order of its Python function.
Measure measure(const py::object& name, const py::tuple& options);

}  // namespace curvewise::bindings
