// The errors of stresses and derivatives of random materials.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "curvewise/materials.hpp"
#include "materials/chaboche_voce.hpp"
#include "materials/quad.hpp"
#include "materials/random_materials.hpp"
#include "materials/textbook.hpp"
#include "materials/yoshida_uemori.hpp"

namespace test {

struct Errors {
    std::string material;
    int sets = 0;
    double stress = 0.0;  // relative to the largest stress of the loop
    double slopes = 0.0;  // relative to the largest slope by the same parameter
    long points = 0;      // at which slopes were compared, one for each parameter
    long kinks = 0;       // of them left out
};

inline double largest(const std::vector<double>& values) {
    double found = 0.0;
    for (const double value : values) found = std::max(found, std::abs(value));
    return found;
}

// The same without an error of integration, which jumps where a step is divided once more.
inline curvewise::ChabocheVoce finest(const curvewise::ChabocheVoce& material) { return material; }
inline curvewise::YoshidaUemori finest(curvewise::YoshidaUemori material) {
    material.rtol = 1e-13;
    return material;
}

// The stresses in quadruple precision, with parameter j moved by `step`.
template <template <class> class Point, class Material>
std::vector<__float128> moved_stress(const Material& material, const std::vector<double>& values,
                                     const std::vector<double>& strain, std::size_t j,
                                     __float128 step) {
    using curvewise::materials::Quad;
    std::vector<Quad> parameters(values.begin(), values.end());
    parameters[j] += Quad::of(step);
    curvewise::runtime::Poller poller(nullptr);
    std::vector<__float128> found;
    curvewise::materials::walk<Point<Quad>>(
        material, parameters.data(), parameters.size(), std::numeric_limits<double>::max(),
        strain.data(), static_cast<std::ptrdiff_t>(strain.size()), poller,
        [&](std::ptrdiff_t, const Quad& stress) { found.push_back(stress.value); });
    return found;
}

template <template <class> class Point, class Textbook, class Material>
void add_errors(Errors& errors, const Material& material, const std::vector<double>& parameters,
                const std::vector<double>& strain, int increments) {
    const std::size_t n = strain.size(), k = parameters.size();
    std::vector<double> stress(n), slopes(n * k);
    curvewise::material_stress(material, parameters.data(), strain.data(),
                               static_cast<std::ptrdiff_t>(n), stress.data(), slopes.data());
    const std::vector<double> fine =
        textbook::stress<Textbook>(material, parameters.data(), strain, increments);
    for (std::size_t i = 0; i < n; ++i) {
        errors.stress = std::max(errors.stress, std::abs(stress[i] - fine[i]) / largest(fine));
    }
    // Uses steps of two lengths. If their results differ, the material begins to yield within the
    // difference, or the yield surface passes the bounding surface's centre. Then the difference
    // does not approximate a derivative.
    const auto differences = [&](std::size_t j, double relative) {
        const __float128 step = relative * std::max(std::abs(parameters[j]), 1e-3);
        const auto above = moved_stress<Point>(finest(material), parameters, strain, j, step);
        const auto below = moved_stress<Point>(finest(material), parameters, strain, j, -step);
        std::vector<double> found(n);
        for (std::size_t i = 0; i < n; ++i) {
            found[i] = static_cast<double>((above[i] - below[i]) / (2 * step));
        }
        return found;
    };
    for (std::size_t j = 0; j < k; ++j) {
        const std::vector<double> exact = differences(j, 1e-6), rough = differences(j, 2e-6);
        const double scale = largest(exact);
        for (std::size_t i = 0; i < n && scale > 0.0; ++i) {
            ++errors.points;
            if (std::abs(exact[i] - rough[i]) > 2e-8 * scale) {
                ++errors.kinks;
                continue;
            }
            const double error = std::abs(slopes[i * k + j] - exact[i]) / scale;
            errors.slopes = std::max(errors.slopes, error);
        }
    }
}

// A share of the draws for each kind of material: a set of parameters for each of five loops.
inline std::vector<Errors> errors_of_all(Generator& generator, int draws, int increments) {
    using curvewise::BoundGrowth;
    using curvewise::Modulus;
    using curvewise::materials::ChabocheVocePoint;
    using curvewise::materials::YoshidaUemoriPoint;
    const auto loops = five_loops();
    std::vector<Errors> found;
    const auto add = [&](const std::string& name, auto check) {
        Errors errors{name};
        for (int i = 0; i < draws / 8; ++i) {
            for (const auto& strain : loops) check(errors, strain), ++errors.sets;
        }
        found.push_back(errors);
    };
    for (const Modulus modulus : {Modulus::constant, Modulus::decaying}) {
        const std::string kind = modulus == Modulus::constant ? "constant" : "decaying";
        for (const int backstresses : {2, 4}) {
            const curvewise::ChabocheVoce material{backstresses, modulus};
            add("ChabocheVoce, " + std::to_string(backstresses) + ", " + kind,
                [&](Errors& errors, const auto& strain) {
                    add_errors<ChabocheVocePoint, textbook::ChabocheVoce>(
                        errors, material, random_parameters(generator, material), strain,
                        increments);
                });
        }
        for (const BoundGrowth growth : {BoundGrowth::saturating, BoundGrowth::power}) {
            curvewise::YoshidaUemori material;
            material.growth = growth;
            material.modulus = modulus;
            add(std::string("YoshidaUemori, ") +
                    choice_names(growth)[static_cast<std::size_t>(growth)] + ", " + kind,
                [&](Errors& errors, const auto& strain) {
                    add_errors<YoshidaUemoriPoint, textbook::YoshidaUemori>(
                        errors, material, random_parameters(generator, material), strain,
                        increments);
                });
        }
    }
    return found;
}

}  // namespace test
