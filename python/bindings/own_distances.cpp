#include "own_distances.hpp"

#include "curvewise/control.hpp"
#include "interpreter_lock.hpp"

namespace curvewise::bindings {
namespace {

py::module_ answers() { return py::module_::import("curvewise.curves.own_distance"); }

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
    return answers().attr("is_own_metric")(metric).cast<bool>();
}

const BlockDistances* OwnDistances::of(const py::object& metric) {
    blocks_ = answers().attr("block_distances")(metric, P_, Q_);
    function_ = BlockDistances([this](const TableBlock& block, double* out) { write(block, out); });
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
