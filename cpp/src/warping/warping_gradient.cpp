// The gradients of dtw and frechet: the path is held, and the ground distances along it are
// differentiated. O(path length) beyond the path.
#include <algorithm>
#include <cmath>
#include <vector>

#include "curvewise/gradient.hpp"

namespace curvewise {
namespace {

double sign(double x) noexcept { return static_cast<double>((x > 0.0) - (x < 0.0)); }

// The ground distance of two points as a function of their difference.
class Difference {
   public:
    Difference(const GroundDistance& ground, std::ptrdiff_t dim)
        : metric_(ground.metric), p_(ground.p), delta_(static_cast<std::size_t>(dim)) {
        if (metric_ == Metric::minkowski) {
            if (p_ == 1.0) metric_ = Metric::cityblock;
            if (p_ == 2.0) metric_ = Metric::euclidean;
            if (std::isinf(p_)) metric_ = Metric::chebyshev;
        }
    }

    void move_to(const CurveView& P, std::ptrdiff_t i, const CurveView& Q, std::ptrdiff_t j) {
        largest_ = 0.0;
        for (std::size_t c = 0; c < delta_.size(); ++c) {
            const auto k = static_cast<std::ptrdiff_t>(c);
            delta_[c] = Q(j, k) - P(i, k);
            largest_ = std::max(largest_, std::abs(delta_[c]));
        }
    }

    // Of sqeuclidean its root, which is as large where it is largest, and never overflows.
    double magnitude() const noexcept {
        if (metric_ == Metric::chebyshev || largest_ == 0.0) return largest_;
        if (metric_ == Metric::cityblock) return largest_ * sum_of([](double x) { return x; });
        if (metric_ != Metric::minkowski) {
            return largest_ * std::sqrt(sum_of([](double x) { return x * x; }));
        }
        const double powers = sum_of([this](double x) { return std::pow(x, p_); });
        return largest_ * std::pow(powers, 1.0 / p_);
    }

    // Adds weight times the derivative by the point of Q; nothing where the points coincide.
    void add_gradient(double weight, double* out) const noexcept {
        if (largest_ == 0.0) return;
        const double size = metric_ == Metric::sqeuclidean ? 0.5 : magnitude();
        bool is_decided = false;  // chebyshev: by the first of the largest
        for (std::size_t c = 0; c < delta_.size(); ++c) {
            switch (metric_) {
                case Metric::cityblock:
                    out[c] += weight * sign(delta_[c]);
                    break;
                case Metric::chebyshev:
                    if (!is_decided && std::abs(delta_[c]) == largest_) {
                        out[c] += weight * sign(delta_[c]);
                        is_decided = true;
                    }
                    break;
                case Metric::minkowski:
                    out[c] +=
                        weight * sign(delta_[c]) * std::pow(std::abs(delta_[c]) / size, p_ - 1.0);
                    break;
                case Metric::euclidean:
                case Metric::sqeuclidean:
                    out[c] += weight * delta_[c] / size;
                    break;
            }
        }
    }

   private:
    // The sum of term(|difference| / largest).
    template <class Term>
    double sum_of(Term term) const noexcept {
        double sum = 0.0;
        for (const double delta : delta_) sum += term(std::abs(delta) / largest_);
        return sum;
    }

    Metric metric_;
    double p_;
    std::vector<double> delta_;
    double largest_ = 0.0;
};

void clear(const CurveView& Q, double* gradient) {
    std::fill_n(gradient, static_cast<std::size_t>(Q.size() * Q.dim()), 0.0);
}

}  // namespace

double value_and_gradient(const DtwOptions& options, const CurveView& P, const CurveView& Q,
                          double* gradient, Control* control) {
    const Alignment alignment = dtw_path(P, Q, options, control);
    clear(Q, gradient);
    const double divisor =
        options.normalize ? static_cast<double>(P.size()) + static_cast<double>(Q.size()) : 1.0;
    const double diagonal = options.step_pattern == StepPattern::symmetric2 ? 2.0 : 1.0;
    Difference difference(options.ground, Q.dim());
    for (std::size_t k = 0; k < alignment.path.size(); ++k) {
        const auto [i, j] = alignment.path[k];
        const bool is_diagonal =
            k > 0 && i > alignment.path[k - 1][0] && j > alignment.path[k - 1][1];
        difference.move_to(P, i, Q, j);
        difference.add_gradient((is_diagonal ? diagonal : 1.0) / divisor, gradient + j * Q.dim());
    }
    return alignment.distance / divisor;
}

double value_and_gradient(const FrechetOptions& options, const CurveView& P, const CurveView& Q,
                          double* gradient, Control* control) {
    const Alignment alignment = frechet_path(P, Q, options, control);
    clear(Q, gradient);
    Difference difference(options.ground, Q.dim());
    auto decisive = alignment.path.front();
    double largest = -1.0;
    for (const auto& pair : alignment.path) {
        difference.move_to(P, pair[0], Q, pair[1]);
        const double magnitude = difference.magnitude();
        if (magnitude > largest) {
            largest = magnitude;
            decisive = pair;
        }
    }
    difference.move_to(P, decisive[0], Q, decisive[1]);
    difference.add_gradient(1.0, gradient + decisive[1] * Q.dim());
    return alignment.distance;
}

}  // namespace curvewise
