// Whole numbers of any size, for comparisons that rounded arithmetic cannot decide: exact sums,
// differences, products and signs. Schoolbook arithmetic on 32-bit limbs, O(k l) for a product of k
// and l limbs. The numbers compared here have about ten to thirty limbs, or a few hundred if tiny
// coordinates meet huge ones.
#pragma once

#include <cstdint>

#include "runtime/scratch.hpp"

namespace curvewise::continuous {

class Integer {
   public:
    Integer() noexcept = default;
    // `mantissa` times 2^exponent, for an exponent of at least 0.
    Integer(std::int64_t mantissa, int exponent);

    // -1, 0 or 1.
    int sign() const noexcept { return limbs_.empty() ? 0 : negative_ ? -1 : 1; }
    Integer times_power_of_two(int exponent) const;

    Integer operator-() const;
    friend Integer operator+(const Integer& a, const Integer& b);
    friend Integer operator-(const Integer& a, const Integer& b);
    friend Integer operator*(const Integer& a, const Integer& b);

   private:
    using Limbs = runtime::ScratchVector<std::uint32_t>;

    Integer(Limbs limbs, bool negative) noexcept;
    // -1, 0 or 1: how |a| lies to |b|.
    static int compare_magnitudes(const Limbs& a, const Limbs& b) noexcept;
    static Limbs sum_of_magnitudes(const Limbs& a, const Limbs& b);
    // |a| - |b|, where that is not negative.
    static Limbs difference_of_magnitudes(const Limbs& a, const Limbs& b);

    Limbs limbs_;  // the lowest first, the highest not 0; empty for 0
    bool negative_ = false;
};

}  // namespace curvewise::continuous
