// Points of material: each a struct of options, its parameters, its stresses and their slopes.
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "bind_topics.hpp"
#include "curvewise/materials.hpp"
#include "interruptible.hpp"
#include "numpy_view.hpp"
#include "options.hpp"

namespace curvewise::bindings {
namespace {

using RowMajor = py::array_t<double, py::array::c_style>;

// Reads the options of a material, by name, from a dict.
class MaterialReader {
   public:
    explicit MaterialReader(const py::dict& given) noexcept : given_(given) {}

    template <class Enum>
    std::enable_if_t<std::is_enum_v<Enum>> operator()(const char* name, Enum& value) {
        constexpr auto names = choice_names(Enum{});
        const py::object object = given_[name];
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (!is_text(object, names[i])) continue;
            value = static_cast<Enum>(i);
            return;
        }
        refuse_choice(name, object, names.data(), names.size());
    }
    template <class Value>
    std::enable_if_t<std::is_arithmetic_v<Value>> operator()(const char* name, Value& value) {
        value = given_[name].cast<Value>();
    }

   private:
    const py::dict& given_;
};

template <class Material>
Material read_material(const py::dict& options) {
    Material material;
    visit_options(material, MaterialReader(options));
    return material;
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

template <class Material>
Material material_of(const py::dict& options, const RowMajor& parameters) {
    auto material = read_material<Material>(options);
    const auto k = static_cast<std::size_t>(parameters.size());
    if (k != material_parameters(material).size()) {
        throw std::invalid_argument("wrong number of parameters");
    }
    return material;
}

// The functions <name>_parameters(options), <name>_stress(options, parameters, strain, slopes) and
// <name>_response(options, parameters, given, by_stress, slopes).
template <class Material>
void bind(py::module_& module, const std::string& name) {
    module.def((name + "_parameters").c_str(), [](const py::dict& options) {
        std::vector<py::tuple> rows;
        for (const MaterialParameter& one : material_parameters(read_material<Material>(options))) {
            rows.push_back(py::make_tuple(one.name, one.unit, one.meaning));
        }
        return rows;
    });
    module.def((name + "_stress").c_str(), [](const py::dict& options, const RowMajor& parameters,
                                              const RowMajor& strain, bool with_slopes) {
        const auto material = material_of<Material>(options, parameters);
        const py::ssize_t n = strain.size();
        return answered(n, parameters.size(), with_slopes, 100.0,
                        [&](double* stress, double* slopes, Control* control) {
                            material_stress(material, parameters.data(), strain.data(), n, stress,
                                            slopes, control);
                        });
    });
    module.def((name + "_response").c_str(),
               [](const py::dict& options, const RowMajor& parameters, const RowMajor& given,
                  const py::array_t<bool, py::array::c_style>& by_stress, bool with_slopes) {
                   const auto material = material_of<Material>(options, parameters);
                   const py::ssize_t n = given.size();
                   if (by_stress.size() != n) {
                       throw std::invalid_argument("by_stress has another length than given");
                   }
                   return answered(n, parameters.size(), with_slopes, 1000.0,
                                   [&](double* answer, double* slopes, Control* control) {
                                       material_response(material, parameters.data(), given.data(),
                                                         by_stress.data(), n, answer, slopes,
                                                         control);
                                   });
               });
}

}  // namespace

void bind_materials(py::module_& module) {
    bind<ChabocheVoce>(module, "chaboche_voce");
    bind<YoshidaUemori>(module, "yoshida_uemori");
}

}  // namespace curvewise::bindings
