// The Yoshida-Uemori point: elastic steps, the stagnation surface, and flow
// (yoshida_uemori_flow.hpp) in between. O(1) a step.
#pragma once

#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

#include "curvewise/materials.hpp"
#include "materials/law.hpp"
#include "materials/path.hpp"
#include "materials/yoshida_uemori_flow.hpp"

namespace curvewise::materials {

template <class Number>
std::vector<double> values_of(const Number* numbers, std::size_t count) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = value_of(numbers[i]);
    return values;
}

template <class Number>
class YoshidaUemoriPoint {
   public:
    YoshidaUemoriPoint(const YoshidaUemori& material, const Number* parameters, std::size_t count)
        : k_(material, parameters), plain_(material, values_of(parameters, count).data()) {}

    // The stress after a further increment of strain.
    template <class Increment>
    Number advance(const Increment& increment) {
        const Number slope = k_.modulus.after(p_), trial = stress_ + slope * increment;
        const Number size = k_.CB + R_ - k_.Y;
        const Number middle = size * u_ * (value_of(u_) < 0.0 ? -u_ : u_) + centre_;
        const double n = value_of(trial) < value_of(middle) ? -1.0 : 1.0;
        const Number excess = n * (trial - middle) - k_.Y;
        if (value_of(excess) <= rounding()) return stress_ = trial;
        return stress_ = flow(n, excess / slope);
    }

   private:
    // Of stresses, in units of the largest that hardening leads to. Where a strain is held, the
    // trial stress is behind the yield point by no more, and no flow can be told from it.
    double rounding() const {
        constexpr double share = 64.0 * std::numeric_limits<double>::epsilon();
        return share * (plain_.CB + value_of(R_) + plain_.SB);
    }
    // The stress after plastic flow in the direction n, by `strain` behind the yield point.
    Number flow(double n, const Number& strain) {
        const Number bound = stagnation_size_ + n * stagnation_centre_;
        const Number reached = contact(n, bound);
        Course<Number> course(k_, {k_, R_, n * centre_, p_, reached}, n * u_, strain);
        if constexpr (std::is_same_v<Number, double>) {
            Follower<Number>(course, course, series_).run();
        } else {
            Course<double> plain(
                plain_,
                {plain_, value_of(R_), n * value_of(centre_), value_of(p_), value_of(reached)},
                n * value_of(u_), value_of(strain));
            Follower<Number>(course, plain, series_).run();
        }
        return flowed(n, bound, course);
    }
    // The stress at the end of a branch, from which the next step begins.
    Number flowed(double n, const Number& bound, const Course<Number>& course) {
        const FlowState<Number>& end = course.state;
        const auto& reached = course.bound;
        const bool is_growing = course.branch.is_growing();
        touched_ = is_growing ? n : n == touched_ ? n : 0.0;
        if (is_growing) {
            // The stagnation surface is pushed along: H of the way it grows, the rest it moves.
            const Number pushed = reached.centre - bound;
            stagnation_size_ += k_.H * pushed;
            stagnation_centre_ += n * (pushed - k_.H * pushed);
        }
        p_ += end.p;
        R_ = reached.R;
        u_ = n * end.u;
        centre_ = n * reached.centre;
        return n * (k_.Y + course.height(end.u, reached));
    }

    // The plastic strain after which the bounding surface's centre reaches `bound`, where the
    // stagnation surface ends.
    Number contact(double n, const Number& bound) const {
        if (touched_ == n) return Number(0.0);
        const Number left = k_.SB - bound;
        if (value_of(k_.K) == 0.0 || value_of(left) <= 0.0) return Number(never);
        const Number ratio = left / (k_.SB - n * centre_);
        return value_of(ratio) >= 1.0 ? Number(0.0) : -log(ratio) / k_.K;
    }

    Constants<Number> k_;
    Constants<double> plain_;
    typename Follower<Number>::Series series_;
    Number stress_{}, p_{}, R_{}, u_{}, centre_{};
    Number stagnation_size_{}, stagnation_centre_{};
    double touched_ = 0.0;  // the direction in which the stagnation surface was pushed last
};

template <>
struct Law<YoshidaUemori> {
    template <class Number>
    using Point = YoshidaUemoriPoint<Number>;
    static std::vector<MaterialParameter> parameters(const YoshidaUemori& material);
    static void check(const YoshidaUemori& material, const Parameters& given);
    static double largest_stress(const YoshidaUemori& material, const Parameters& checked,
                                 const StrainPath& path);
};

}  // namespace curvewise::materials
