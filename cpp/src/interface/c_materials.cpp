// The C interface: material points.
#include <memory>

#include "interface/c_translate.hpp"

namespace {

using curvewise::c::guarded;
using curvewise::c::require;

// The material that a text names, for which `count` parameters are given at n points.
curvewise::Material checked(const char* text, const double* parameters, ptrdiff_t count,
                            ptrdiff_t n, const char* things) {
    require(text, "material");
    const curvewise::Material material = curvewise::material_from(text);
    const auto names = curvewise::material_parameters(material);
    if (count != static_cast<ptrdiff_t>(names.size())) {
        std::string listed;
        for (const auto& one : names) listed += (listed.empty() ? "" : ", ") + one.name;
        throw std::invalid_argument("there are " + std::to_string(count) +
                                    " parameters; the material has " +
                                    std::to_string(names.size()) + ": " + listed);
    }
    curvewise::c::check_count(n, things);
    require(parameters, "parameters");
    return material;
}

}  // namespace

int curvewise_material_stress(const char* material, const double* parameters, ptrdiff_t count,
                              const double* strain, ptrdiff_t n, double* stress, double* slopes,
                              curvewise_error* error) {
    return guarded(error, [&] {
        const auto chosen = checked(material, parameters, count, n, "strains");
        if (n > 0) require(strain, "strain"), require(stress, "stress");
        curvewise::material_stress(chosen, parameters, strain, n, stress, slopes);
    });
}

int curvewise_material_response(const char* material, const double* parameters, ptrdiff_t count,
                                const double* given, const int* by_stress, ptrdiff_t n,
                                double* answer, double* slopes, curvewise_error* error) {
    return guarded(error, [&] {
        const auto chosen = checked(material, parameters, count, n, "points");
        if (n > 0) require(given, "given"), require(answer, "answer");
        const auto flags = std::make_unique<bool[]>(n > 0 ? static_cast<std::size_t>(n) : 0);
        for (ptrdiff_t i = 0; i < n; ++i) {
            flags[static_cast<std::size_t>(i)] = by_stress == nullptr || by_stress[i] != 0;
        }
        curvewise::material_response(chosen, parameters, given, flags.get(), n, answer, slopes);
    });
}
