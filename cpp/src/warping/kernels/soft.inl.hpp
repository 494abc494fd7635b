// The anti-diagonals of soft-DTW (soft.hpp), as plain loops over lanes without a branch, which
// compilers turn into vectors. Included inside the anonymous namespace of the kernel of each level.
// All levels give the same bits: nothing is fused, and no two lanes are added to each other.

inline double from_bits(std::uint64_t bits) noexcept {
    double number;
    std::memcpy(&number, &bits, sizeof number);
    return number;
}

inline std::uint64_t bits_of(double number) noexcept {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    return bits;
}

// A whole number of up to 2^51 that is added to it is in the last bits of the sum.
constexpr double integer_shift = 0x1.8p52;

// 2^n of a whole number n <= 0; 0 where that is less than the least normal number.
inline double power_of_two(double n) noexcept {
    const double kept = n < -1023.0 ? -1023.0 : n;
    return from_bits(bits_of(kept + (integer_shift + 1023.0)) << 52);
}

// 2^-x for |x| <= 1/2, by Taylor's series of exp, whose next term is 2e-16 of it at most.
inline double small_power_of_two(double x) noexcept {
    const double y = -x * 0.69314718055994530942;
    double sum = 1.0 / 479001600.0;
    sum = sum * y + 1.0 / 39916800.0;
    sum = sum * y + 1.0 / 3628800.0;
    sum = sum * y + 1.0 / 362880.0;
    sum = sum * y + 1.0 / 40320.0;
    sum = sum * y + 1.0 / 5040.0;
    sum = sum * y + 1.0 / 720.0;
    sum = sum * y + 1.0 / 120.0;
    sum = sum * y + 1.0 / 24.0;
    sum = sum * y + 1.0 / 6.0;
    sum = sum * y + 0.5;
    sum = sum * y + 1.0;
    return sum * y + 1.0;
}

// Compilers vectorise these loops if parameters of the loop's own function are declared not to
// overlap; for local pointers they ignore the declaration.
template <bool with_shares>
inline void fill_cells(std::ptrdiff_t low, std::ptrdiff_t high, double scale,
                       const double* __restrict cost, const double* __restrict before_mantissas,
                       const double* __restrict before_exponents,
                       const double* __restrict before_last_mantissas,
                       const double* __restrict before_last_exponents, double* __restrict mantissas,
                       double* __restrict exponents, double* __restrict shares_up,
                       double* __restrict shares_left,
                       double* __restrict shares_diagonal) noexcept {
    for (std::ptrdiff_t k = low; k <= high; ++k) {
        // The row above is one index before, the column to the left one diagonal before.
        const double up_exponent = before_exponents[k];
        const double left_exponent = before_exponents[k + 1];
        const double diagonal_exponent = before_last_exponents[k];
        const double of_either = up_exponent > left_exponent ? up_exponent : left_exponent;
        const double exponent = of_either > diagonal_exponent ? of_either : diagonal_exponent;
        const double up = before_mantissas[k] * power_of_two(up_exponent - exponent);
        const double left = before_mantissas[k + 1] * power_of_two(left_exponent - exponent);
        const double diagonal =
            before_last_mantissas[k] * power_of_two(diagonal_exponent - exponent);
        const double sum = (up + left) + diagonal;
        const double power = cost[k] * scale;
        const double rounded = (power + integer_shift) - integer_shift;
        const double whole = power < 0x1p51 ? rounded : power;
        // From 0.7 to 8.5, whose own exponent is taken off.
        const std::uint64_t bits = bits_of(sum * small_power_of_two(power - whole));
        const double own = from_bits((bits >> 52) | 0x4330000000000000) - (0x1p52 + 1023.0);
        mantissas[k + 1] = from_bits((bits & 0x000fffffffffffff) | 0x3ff0000000000000);
        exponents[k + 1] = (exponent - whole) + own;
        if constexpr (with_shares) {
            const double inverse = 1.0 / sum;
            shares_up[k + 1] = up * inverse;
            shares_left[k + 1] = left * inverse;
            shares_diagonal[k + 1] = diagonal * inverse;
        }
    }
}

template <bool with_shares>
void soft_forward(const SoftStep& step, std::ptrdiff_t low, std::ptrdiff_t high) noexcept {
    fill_cells<with_shares>(
        low, high, step.scale, step.cost, step.before.mantissas, step.before.exponents,
        step.before_last.mantissas, step.before_last.exponents, step.current.mantissas,
        step.current.exponents, step.shares.up, step.shares.left, step.shares.diagonal);
}

inline void weigh_cells(std::ptrdiff_t low, std::ptrdiff_t high, const double* __restrict next_up,
                        const double* __restrict next_left,
                        const double* __restrict next_but_one_diagonal, double* __restrict up,
                        double* __restrict left, double* __restrict diagonal,
                        double* __restrict weights) noexcept {
    for (std::ptrdiff_t k = low; k <= high; ++k) {
        // The row below is one index behind, the column to the right one diagonal behind.
        const double weight = (next_up[k + 2] + next_left[k + 1]) + next_but_one_diagonal[k + 2];
        weights[k] = weight;
        up[k + 1] *= weight;
        left[k + 1] *= weight;
        diagonal[k + 1] *= weight;
    }
}

inline void add_slopes(std::ptrdiff_t low, std::ptrdiff_t high, const double* __restrict weights,
                       const double* __restrict p, const double* __restrict q,
                       double* __restrict by_p, double* __restrict by_q) noexcept {
    for (std::ptrdiff_t k = low; k <= high; ++k) {
        const double slope = 2.0 * weights[k] * (p[k] - q[k]);
        by_p[k] += slope;
        by_q[k] -= slope;
    }
}

inline void soft_backward(const SoftBackstep& step, std::ptrdiff_t low,
                          std::ptrdiff_t high) noexcept {
    weigh_cells(low, high, step.next.up, step.next.left, step.next_but_one.diagonal,
                step.current.up, step.current.left, step.current.diagonal, step.weights);
    for (std::ptrdiff_t c = 0; c < step.dim; ++c) {
        add_slopes(low, high, step.weights, step.p + c * step.p_stride, step.q + c * step.q_stride,
                   step.by_p + c * step.p_stride, step.by_q + c * step.q_stride);
    }
}
