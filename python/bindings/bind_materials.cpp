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

// The functions <name>_parameters(options) and <name>_stress(options, parameters, strain, slopes).
template <class Material>
void bind(py::module_& module, const std::string& name) {
    module.def((name + "_parameters").c_str(), [](const py::dict& options) {
        std::vector<py::tuple> rows;
        for (const MaterialParameter& one : material_parameters(read_material<Material>(options))) {
            rows.push_back(py::make_tuple(one.name, one.unit, one.meaning));
        }
        return rows;
    });
    module.def((name + "_stress").c_str(),
               [](const py::dict& options, const RowMajor& parameters, const RowMajor& strain,
                  bool with_slopes) -> py::object {
                   const auto material = read_material<Material>(options);
                   const py::ssize_t n = strain.size(), k = parameters.size();
                   if (static_cast<std::size_t>(k) != material_parameters(material).size()) {
                       throw std::invalid_argument("wrong number of parameters");
                   }
                   RowMajor stress(n), slopes(std::vector<py::ssize_t>{with_slopes ? n : 0, k});
                   double* const out = stress.mutable_data();
                   double* const slopes_out = with_slopes ? slopes.mutable_data() : nullptr;
                   const double steps_of_a_point = with_slopes ? 400.0 : 100.0;
                   interruptible(steps_of_a_point * static_cast<double>(n), py::none(),
                                 [&](Control* control) {
                                     material_stress(material, parameters.data(), strain.data(), n,
                                                     out, slopes_out, control);
                                 });
                   if (with_slopes) return py::make_tuple(stress, slopes);
                   return std::move(stress);
               });
}

}  // namespace

void bind_materials(py::module_& module) {
    bind<ChabocheVoce>(module, "chaboche_voce");
    bind<YoshidaUemori>(module, "yoshida_uemori");
}

}  // namespace curvewise::bindings
