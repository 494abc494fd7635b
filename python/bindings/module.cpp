// curvewise._core: the compiled library for the Python package, which gives it checked float64
// arrays and the options in a dict. Documented in the package curvewise.measures.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "bind_topics.hpp"
#include "curvewise/build_info.hpp"
#include "curvewise/ground_distance.hpp"

// Global state is set only once, so the module is safe without the interpreter's lock.
PYBIND11_MODULE(_core, module, pybind11::mod_gil_not_used()) {
    try {
        curvewise::build_info();  // chooses the instruction set
    } catch (const std::runtime_error& error) {
        throw pybind11::import_error(error.what());
    }
    module.doc() = "The compiled library behind curvewise; private.";
    module.attr("earth_radius") = curvewise::earth_radius;
    curvewise::bindings::bind_options(module);
    curvewise::bindings::bind_measures(module);
    curvewise::bindings::bind_pointwise(module);
    curvewise::bindings::bind_pairwise(module);
    curvewise::bindings::bind_nearest(module);
    curvewise::bindings::bind_materials(module);
    module.def("build_info", [] {
        const curvewise::BuildInfo info = curvewise::build_info();
        pybind11::dict result;
        result["version"] = info.version;
        result["compiler"] = info.compiler;
        result["eigen"] = info.eigen;
        result["pybind11"] = std::to_string(PYBIND11_VERSION_MAJOR) + "." +
                             std::to_string(PYBIND11_VERSION_MINOR) + "." +
                             std::to_string(PYBIND11_VERSION_MICRO);
        result["instruction_sets"] = info.instruction_sets;
        result["active"] = info.active;
        return result;
    });
}
