// The gradients of dtw and frechet: the path is held, and the ground distances along it are
// differentiated. O(path length) beyond the path.
#include <algorithm>
#include <cmath>
#include <vector>

#include "curvewise/gradient.hpp"
#include "warping/ground_distance.hpp"

namespace curvewise {
namespace {

// Two points, one of each curve, and the differences of their coordinates.
class PointPair {
   public:
    PointPair(double order, std::ptrdiff_t dim)
        : order_(order), p_(static_cast<std::size_t>(dim)), q_(static_cast<std::size_t>(dim)) {}

    void move_to(const CurveView& P, std::ptrdiff_t i, const CurveView& Q, std::ptrdiff_t j) {
        largest_ = 0.0;
        for (std::ptrdiff_t c = 0; c < dim(); ++c) {
            p_[static_cast<std::size_t>(c)] = P(i, c);
            q_[static_cast<std::size_t>(c)] = Q(j, c);
            if (std::abs(delta(c)) > largest_) place_of_largest_ = c;
            largest_ = std::max(largest_, std::abs(delta(c)));
        }
    }

    double order() const noexcept { return order_; }
    std::ptrdiff_t dim() const noexcept { return static_cast<std::ptrdiff_t>(p_.size()); }
    double p(std::ptrdiff_t c) const noexcept { return p_[static_cast<std::size_t>(c)]; }
    double q(std::ptrdiff_t c) const noexcept { return q_[static_cast<std::size_t>(c)]; }
    double delta(std::ptrdiff_t c) const noexcept { return q(c) - p(c); }
    double sign(std::ptrdiff_t c) const noexcept {
        return static_cast<double>((delta(c) > 0.0) - (delta(c) < 0.0));
    }
    double largest() const noexcept { return largest_; }  // |difference|, and the first of them
    std::ptrdiff_t place_of_largest() const noexcept { return place_of_largest_; }

    // The sum of term(|difference| / largest).
    template <class Term>
    double sum_of(Term term) const noexcept {
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < dim(); ++c) sum += term(std::abs(delta(c)) / largest_);
        return sum;
    }

   private:
    double order_;
    std::vector<double> p_, q_;
    double largest_ = 0.0;
    std::ptrdiff_t place_of_largest_ = 0;
};

// What is larger where the points' distance is; 0 where they coincide.
template <class Row>
double magnitude(const PointPair& at) noexcept {
    return at.largest() == 0.0 ? 0.0 : Row::magnitude(at);
}

// Adds weight times the derivative by the point of Q; nothing where the points coincide.
template <class Row>
void add_gradient(const PointPair& at, double weight, double* out) noexcept {
    if (at.largest() == 0.0) return;
    const double size = Row::magnitude(at);
    for (std::ptrdiff_t c = 0; c < at.dim(); ++c) out[c] += Row::slope(at, c, weight, size);
}

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
    PointPair at(options.ground.p, Q.dim());
    warping::with_row(warping::named_metric(options.ground), [&](auto row) {
        for (std::size_t k = 0; k < alignment.path.size(); ++k) {
            const auto [i, j] = alignment.path[k];
            const bool is_diagonal =
                k > 0 && i > alignment.path[k - 1][0] && j > alignment.path[k - 1][1];
            at.move_to(P, i, Q, j);
            add_gradient<decltype(row)>(at, (is_diagonal ? diagonal : 1.0) / divisor,
                                        gradient + j * Q.dim());
        }
    });
    return alignment.distance / divisor;
}

double value_and_gradient(const FrechetOptions& options, const CurveView& P, const CurveView& Q,
                          double* gradient, Control* control) {
    const Alignment alignment = frechet_path(P, Q, options, control);
    clear(Q, gradient);
    PointPair at(options.ground.p, Q.dim());
    warping::with_row(warping::named_metric(options.ground), [&](auto row) {
        using Row = decltype(row);
        auto decisive = alignment.path.front();
        double largest = -1.0;
        for (const auto& pair : alignment.path) {
            at.move_to(P, pair[0], Q, pair[1]);
            const double found = magnitude<Row>(at);
            if (found > largest) {
                largest = found;
                decisive = pair;
            }
        }
        at.move_to(P, decisive[0], Q, decisive[1]);
        add_gradient<Row>(at, 1.0, gradient + decisive[1] * Q.dim());
    });
    return alignment.distance;
}

}  // namespace curvewise
