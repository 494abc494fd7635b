// Materials with random parameters within what steels have, and loops for them.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "curvewise/materials.hpp"

namespace test {

using Generator = std::mt19937_64;

inline double between(Generator& generator, double low, double high) {
    return low + (high - low) * (static_cast<double>(generator() >> 11) * 0x1p-53);
}
inline double log_between(Generator& generator, double low, double high) {
    return std::exp(between(generator, std::log(low), std::log(high)));
}

inline std::vector<double> modulus_parameters(Generator& generator, curvewise::Modulus modulus) {
    const double E = between(generator, 60e3, 230e3);
    if (modulus == curvewise::Modulus::constant) return {E};
    return {E, E * between(generator, 0.6, 1.0), between(generator, 5.0, 100.0)};
}

inline std::vector<double> random_parameters(Generator& generator,
                                             const curvewise::ChabocheVoce& material) {
    std::vector<double> found = modulus_parameters(generator, material.modulus);
    const double yield = between(generator, 100.0, 700.0);
    found.insert(found.end(), {yield, between(generator, -0.6 * yield, 300.0),
                               log_between(generator, 0.5, 200.0)});
    for (int k = 0; k < material.backstresses; ++k) {
        found.push_back(log_between(generator, 1e3, 3e5));
        found.push_back(log_between(generator, 1.0, 3e3));
    }
    return found;
}

inline std::vector<double> random_parameters(Generator& generator,
                                             const curvewise::YoshidaUemori& material) {
    std::vector<double> found = modulus_parameters(generator, material.modulus);
    const double Y = between(generator, 100.0, 600.0);
    found.insert(found.end(),
                 {Y + between(generator, 20.0, 300.0), Y, log_between(generator, 10.0, 1e3),
                  log_between(generator, 1.0, 50.0), between(generator, 0.0, 400.0),
                  between(generator, 1.0, 300.0), between(generator, 0.0, 1.0)});
    if (material.growth == curvewise::BoundGrowth::power) {
        found.push_back(log_between(generator, 1e-3, 0.1));
        found.push_back(between(generator, 0.1, 1.0));
    }
    return found;
}

// From turn to turn, `points` strains in all.
inline std::vector<double> loop(const std::vector<double>& turns, int points) {
    double length = 0.0, last = 0.0;
    for (const double turn : turns) length += std::abs(turn - last), last = turn;
    std::vector<double> strain;
    last = 0.0;
    for (const double turn : turns) {
        const int count = std::max(1, static_cast<int>(points * std::abs(turn - last) / length));
        for (int i = 1; i <= count; ++i) strain.push_back(last + (turn - last) * i / count);
        last = turn;
    }
    return strain;
}

// Five: tension and compression, one way and the other, growing, one tension, a random protocol.
inline std::vector<std::vector<double>> five_loops(int points = 150) {
    return {loop({0.03, -0.03, 0.03}, points), loop({-0.05, 0.02, -0.04}, points),
            loop({0.005, -0.005, 0.01, -0.01, 0.02, -0.02, 0.04}, points), loop({0.2}, points),
            loop({0.011, 0.008, 0.023, -0.004, 0.006, -0.019, 0.031, 0.029, 0.03}, points)};
}

}  // namespace test
