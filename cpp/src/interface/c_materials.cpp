// The C interface: material points.
#include <memory>

#include "interface/c_translate.hpp"

namespace {

using curvewise::c::choice;
using curvewise::c::complete;
using curvewise::c::guarded;
using curvewise::c::require;

curvewise::ChabocheVoce translate(const curvewise_chaboche_voce& given) {
    return {given.backstresses, choice<curvewise::Modulus>("modulus", given.modulus)};
}

curvewise::YoshidaUemori translate(const curvewise_yoshida_uemori& given) {
    return {choice<curvewise::BoundGrowth>("growth", given.growth),
            choice<curvewise::Modulus>("modulus", given.modulus), given.rtol};
}

// What the caller gives to a material point, and where the answers go.
struct Drive {
    const double* parameters;
    ptrdiff_t count;
    const double* given;
    ptrdiff_t n;
    double* answer;
    double* slopes;
};

template <class Material>
void check(const Material& material, const Drive& drive, const char* given, const char* things,
           const char* answer) {
    const auto names = curvewise::material_parameters(material);
    if (drive.count != static_cast<ptrdiff_t>(names.size())) {
        std::string listed;
        for (const auto& one : names) listed += (listed.empty() ? "" : ", ") + one.name;
        throw std::invalid_argument("there are " + std::to_string(drive.count) +
                                    " parameters; the material has " +
                                    std::to_string(names.size()) + ": " + listed);
    }
    curvewise::c::check_count(drive.n, things);
    require(drive.parameters, "parameters");
    if (drive.n > 0) require(drive.given, given), require(drive.answer, answer);
}

template <class Given>
int stressed(const Given* material, const Drive& drive, curvewise_error* error) noexcept {
    return guarded(error, [&] {
        const auto chosen = translate(complete(material));
        check(chosen, drive, "strain", "strains", "stress");
        curvewise::material_stress(chosen, drive.parameters, drive.given, drive.n, drive.answer,
                                   drive.slopes);
    });
}

template <class Given>
int responded(const Given* material, const Drive& drive, const int* by_stress,
              curvewise_error* error) noexcept {
    return guarded(error, [&] {
        const auto chosen = translate(complete(material));
        check(chosen, drive, "given", "points", "answer");
        const auto flags = std::make_unique<bool[]>(static_cast<std::size_t>(drive.n));
        for (ptrdiff_t i = 0; i < drive.n; ++i) {
            flags[static_cast<std::size_t>(i)] = by_stress == nullptr || by_stress[i] != 0;
        }
        curvewise::material_response(chosen, drive.parameters, drive.given, flags.get(), drive.n,
                                     drive.answer, drive.slopes);
    });
}

}  // namespace

int curvewise_chaboche_voce_stress(const curvewise_chaboche_voce* material,
                                   const double* parameters, ptrdiff_t count, const double* strain,
                                   ptrdiff_t n, double* stress, double* slopes,
                                   curvewise_error* error) {
    return stressed(material, {parameters, count, strain, n, stress, slopes}, error);
}

int curvewise_yoshida_uemori_stress(const curvewise_yoshida_uemori* material,
                                    const double* parameters, ptrdiff_t count, const double* strain,
                                    ptrdiff_t n, double* stress, double* slopes,
                                    curvewise_error* error) {
    return stressed(material, {parameters, count, strain, n, stress, slopes}, error);
}

int curvewise_chaboche_voce_response(const curvewise_chaboche_voce* material,
                                     const double* parameters, ptrdiff_t count, const double* given,
                                     const int* by_stress, ptrdiff_t n, double* answer,
                                     double* slopes, curvewise_error* error) {
    return responded(material, {parameters, count, given, n, answer, slopes}, by_stress, error);
}

int curvewise_yoshida_uemori_response(const curvewise_yoshida_uemori* material,
                                      const double* parameters, ptrdiff_t count,
                                      const double* given, const int* by_stress, ptrdiff_t n,
                                      double* answer, double* slopes, curvewise_error* error) {
    return responded(material, {parameters, count, given, n, answer, slopes}, by_stress, error);
}
