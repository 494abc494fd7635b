#include "own_distances.hpp"

#include "curvewise/control.hpp"
#include "interpreter_lock.hpp"

namespace curvewise::bindings {
namespace {

// Whether Python's function answered.
bool is_written(const py::object& blocks, const TableBlock& block, double* out) {
    PyObject* const answer = PyObject_CallFunction(blocks.ptr(), "nnnn", block.first_row,
                                                   block.rows, block.first_column, block.columns);
    if (answer == nullptr) return false;
    const auto array = py::reinterpret_steal<CurveArray>(answer);
    const CurveView distances = view(array);
    for (std::ptrdiff_t i = 0; i < block.rows; ++i) {
        for (std::ptrdiff_t j = 0; j < block.columns; ++j) *out++ = distances(i, j);
    }
    return true;
}

}  // namespace

bool is_own_metric(const py::object& metric) {
    if (PyUnicode_Check(metric.ptr()) || PyBytes_Check(metric.ptr())) return false;
    if (PyList_Check(metric.ptr()) || PyTuple_Check(metric.ptr())) {
        const auto rows = py::reinterpret_borrow<py::sequence>(metric);
        return rows.size() > 0 && !PyUnicode_Check(py::object(rows[0]).ptr());
    }
    return PyCallable_Check(metric.ptr()) != 0 || py::hasattr(metric, "__array__");
}

const BlockDistances* OwnDistances::of(const py::object& metric) {
    const py::object module = py::module_::import("curvewise.curves.own_distance");
    blocks_ = module.attr("block_distances")(metric, P_, Q_);
    function_ = [this](const TableBlock& block, double* out) { write(block, out); };
    return &function_;
}

void OwnDistances::write(const TableBlock& block, double* out) const {
    const bool has_answer = [&] {
        const WithLock lock;
        return or_stand_still([&] { return is_written(blocks_, block, out); });
    }();
    if (!has_answer) throw Stopped();
}

}  // namespace curvewise::bindings
