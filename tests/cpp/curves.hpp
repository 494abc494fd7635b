// Curves for the tests: one that owns its points, and random ones, the same in every run.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "choices.hpp"
#include "curvewise/curve.hpp"

namespace test {

// Row-major; passes for a CurveView wherever one is taken.
class Curve {
   public:
    Curve(std::vector<double> values, std::ptrdiff_t dim) : values_(std::move(values)), dim_(dim) {}
    Curve(std::initializer_list<std::initializer_list<double>> points)
        : dim_(static_cast<std::ptrdiff_t>(points.begin()->size())) {
        for (const auto& point : points) {
            for (const double coordinate : point) values_.push_back(coordinate);
        }
    }

    operator curvewise::CurveView() const noexcept { return {values_.data(), size(), dim_}; }

    std::ptrdiff_t size() const noexcept {
        return static_cast<std::ptrdiff_t>(values_.size()) / dim_;
    }
    std::ptrdiff_t dim() const noexcept { return dim_; }
    const std::vector<double>& values() const noexcept { return values_; }
    double operator()(std::ptrdiff_t i, std::ptrdiff_t c) const noexcept {
        return values_[static_cast<std::size_t>(i * dim_ + c)];
    }
    double& operator()(std::ptrdiff_t i, std::ptrdiff_t c) noexcept {
        return values_[static_cast<std::size_t>(i * dim_ + c)];
    }

    // Points first, ..., last - 1.
    Curve part(std::ptrdiff_t first, std::ptrdiff_t last) const {
        return {std::vector<double>(values_.begin() + first * dim_, values_.begin() + last * dim_),
                dim_};
    }
    // Every coordinate times 2^exponent.
    Curve times_power_of_two(int exponent) const {
        return times_powers_of_two(std::vector<int>(static_cast<std::size_t>(dim_), exponent));
    }
    // Coordinate c times 2^exponents[c].
    Curve times_powers_of_two(const std::vector<int>& exponents) const {
        Curve curve = *this;
        for (std::size_t k = 0; k < values_.size(); ++k) {
            curve.values_[k] = std::ldexp(values_[k], exponents[k % exponents.size()]);
        }
        return curve;
    }

   private:
    std::vector<double> values_;
    std::ptrdiff_t dim_;
};

class Random final : public Choices {
   public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    std::uint64_t bytes(int count) override { return engine_() >> (64 - 8 * count); }

    // From low to high; the top 53 bits, so that every library gives the same numbers.
    double uniform(double low, double high) override {
        return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
    }
    // 0, ..., count - 1.
    std::ptrdiff_t index(std::ptrdiff_t count) override {
        return static_cast<std::ptrdiff_t>(engine_() % static_cast<std::uint64_t>(count));
    }

    Curve curve(std::ptrdiff_t n, std::ptrdiff_t dim) {
        return filled(n, dim, [this] { return uniform(-1.0, 1.0); });
    }
    // Coordinates 0, 1 and 2 only: most ground distances are equal to others.
    Curve lattice_curve(std::ptrdiff_t n, std::ptrdiff_t dim) {
        return filled(n, dim, [this] { return static_cast<double>(index(3)); });
    }
    // Steps of different lengths in the plane; now and then a point is repeated.
    Curve walk(std::ptrdiff_t n) {
        Curve curve(std::vector<double>(static_cast<std::size_t>(2 * n)), 2);
        for (std::ptrdiff_t i = 1; i < n; ++i) {
            const double step = index(8) == 0 ? 0.0 : uniform(0.1, 1.0);
            const double angle = uniform(-3.2, 3.2);
            curve(i, 0) = curve(i - 1, 0) + step * std::cos(angle);
            curve(i, 1) = curve(i - 1, 1) + step * std::sin(angle);
        }
        return curve;
    }

   private:
    template <class Draw>
    static Curve filled(std::ptrdiff_t n, std::ptrdiff_t dim, Draw draw) {
        Curve curve(std::vector<double>(static_cast<std::size_t>(n * dim)), dim);
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            for (std::ptrdiff_t c = 0; c < dim; ++c) curve(i, c) = draw();
        }
        return curve;
    }

    std::mt19937_64 engine_;
};

inline std::vector<curvewise::CurveView> views_of(const std::vector<Curve>& curves) {
    return {curves.begin(), curves.end()};
}

// Powers of two to multiply x and y by: x may be as large as y is small.
inline std::vector<std::vector<int>> powers_for_x_and_y() {
    return {{-1000, -1000}, {-505, -505}, {490, 490}, {1000, 1000},
            {700, -700},    {0, 900},     {-900, 3}};
}

// "(5, 2)", or "(5,)" for a flat list.
inline std::string shape_of(const curvewise::CurveView& curve) {
    const std::string n = std::to_string(curve.size());
    return "(" + n + (curve.is_flat() ? "," : ", " + std::to_string(curve.dim())) + ")";
}

inline std::string described(const Curve& P, const Curve& Q) {
    return "P of shape " + shape_of(P) + ", Q of shape " + shape_of(Q);
}

}  // namespace test
