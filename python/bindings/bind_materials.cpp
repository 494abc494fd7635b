// Points of material. A text names the material with its options, as material_from() reads it.
#include <pybind11/stl.h>

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bind_topics.hpp"
#include "curvewise/materials.hpp"
#include "interruptible.hpp"
#include "numpy_view.hpp"

namespace curvewise::bindings {
namespace {

using RowMajor = py::array_t<double, py::array::c_style>;

// Writes the options of a material to a dict, by name.
class MaterialWriter {
   public:
    explicit MaterialWriter(py::dict& found) noexcept : found_(found) {}

    template <class Value>
    void operator()(const char* name, const Value& value) {
        if constexpr (std::is_enum_v<Value>) {
            found_[name] = choice_names(Value{})[static_cast<std::size_t>(value)];
        } else {
            found_[name] = value;
        }
    }

   private:
    py::dict& found_;
};

// The options of every material, with their defaults.
py::dict materials() {
    py::dict result;
    for_each_material([&](auto material) {
        py::dict options;
        visit_options(material, MaterialWriter(options));
        result[material.material] = options;
    });
    return result;
}

std::vector<py::tuple> parameter_rows(const std::string& material) {
    std::vector<py::tuple> rows;
    for (const MaterialParameter& one : material_parameters(material_from(material))) {
        rows.push_back(py::make_tuple(one.name, one.unit, one.meaning));
    }
    return rows;
}

// Calls compute(answer, slopes, control) and returns the answer, or both. `slopes` is null unless
// they are asked for. n points, k parameters.
template <class Compute>
py::object answered(py::ssize_t n, py::ssize_t k, bool with_slopes, double steps_of_a_point,
                    Compute compute) {
    RowMajor answer(n), slopes(std::vector<py::ssize_t>{with_slopes ? n : 0, k});
    double* const out = answer.mutable_data();
    double* const slopes_out = with_slopes ? slopes.mutable_data() : nullptr;
    interruptible((with_slopes ? 4.0 : 1.0) * steps_of_a_point * static_cast<double>(n), py::none(),
                  [&](Control* control) { compute(out, slopes_out, control); });
    if (with_slopes) return py::make_tuple(answer, slopes);
    return std::move(answer);
}

Material material_of(const std::string& text, const RowMajor& parameters) {
    Material material = material_from(text);
    const auto k = static_cast<std::size_t>(parameters.size());
    if (k != material_parameters(material).size()) {
        throw std::invalid_argument("wrong number of parameters");
    }
    return material;
}

py::object stress(const std::string& text, const RowMajor& parameters, const RowMajor& strain,
                  bool with_slopes) {
    const Material material = material_of(text, parameters);
    const py::ssize_t n = strain.size();
    return answered(n, parameters.size(), with_slopes, 100.0,
                    [&](double* found, double* slopes, Control* control) {
                        material_stress(material, parameters.data(), strain.data(), n, found,
                                        slopes, control);
                    });
}

py::object response(const std::string& text, const RowMajor& parameters, const RowMajor& given,
                    const py::array_t<bool, py::array::c_style>& by_stress, bool with_slopes) {
    const Material material = material_of(text, parameters);
    const py::ssize_t n = given.size();
    if (by_stress.size() != n) {
        throw std::invalid_argument("by_stress has another length than given");
    }
    return answered(n, parameters.size(), with_slopes, 1000.0,
                    [&](double* answer, double* slopes, Control* control) {
                        material_response(material, parameters.data(), given.data(),
                                          by_stress.data(), n, answer, slopes, control);
                    });
}

}  // namespace

void bind_materials(py::module_& module) {
    module.def("materials", &materials);
    module.def("material_parameters", &parameter_rows);
    module.def("material_stress", &stress);
    module.def("material_response", &response);
}

}  // namespace curvewise::bindings
