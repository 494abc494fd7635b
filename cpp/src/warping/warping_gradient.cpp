// The gradients of dtw and frechet: the path is held, and the ground distances along it are
// differentiated. O(path length) beyond the path.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "curves/moved_curve.hpp"
#include "curves/sphere.hpp"
#include "curvewise/gradient.hpp"
#include "runtime/scratch.hpp"
#include "warping/dtw_recurrence.hpp"
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

    // For longitudes and latitudes: by coordinate c of the point of Q.
    double half_chord() const noexcept {
        const auto p = curves::on_sphere(p_[0], p_[1]), q = curves::on_sphere(q_[0], q_[1]);
        return std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    }
    double slope_on_sphere(std::ptrdiff_t c) const noexcept {
        const curves::SlopeOnSphere slope = curves::slope_on_sphere(p_.data(), q_.data());
        return order_ * (c == 0 ? slope.by_longitude : slope.by_latitude);
    }
    void turn() noexcept { p_.swap(q_); }

    // The sum of term(|difference| / largest).
    template <class Term>
    double sum_of(Term term) const noexcept {
        double sum = 0.0;
        for (std::ptrdiff_t c = 0; c < dim(); ++c) sum += term(std::abs(delta(c)) / largest_);
        return sum;
    }

   private:
    double order_;
    runtime::ScratchVector<double> p_, q_;
    double largest_ = 0.0;
    std::ptrdiff_t place_of_largest_ = 0;
};

// A number that grows with the points' distance; 0 if they coincide.
template <class Row>
double magnitude(const PointPair& at) noexcept {
    return at.largest() == 0.0 ? 0.0 : Row::magnitude(at);
}

// What the derivatives are added to: point by point, or nowhere.
class Sums {
   public:
    Sums(const Gradients& out, const CurveView& P, const CurveView& Q) : out_(out), dim_(Q.dim()) {
        clear(out.by_p, P);
        clear(out.by_q, Q);
    }

    // Adds the weight times the derivative by both points; nothing if they coincide. All ground
    // distances are symmetric, and depend on differences alone, except for those of degree 0.
    template <class Row>
    void add(PointPair& at, std::ptrdiff_t i, std::ptrdiff_t j, double weight) noexcept {
        if (at.largest() == 0.0) return;
        const double size = Row::magnitude(at);
        if (!(size > 0.0)) return;
        for (std::ptrdiff_t c = 0; c < dim_; ++c) {
            const double slope = Row::slope(at, c, weight, size);
            if (out_.by_q != nullptr) out_.by_q[j * dim_ + c] += slope;
            if (out_.by_p == nullptr) continue;
            if constexpr (Row::degree == 0) {
                at.turn();
                out_.by_p[i * dim_ + c] += Row::slope(at, c, weight, size);
                at.turn();
            } else {
                out_.by_p[i * dim_ + c] -= slope;
            }
        }
    }

   private:
    static void clear(double* out, const CurveView& curve) noexcept {
        if (out != nullptr) std::fill_n(out, curve.size() * curve.dim(), 0.0);
    }

    Gradients out_;
    std::ptrdiff_t dim_;
};

}  // namespace

double value_and_gradients(const DtwOptions& options, const CurveView& P, const CurveView& Q,
                           const Gradients& out, Control* control) {
    DtwOptions strict = options;
    strict.relax = {};  // the steps of a relaxed path are the same
    if (!warping::is_swept_by_dtw(strict)) {
        throw std::invalid_argument(
            "a gradient needs step_pattern='symmetric1' or 'symmetric2' and no penalty");
    }
    warping::refuse_own_distances(options.ground);
    const Alignment alignment = dtw_path(P, Q, options, control);
    Sums sums(out, P, Q);
    const double divisor =
        options.normalize ? static_cast<double>(P.size()) + static_cast<double>(Q.size()) : 1.0;
    const double diagonal = options.step_pattern == StepPattern::symmetric2 ? 2.0 : 1.0;
    PointPair at(options.ground.parameter(), Q.dim());
    warping::with_row(warping::named_metric(options.ground), [&](auto row) {
        for (std::size_t k = 0; k < alignment.path.size(); ++k) {
            const auto [i, j] = alignment.path[k];
            const bool is_diagonal =
                k > 0 && i > alignment.path[k - 1][0] && j > alignment.path[k - 1][1];
            at.move_to(P, i, Q, j);
            sums.add<decltype(row)>(at, i, j, (is_diagonal ? diagonal : 1.0) / divisor);
        }
    });
    return alignment.distance / divisor;
}

namespace {

// Relative to the distance: pairs that tie.
constexpr double tied = 1e-13;

// The pair of a path that is furthest apart, and whether it is the only one.
struct Decisive {
    std::array<std::int64_t, 2> pair;
    bool is_alone;
};

template <class Row>
Decisive decisive_of(const std::vector<std::array<std::int64_t, 2>>& path, const CurveView& P,
                     const CurveView& Q, PointPair& at) {
    Decisive found{path.front(), true};
    double largest = -1.0;
    for (const auto& pair : path) {
        at.move_to(P, pair[0], Q, pair[1]);
        const double size = magnitude<Row>(at);
        if (size > largest) {
            found = {pair, size * (1.0 - tied) > largest};
            largest = size;
        } else if (size >= largest * (1.0 - tied)) {
            found.is_alone = false;
        }
    }
    return found;
}

}  // namespace

// Every path of the least distance visits the deciding pair. If several pairs of a path are as far
// apart, one is taken that decides after both curves have been moved by at most 2^-30 of the
// distance.
double value_and_gradients(const FrechetOptions& options, const CurveView& P, const CurveView& Q,
                           const Gradients& out, Control* control) {
    warping::refuse_own_distances(options.ground);
    const Alignment alignment = frechet_path(P, Q, options, control);
    Sums sums(out, P, Q);
    if (alignment.distance == 0.0) return 0.0;
    PointPair at(options.ground.parameter(), Q.dim());
    warping::with_row(warping::named_metric(options.ground), [&](auto row) {
        using Row = decltype(row);
        Decisive decisive = decisive_of<Row>(alignment.path, P, Q, at);
        at.move_to(P, decisive.pair[0], Q, decisive.pair[1]);
        if (!decisive.is_alone) {
            std::minstd_rand random;
            const curves::MovedCurve p(P, at.largest(), random);
            const curves::MovedCurve q(Q, at.largest(), random);
            const Alignment moved = frechet_path(p.view(), q.view(), options, control);
            decisive = decisive_of<Row>(moved.path, p.view(), q.view(), at);
            at.move_to(P, decisive.pair[0], Q, decisive.pair[1]);
        }
        sums.add<Row>(at, decisive.pair[0], decisive.pair[1], 1.0);
    });
    return alignment.distance;
}

}  // namespace curvewise
