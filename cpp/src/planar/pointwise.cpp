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
              int degree, Control* control, Term term) {
    curves::check_equal_shapes(P, Q, measure);
    runtime::Poller poller(control);
    poller.begin(P.size() + Q.size());
    const curves::CheckedCurve checked_p(P, "P", poller), checked_q(Q, "Q", poller);
    const curves::RangeScale range(std::max(checked_p.largest, checked_q.largest));
    double sum = 0.0;
    poller.in_runs(P.size(), P.dim(), [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = first; i < end; ++i) {
            for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
                sum += term(range.shrink(P(i, c)) - range.shrink(Q(i, c)));
            }
        }
    });
    poller.finish();
    return range.restore(sum / divisor, degree);
}

double square(double delta) noexcept { return delta * delta; }

double entries(const CurveView& P) noexcept { return static_cast<double>(P.size() * P.dim()); }

}  // namespace

double sum_of_squares(const CurveView& P, const CurveView& Q, Control* control) {
    return sum_of(P, Q, "sum_of_squares", 1.0, 2, control, square);
}

double sum_of_squares_and_gradient(const CurveView& P, const CurveView& Q, double* gradient,
                                   Control* control) {
    const double value = sum_of_squares(P, Q, control);
    runtime::Poller poller(control);
    poller.in_runs(Q.size(), Q.dim(), [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = first; i < end; ++i) {
            for (std::ptrdiff_t c = 0; c < Q.dim(); ++c) {
                gradient[i * Q.dim() + c] = 2.0 * (Q(i, c) - P(i, c));
            }
        }
    });
    return value;
}

double mse(const CurveView& P, const CurveView& Q, Control* control) {
    return sum_of(P, Q, "mse", entries(P), 2, control, square);
}

double mae(const CurveView& P, const CurveView& Q, Control* control) {
    return sum_of(P, Q, "mae", entries(P), 1, control,
                  [](double delta) { return std::abs(delta); });
}

void normalize(const CurveView& P, const CurveView& C, double* out, const char* name,
               Control* control) {
    curves::check_shapes({"normalize", 1, false}, {P, "P"}, {C, name});
    runtime::Poller poller(control);
    poller.begin(P.size() + C.size());
    const curves::CheckedCurve checked_p(P, "P", poller), checked_c(C, name, poller);
    for (std::ptrdiff_t c = 0; c < P.dim(); ++c) {
        const curves::BoxSide side(P, c);
        poller.in_runs(C.size(), 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
            for (std::ptrdiff_t i = first; i < end; ++i)
                out[i * P.dim() + c] = side.scaled(C(i, c));
        });
    }
    poller.finish();
}

}  // namespace curvewise
