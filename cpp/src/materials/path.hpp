// Functions that all material points share: the checks of their strains and parameters, the walk
// along the path of strain, Young's modulus, and the passes for derivatives. A pass takes eight
// directions, which fill two or four vector registers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "curvewise/materials.hpp"
#include "materials/dual.hpp"
#include "runtime/poller.hpp"

namespace curvewise::materials {

inline std::string text_of(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

// Thrown if parameters that are valid one by one lead to no stress. It has the reason and the
// parameter that causes it; "" for the one that is farthest from those of a metal.
struct NoStress {
    std::string what, parameter;
};

// Named access to the parameters of a material, and its complaints about them.
class Parameters {
   public:
    Parameters(std::vector<MaterialParameter> names, const double* values)
        : names_(std::move(names)), values_(values) {
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (!std::isfinite(values_[i])) refuse(i, "give a finite number");
        }
    }
    std::size_t count() const noexcept { return names_.size(); }
    double operator[](std::size_t i) const noexcept { return values_[i]; }
    const double* values() const noexcept { return values_; }
    const std::string& name(std::size_t i) const noexcept { return names_[i].name; }

    void at_least_zero(std::size_t i) const {
        if (values_[i] < 0.0) refuse(i, "it must be at least 0");
    }
    void above_zero(std::size_t i) const {
        if (values_[i] <= 0.0) refuse(i, "it must be above 0");
    }
    // "Y = 300: it must be ..."
    [[noreturn]] void refuse(std::size_t i, const std::string& why) const {
        throw std::invalid_argument(names_[i].name + " is " + text_of(values_[i]) + "; " + why);
    }
    // "C is 1e+16; with these parameters ..."
    [[noreturn]] void refuse(const NoStress& found) const;

   private:
    std::vector<MaterialParameter> names_;
    const double* values_;
};

// E, Ea and xi, the first one or three parameters of every material.
std::vector<MaterialParameter> modulus_parameters(Modulus modulus);
void check_modulus(const Parameters& parameters, Modulus modulus);

// Young's modulus after the plastic strain p.
template <class Number>
struct YoungsModulus {
    YoungsModulus(const Number* parameters, Modulus modulus)
        : is_constant(modulus == Modulus::constant), initial(parameters[0]) {
        if (is_constant) return;
        limit = parameters[1];
        rate = parameters[2];
    }
    Number after(const Number& p) const {
        if (is_constant) return initial;
        return limit + (initial - limit) * exp(-(rate * p));
    }
    // Of what changes with the plastic strain in the compliance 1 / E, from the modulus E on.
    double largest_rate(double E) const {
        const double decay = value_of(rate), end = value_of(limit);
        return end > value_of(initial) ? decay * (end / E) : decay;
    }

    // The same without slopes.
    YoungsModulus<double> plain() const {
        const double values[] = {value_of(initial), value_of(limit), value_of(rate)};
        return {values, is_constant ? Modulus::constant : Modulus::decaying};
    }

    bool is_constant;
    Number initial;
    Number limit{};
    Number rate{};
};

inline constexpr double most_strain = 100.0;  // 10,000 %

// A path of strain, of which a law may ask how long it is. Without strains, any path of n points.
struct StrainPath {
    const double* strain;
    std::ptrdiff_t n;

    double length() const {
        if (strain == nullptr) return 2.0 * most_strain * static_cast<double>(n);
        double sum = 0.0;
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            sum += std::abs(strain[i] - (i > 0 ? strain[i - 1] : 0.0));
        }
        return sum;
    }
};

// Throws for an invalid strain: not finite, or beyond the largest.
void check_strain(double strain, std::ptrdiff_t i);
void check_strains(const double* strain, std::ptrdiff_t n);
// The same, of strains and of stresses.
void check_given(const double* given, const bool* by_stress, std::ptrdiff_t n);

// Throws NoStress: parameters beyond all metals, whose products overflow or lose all digits.
[[noreturn]] void refuse_stress(std::ptrdiff_t i, double stress);

// Throws: hardening ends before the stress that is given.
[[noreturn]] void refuse_target(std::ptrdiff_t i, double target, double reached);

// Throws NoStress where a slope is not finite: `slopes` of the answer at place i, such as "stress
// at strain", by the parameters from `first`.
void check_slopes(const char* place, std::ptrdiff_t i, const double* slopes, std::size_t first,
                  std::size_t width, const Parameters& parameters);

// What a sum of terms, all at least 0, allows a stress to be: with rounding, and finite.
inline double with_rounding(double sum, double relative) {
    return std::isfinite(sum) ? sum * (1.0 + relative) : std::numeric_limits<double>::max();
}

// Walks a point along the path: Point(material, parameters, count) is the unloaded state and
// advance(increment of strain) returns the stress behind it, which is at most `most`.
template <class Point, class Number, class Material, class Visit>
void walk(const Material& material, const Number* parameters, std::size_t count, double most,
          const double* strain, std::ptrdiff_t n, runtime::Poller& poller, Visit visit) {
    Point point(material, parameters, count);
    double last = 0.0;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        poller.spend(64);
        const Number stress = point.advance(strain[i] - last);
        if (!(std::abs(value_of(stress)) <= most)) refuse_stress(i, value_of(stress));
        visit(i, stress);
        last = strain[i];
    }
}

// Writes the stresses, each at most `most`, and, unless null, their slopes by all parameters, by a
// Point<Number>.
template <template <class> class Point, class Material>
void integrate(const Material& material, const Parameters& parameters, double most,
               const double* strain, std::ptrdiff_t n, double* stress, double* slopes,
               Control* control) {
    runtime::Poller poller(control);
    const std::size_t count = parameters.count();
    if (slopes == nullptr) {
        walk<Point<double>>(material, parameters.values(), count, most, strain, n, poller,
                            [&](std::ptrdiff_t i, double found) { stress[i] = found; });
        return;
    }
    constexpr std::size_t directions = 8;
    using Number = Dual<directions>;
    for (std::size_t first = 0; first < count; first += directions) {
        const std::size_t width = std::min(directions, count - first);
        std::vector<Number> seeded(parameters.values(), parameters.values() + count);
        for (std::size_t i = 0; i < width; ++i) seeded[first + i].slopes[i] = 1.0;
        walk<Point<Number>>(material, seeded.data(), count, most, strain, n, poller,
                            [&](std::ptrdiff_t i, const Number& found) {
                                double sum = 0.0;
                                for (const double slope : found.slopes) sum += slope;
                                if (!std::isfinite(sum)) {
                                    check_slopes("stress at strain", i, found.slopes.data(), first,
                                                 width, parameters);
                                }
                                stress[i] = found.value;
                                std::copy_n(found.slopes.begin(), width,
                                            slopes + static_cast<std::size_t>(i) * count + first);
                            });
    }
}

}  // namespace curvewise::materials
