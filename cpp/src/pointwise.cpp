#include "curvewise/pointwise.hpp"

#include <cmath>

#include "box.hpp"
#include "checks.hpp"

namespace curvewise {
namespace {

// Sum over all entries of term(p - q), divided by `divisor`, in units that neither overflow nor
// vanish; the degree of the term undoes them.
template <class Term>
double sum_of(const CurveView& P, const CurveView& Q, const char* measure, double divisor,
              int degree, Term term) {
    detail::check_equal_shapes(P, Q, measure);
    const detail::RangeScale range = detail::check_pair(P, Q, {measure, 1, false});
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

double mse(const CurveView& P, const CurveView& Q) {
    return sum_of(P, Q, "mse", entries(P), 2, square);
}

double mae(const CurveView& P, const CurveView& Q) {
    return sum_of(P, Q, "mae", entries(P), 1, [](double delta) { return std::abs(delta); });
}

void normalize(const CurveView& P, const CurveView& C, double* out, const char* name) {
    detail::check_same_dim(P, "P", C, name);
    detail::check_points(P, "P", {"normalize", 1, false});
    detail::check_points(C, name, {"normalize", 1, false});
    detail::check_finite(P, "P");
    detail::check_finite(C, name);
    for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
        const detail::BoxSide side(P, c);
        for (std::ptrdiff_t i = 0; i < C.size(); ++i) out[i * P.dim() + c] = side.scaled(C(i, c));
    }
}

}  // namespace curvewise
