// calibrate experiment.csv fitted.csv: identifies a material from a measured hysteresis loop.
//
// The material point is 1-D plasticity with Armstrong and Frederick's kinematic hardening (CEGB
// report RD/B/N731, 1966): |stress - X| <= yield stress, dX = C dep - gamma X |dep|. While flow
// keeps its direction, the back stress X has a closed form in the plastic strain. So a step of
// strain is integrated exactly, by Newton's method on one convex equation. The four constants
// minimise the area between the loops. Nelder and Mead's simplex (Computer Journal 7, 1965)
// searches for their logarithms, which keeps the constants positive. It restarts from its result
// until a restart gains nothing. The file has strain [-] and stress [MPa], one point a line.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <curvewise/curvewise.hpp>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Points = std::vector<std::array<double, 2>>;
using Constants = std::array<double, 4>;  // E [MPa], yield stress [MPa], C [MPa], gamma [-]

// The plastic strain p >= 0 at which E p + modulus (1 - exp(-gamma p)) / gamma = excess. From the
// left, where the function is convex and falls, Newton's steps do not overshoot.
double plastic_step(double excess, double E, double modulus, double gamma) {
    double p = 0.0;
    for (int i = 0; i < 50; ++i) {
        const double left = excess - E * p + modulus * std::expm1(-gamma * p) / gamma;
        const double step = left / (E + modulus * std::exp(-gamma * p));
        p += step;
        if (std::abs(step) <= 1e-15 * p) break;
    }
    return p;
}

// The stress along the strains of `path`.
Points response(const Points& path, const Constants& constants) {
    const auto [E, yield_stress, C, gamma] = constants;
    Points points = path;
    double plastic_strain = 0.0;
    double back_stress = 0.0;
    for (auto& [strain, stress] : points) {
        const double trial = E * (strain - plastic_strain);
        const double direction = trial < back_stress ? -1.0 : 1.0;
        const double excess = direction * (trial - back_stress) - yield_stress;
        if (excess > 0.0) {
            const double modulus = C - gamma * direction * back_stress;
            const double p = plastic_step(excess, E, modulus, gamma);
            plastic_strain += direction * p;
            back_stress -= direction * modulus * std::expm1(-gamma * p) / gamma;
        }
        stress = E * (strain - plastic_strain);
    }
    return points;
}

// Nelder and Mead's downhill simplex, from `start` in steps of 0.2.
template <class Objective>
Constants simplex_search(const Objective& objective, const Constants& start) {
    struct Vertex {
        Constants x;
        double value;
    };
    const auto vertex = [&](const Constants& x) { return Vertex{x, objective(x)}; };
    std::vector<Vertex> simplex{vertex(start)};
    for (std::size_t k = 0; k < start.size(); ++k) {
        Constants x = start;
        x[k] += 0.2;
        simplex.push_back(vertex(x));
    }
    for (int step = 0; step < 2000; ++step) {
        std::sort(simplex.begin(), simplex.end(),
                  [](const Vertex& a, const Vertex& b) { return a.value < b.value; });
        Vertex& worst = simplex.back();
        const Vertex& best = simplex.front();
        if (worst.value - best.value <= 1e-12 * best.value) break;
        Constants centre{};
        for (std::size_t v = 0; v + 1 < simplex.size(); ++v) {
            for (std::size_t k = 0; k < centre.size(); ++k) {
                centre[k] += simplex[v].x[k] / static_cast<double>(centre.size());
            }
        }
        const auto beyond = [&](double factor) {
            Constants x;
            for (std::size_t k = 0; k < x.size(); ++k) {
                x[k] = centre[k] + factor * (centre[k] - worst.x[k]);
            }
            return vertex(x);
        };
        Vertex next = beyond(1.0);
        if (next.value < best.value) {
            const Vertex further = beyond(2.0);
            if (further.value < next.value) next = further;
        } else if (next.value >= simplex[simplex.size() - 2].value) {
            const Vertex nearer = beyond(next.value < worst.value ? 0.5 : -0.5);
            if (nearer.value < std::min(next.value, worst.value)) next = nearer;
        }
        if (next.value < worst.value) {
            worst = next;
            continue;
        }
        for (std::size_t v = 1; v < simplex.size(); ++v) {  // shrink towards the best
            Constants x = simplex[v].x;
            for (std::size_t k = 0; k < x.size(); ++k) x[k] = 0.5 * (x[k] + best.x[k]);
            simplex[v] = vertex(x);
        }
    }
    return simplex.front().x;
}

Points read(const char* file) {
    std::ifstream lines(file);
    if (!lines) throw std::runtime_error(std::string(file) + " cannot be read");
    Points points;
    for (std::string line; std::getline(lines, line);) {
        double strain = 0.0, stress = 0.0;
        if (std::sscanf(line.c_str(), "%lf ,%lf", &strain, &stress) == 2) {
            points.push_back({strain, stress});
        }
    }
    return points;
}

void write(const char* file, const Points& points) {
    std::ofstream out(file);
    out.precision(17);
    for (const auto& [strain, stress] : points) out << strain << ',' << stress << '\n';
    if (!out.flush()) throw std::runtime_error(std::string(file) + " cannot be written");
}

Constants exponential(const Constants& logarithms) {
    Constants x;
    std::transform(logarithms.begin(), logarithms.end(), x.begin(),
                   [](double value) { return std::exp(value); });
    return x;
}

}  // namespace

int main(int count, char** arguments) try {
    if (count != 3) throw std::runtime_error("give the file of the experiment and of the result");
    const Points experiment = read(arguments[1]);
    curvewise::AreaOptions options;
    options.spacing = curvewise::Spacing::x;  // raw stress and strain
    int evaluations = 0;
    const auto objective = [&](const Constants& logarithms) {
        ++evaluations;
        const Points computed = response(experiment, exponential(logarithms));
        return curvewise::area(experiment, computed, options);
    };
    Constants x{std::log(150e3), std::log(200.0), std::log(30e3), std::log(100.0)};
    double value = objective(x);
    for (double before = 2.0 * value; value < 0.999 * before;) {
        before = value;
        x = simplex_search(objective, x);
        value = objective(x);
    }
    const Constants fitted = exponential(x);
    const Points simulation = response(experiment, fitted);
    write(arguments[2], simulation);
    std::printf("E %.6g MPa\nyield_stress %.6g MPa\nC %.6g MPa\ngamma %.6g\n", fitted[0], fitted[1],
                fitted[2], fitted[3]);
    std::printf("evaluations %d\narea %.17g MPa\n", evaluations,
                curvewise::area(experiment, simulation, options));
} catch (const std::exception& error) {
    std::fprintf(stderr, "calibrate: %s\n", error.what());
    return 1;
}
