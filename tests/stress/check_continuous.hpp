// frechet_continuous against the textbook (textbook_continuous.hpp). In whole numbers, both ends of
// its interval are compared exactly, for curves multiplied by any power of two and moved by any
// distance. Elsewhere, decisions with 113 bits are compared just at and just below its value.
// Changes that keep the real number must give bitwise identical results.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "check_warping.hpp"
#include "curvewise/curvewise.hpp"
#include "hard_curves.hpp"
#include "record.hpp"
#include "textbook_continuous.hpp"

namespace stress {

class ContinuousCheck {
   public:
    ContinuousCheck(Choices& choices, Record& record, const Curve& P, const Curve& Q)
        : choices_(choices),
          record_(record),
          P_(P),
          Q_(Q),
          with_{"", {{"P", &P}, {"Q", &Q}}},
          value_(curvewise::frechet_continuous(P, Q)) {}

    void run(Kind kind) {
        if (kind == Kind::lattice) check_whole_numbers();
        if (textbook::has_113_bits && is_tame(kind) && P_.dim() <= 3) check_decisions_in_reals();
        check_bounds();
        check_the_same_number();
        check_ways();
        if (is_tame(kind)) check_matching();
    }

   private:
    void check_whole_numbers() const {
        const textbook::Ratio square = textbook::continuous_square(P_, Q_);
        const curvewise::Interval bounds = curvewise::frechet_continuous_bounds(P_, Q_);
        const int low = compare_with_root(bounds.low, square);
        const int high = compare_with_root(bounds.high, square);
        // The least double that is not below the root, and the largest that is not above it.
        record_.is_true("frechet_continuous in whole numbers",
                        low <= 0 && high >= 0 && (low == 0) == (high == 0) && bounds.high == value_,
                        with_, Record::both(bounds.low, bounds.high));
        const int k = static_cast<int>(choices_.between(-1000, 900));
        record_.same(
            "frechet_continuous times a power of two",
            curvewise::frechet_continuous(P_.times_power_of_two(k), Q_.times_power_of_two(k)),
            std::ldexp(value_, k), with_);
        check_decisions_in_whole_numbers(square, k);
        Curve p = P_, q = Q_;
        const double far = std::ldexp(1.0, static_cast<int>(choices_.between(3, 49)));
        for (Curve* curve : {&p, &q}) {
            for (std::ptrdiff_t i = 0; i < curve->size(); ++i) {
                for (std::ptrdiff_t c = 0; c < curve->dim(); ++c) (*curve)(i, c) += far;
            }
        }
        record_.same("frechet_continuous moved", curvewise::frechet_continuous(p, q), value_,
                     with_);
    }

    // At radii around the value, and at whole numbers, where many pairs of vertices are just
    // within.
    void check_decisions_in_whole_numbers(const textbook::Ratio& square, int exponent) const {
        const Curve p = P_.times_power_of_two(exponent), q = Q_.times_power_of_two(exponent);
        const double infinity = std::numeric_limits<double>::infinity();
        for (const double radius :
             {std::nextafter(value_, 0.0), value_, std::nextafter(value_, infinity),
              value_ * choices_.uniform(0.0, 2.0), value_ * choices_.uniform(0.8, 1.2),
              static_cast<double>(choices_.between(0, 9))}) {
            const bool expected = compare_with_root(radius, square) >= 0;
            const auto is_right = [&](bool is_within) {
                record_.is_true("frechet_within in whole numbers", is_within == expected, with_,
                                std::to_string(radius));
            };
            is_right(curvewise::frechet_within(P_, Q_, radius));
            is_right(curvewise::frechet_within(Q_, P_, radius));
            const double scaled = std::ldexp(radius, exponent);
            if (std::ldexp(scaled, -exponent) != radius) continue;  // beyond the range of a double
            is_right(curvewise::frechet_within(p, q, scaled));
        }
    }

    // One part in 2^90 aside: a value that is a double itself must not depend on the rounding of
    // the textbook. If curves nearly coincide, 113 bits are too few for the remainder of the
    // squares.
    void check_decisions_in_reals() const {
        using textbook::Real;
        if (value_ < 1e-3) {
            record_.skip("frechet_continuous in 113 bits: the curves nearly coincide");
            return;
        }
        const Real a_little = 0x1p-90L, value = value_;
        record_.is_true("frechet_continuous long enough, in 113 bits",
                        is_long_enough(textbook::RealRule(value * (1 + a_little)), P_, Q_), with_);
        if (value_ == 0.0) return;
        const Real below = std::nextafter(value_, 0.0);
        record_.is_true("frechet_continuous not longer, in 113 bits",
                        !is_long_enough(textbook::RealRule(below * (1 - a_little)), P_, Q_), with_);
    }

    void check_bounds() const {
        const curvewise::Interval bounds = curvewise::frechet_continuous_bounds(P_, Q_);
        record_.same("frechet_continuous_bounds", bounds.high, value_, with_);
        const double below = std::nextafter(value_, 0.0);
        record_.is_true("frechet_continuous_bounds, width",
                        bounds.low == value_ || bounds.low == below, with_);
        record_.is_true("frechet_within the value", curvewise::frechet_within(P_, Q_, value_),
                        with_);
        if (value_ > 0.0) {
            record_.is_true("frechet_within less", !curvewise::frechet_within(P_, Q_, below),
                            with_);
        }
    }

    void check_the_same_number() const {
        record_.same("frechet_continuous(Q, P)", curvewise::frechet_continuous(Q_, P_), value_,
                     with_);
        record_.same("frechet_continuous of reversed curves",
                     curvewise::frechet_continuous(reversed(P_), reversed(Q_)), value_, with_);
        record_.same("frechet_continuous of a curve and itself",
                     curvewise::frechet_continuous(P_, P_), 0.0, with_);
    }

    void check_ways() const {
        const curvewise_curve p = as_c(P_), q = as_c(Q_);
        double found = -1.0;
        curvewise_frechet_continuous(&p, &q, nullptr, &found, nullptr);
        record_.same("frechet_continuous through C", found, value_, with_);
        const curvewise::BatchOptions batch{any_workers(choices_), any_cutoff(choices_, value_)};
        curvewise::cdist({P_}, {Q_, P_}, curvewise::FrechetContinuousOptions{}, pair_, batch);
        record_.same("frechet_continuous, cdist", pair_[0], cut(value_, batch.cutoff), with_);
        const curvewise::Prepared prepared(P_, curvewise::FrechetContinuousOptions{});
        record_.same("frechet_continuous, Prepared", prepared(Q_), value_, with_);
        const curvewise::Index index({P_, Q_}, curvewise::FrechetContinuousOptions{});
        double distances[2];
        std::int64_t places[2];
        index.kneighbors({P_}, 2, distances, places);
        record_.same("frechet_continuous, Index", distances[1], value_, with_);
    }

    void check_matching() const {
        const curvewise::Matching found = curvewise::frechet_continuous_path(P_, Q_);
        bool holds =
            found.distance >= value_ && found.distance <= value_ * (1.0 + 1e-12) + 1e-13 &&
            found.parameters.front() == std::array<double, 2>{0.0, 0.0} &&
            found.parameters.back() == std::array<double, 2>{static_cast<double>(P_.size() - 1),
                                                             static_cast<double>(Q_.size() - 1)};
        for (std::size_t k = 1; k < found.parameters.size(); ++k) {
            for (std::size_t side = 0; side < 2; ++side) {
                const double from = found.parameters[k - 1][side];
                const double to = found.parameters[k][side];
                holds = holds && from <= to && to <= std::floor(from) + 1.0;
            }
        }
        record_.is_true("frechet_continuous_path", holds, with_);
    }

    static Curve reversed(const Curve& curve) {
        Curve result = curve;
        for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
            for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
                result(i, c) = curve(curve.size() - 1 - i, c);
            }
        }
        return result;
    }

    Choices& choices_;
    Record& record_;
    const Curve& P_;
    const Curve& Q_;
    About with_;
    double value_;
    mutable double pair_[2] = {-1.0, -1.0};
};

inline std::ptrdiff_t check_continuous(Choices& choices, Record& record) {
    const Kind kind = any_kind(choices);
    HardCurves curves(choices, kind, any_dimension(choices));
    const std::ptrdiff_t most = kind == Kind::lattice ? 7 : 10;
    const Curve P = curves.curve(choices.between(1, most));
    Curve Q = curves.other(P, choices.between(1, most));
    if (kind == Kind::lattice) {  // A curve made from P may have left the whole numbers.
        for (std::ptrdiff_t i = 0; i < Q.size(); ++i) {
            for (std::ptrdiff_t c = 0; c < Q.dim(); ++c) {
                Q(i, c) = std::round(std::fmin(std::fmax(Q(i, c), -4.0), 4.0));
            }
        }
    }
    ContinuousCheck(choices, record, P, Q).run(kind);
    return 1;
}

}  // namespace stress
