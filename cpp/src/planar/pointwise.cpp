#include "curvewise/pointwise.hpp"

#include <algorithm>
#include <cmath>

#include "curves/box.hpp"
#include "curves/checks.hpp"
#include "curves/range_scale.hpp"
#include "curvewise/gradient.hpp"

namespace curvewise {
namespace {

// Sum over all entries of term(p - q), divided by `divisor`, in units that neither overflow nor
// vanish; the degree of the term undoes them.
template <class Term>
double sum_of(const CurveView& P, const CurveView& Q, const char* measure, double divisor,
              int degree, Term term) {
    detail::check_equal_shapes(P, Q, measure);
    const detail::CheckedCurve checked_p(P, "P"), checked_q(Q, "Q");
    const detail::RangeScale range(std::max(checked_p.largest, checked_q.largest));
    double sum = 0.0;
    for (std::ptrdiff_t i = 0; i < P.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
            sum += term(range.shrink(P(i, c)) - range.shrink(Q(i, c)));
        }
    }
    return range.restore(sum / divisor, degree);
}

double square(double delta) noexcept { return delta * delta; }

double entries(const CurveView& P) noexcept { return static_cast<double>(P.size() * P.dim()); }

}  // namespace

double sum_of_squares(const CurveView& P, const CurveView& Q) {
    return sum_of(P, Q, "sum_of_squares", 1.0, 2, square);
}

double sum_of_squares_and_gradient(const CurveView& P, const CurveView& Q, double* gradient) {
    const double value = sum_of_squares(P, Q);
    for (std::ptrdiff_t i = 0; i < Q.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < Q.dim(); ++c) {
            gradient[i * Q.dim() + c] = 2.0 * (Q(i, c) - P(i, c));
        }
    }
    return value;
}

double mse(const CurveView& P, const CurveView& Q) {
    return sum_of(P, Q, "mse", entries(P), 2, square);
}

double mae(const CurveView& P, const CurveView& Q) {
    return sum_of(P, Q, "mae", entries(P), 1, [](double delta) { return std::abs(delta); });
}

void normalize(const CurveView& P, const CurveView& C, double* out, const char* name) {
    detail::check_shapes({"normalize", 1, false}, {P, "P"}, {C, name});
    const detail::CheckedCurve checked_p(P, "P"), checked_c(C, name);
    for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
        const detail::BoxSide side(P, c);
        for (std::ptrdiff_t i = 0; i < C.size(); ++i) out[i * P.dim() + c] = side.scaled(C(i, c));
    }
}

}  // namespace curvewise
