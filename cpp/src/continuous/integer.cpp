#include "continuous/integer.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace curvewise::continuous {
namespace {

constexpr int limb_bits = 32;

std::uint32_t low_limb(std::uint64_t x) noexcept { return static_cast<std::uint32_t>(x); }

}  // namespace

Integer::Integer(Limbs limbs, bool negative) noexcept
    : limbs_(std::move(limbs)), negative_(negative) {
    while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
}

Integer::Integer(std::int64_t mantissa, int exponent) : negative_(mantissa < 0) {
    const auto bits = static_cast<std::uint64_t>(mantissa);
    const std::uint64_t magnitude = negative_ ? 0 - bits : bits;
    *this = Integer({low_limb(magnitude), low_limb(magnitude >> limb_bits)}, negative_)
                .times_power_of_two(exponent);
}

Integer Integer::times_power_of_two(int exponent) const {
    if (limbs_.empty()) return {};
    const auto zeros = static_cast<std::size_t>(exponent / limb_bits);
    const int shift = exponent % limb_bits;
    Limbs limbs(zeros, 0);
    limbs.reserve(zeros + limbs_.size() + 1);
    std::uint64_t carry = 0;
    for (const std::uint32_t limb : limbs_) {
        carry |= static_cast<std::uint64_t>(limb) << shift;
        limbs.push_back(low_limb(carry));
        carry >>= limb_bits;
    }
    limbs.push_back(low_limb(carry));
    return {std::move(limbs), negative_};
}

int Integer::compare_magnitudes(const Limbs& a, const Limbs& b) noexcept {
    if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
    for (std::size_t k = a.size(); k-- > 0;) {
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    }
    return 0;
}

Integer::Limbs Integer::sum_of_magnitudes(const Limbs& a, const Limbs& b) {
    const Limbs& longer = a.size() < b.size() ? b : a;
    const Limbs& shorter = a.size() < b.size() ? a : b;
    Limbs sum;
    sum.reserve(longer.size() + 1);
    std::uint64_t carry = 0;
    for (std::size_t k = 0; k < longer.size(); ++k) {
        carry += longer[k];
        if (k < shorter.size()) carry += shorter[k];
        sum.push_back(low_limb(carry));
        carry >>= limb_bits;
    }
    sum.push_back(low_limb(carry));
    return sum;
}

Integer::Limbs Integer::difference_of_magnitudes(const Limbs& a, const Limbs& b) {
    Limbs difference;
    difference.reserve(a.size());
    std::uint64_t borrow = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const std::uint64_t taken = borrow + (k < b.size() ? b[k] : 0);
        borrow = a[k] < taken ? 1 : 0;
        difference.push_back(low_limb(a[k] - taken));
    }
    return difference;
}

Integer Integer::operator-() const { return {limbs_, !negative_}; }

Integer operator+(const Integer& a, const Integer& b) {
    if (a.negative_ == b.negative_) {
        return {Integer::sum_of_magnitudes(a.limbs_, b.limbs_), a.negative_};
    }
    if (Integer::compare_magnitudes(a.limbs_, b.limbs_) < 0) {
        return {Integer::difference_of_magnitudes(b.limbs_, a.limbs_), b.negative_};
    }
    return {Integer::difference_of_magnitudes(a.limbs_, b.limbs_), a.negative_};
}

Integer operator-(const Integer& a, const Integer& b) { return a + (-b); }

Integer operator*(const Integer& a, const Integer& b) {
    if (a.limbs_.empty() || b.limbs_.empty()) return {};
    Integer::Limbs product(a.limbs_.size() + b.limbs_.size(), 0);
    for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
        std::uint64_t carry = 0;
        for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
            carry += product[i + j] + static_cast<std::uint64_t>(a.limbs_[i]) * b.limbs_[j];
            product[i + j] = low_limb(carry);
            carry >>= limb_bits;
        }
        product[i + b.limbs_.size()] = low_limb(carry);
    }
    return {std::move(product), a.negative_ != b.negative_};
}

}  // namespace curvewise::continuous
