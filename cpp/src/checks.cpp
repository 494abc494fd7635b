#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace curvewise {

std::string CurveView::shape() const {
    if (is_flat()) return "(" + std::to_string(n_) + ",)";
    return "(" + std::to_string(n_) + ", " + std::to_string(dim_) + ")";
}

namespace detail {
namespace {

std::string both_shapes(const CurveView& P, const char* p_name, const CurveView& Q,
                        const char* q_name) {
    return std::string(p_name) + " has shape " + P.shape() + " and " + q_name + " has shape " +
           Q.shape();
}

std::string both_shapes(const CurveView& P, const CurveView& Q) {
    return both_shapes(P, "P", Q, "Q");
}

void check_columns(const CurveView& curve, const char* name) {
    if (curve.dim() < 1) {
        throw std::invalid_argument(std::string(name) + " has shape " + curve.shape() +
                                    "; a curve needs at least 1 coordinate");
    }
}

[[noreturn]] void throw_not_finite(const CurveView& curve, const char* name) {
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            const double value = curve(i, c);
            if (std::isfinite(value)) continue;
            const std::string place =
                std::to_string(i) + (curve.is_flat() ? "" : ", " + std::to_string(c));
            const char* what = std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
            throw std::invalid_argument(std::string(name) + "[" + place + "] is " + what +
                                        "; curves must be finite");
        }
    }
    throw std::invalid_argument(std::string(name) + " changed while it was read");
}

}  // namespace

void check_points(const CurveView& curve, const char* name, const Requirements& needs) {
    if (curve.size() >= needs.min_points) return;
    throw std::invalid_argument(std::string(name) + " has shape " + curve.shape() + "; " +
                                needs.measure + " needs at least " +
                                std::to_string(needs.min_points) +
                                (needs.min_points == 1 ? " point" : " points"));
}

void check_shape(const CurveView& curve, const char* name, const Requirements& needs) {
    check_columns(curve, name);
    if (needs.planar && curve.dim() != 2) {
        throw std::invalid_argument(std::string(name) + " has shape " + curve.shape() + "; " +
                                    needs.measure + " needs 2 coordinates, x and y");
    }
    check_points(curve, name, needs);
}

RangeScale::RangeScale(double largest_magnitude) noexcept {
    const double limit = std::ldexp(1.0, 500);
    if (largest_magnitude > limit || (largest_magnitude > 0 && largest_magnitude < 1.0 / limit)) {
        std::frexp(largest_magnitude, &exponent_);
    }
}

RangeScale RangeScale::to_unity(double magnitude) noexcept {
    RangeScale range;
    std::frexp(magnitude, &range.exponent_);
    return range;
}

double check_finite(const CurveView& curve, const char* name) {
    double largest = 0.0;
    double poison = 0.0;  // stays 0 while every entry is finite: inf - inf and nan - nan are nan
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            const double value = curve(i, c);
            poison += value - value;
            largest = std::max(largest, std::abs(value));
        }
    }
    if (poison != 0.0) throw_not_finite(curve, name);
    return largest;
}

void check_same_dim(const CurveView& P, const char* p_name, const CurveView& Q,
                    const char* q_name) {
    check_columns(P, p_name);
    check_columns(Q, q_name);
    if (P.dim() != Q.dim()) {
        throw std::invalid_argument(both_shapes(P, p_name, Q, q_name) +
                                    "; both need the same number of coordinates");
    }
}

RangeScale check_pair(const CurveView& P, const CurveView& Q, const Requirements& needs) {
    check_same_dim(P, "P", Q, "Q");
    if (needs.planar && P.dim() != 2) {
        throw std::invalid_argument(both_shapes(P, Q) + "; " + needs.measure +
                                    " needs 2 coordinates, x and y");
    }
    check_points(P, "P", needs);
    check_points(Q, "Q", needs);
    const double largest_p = check_finite(P, "P");
    const double largest_q = check_finite(Q, "Q");
    return RangeScale(std::max(largest_p, largest_q));
}

void check_equal_shapes(const CurveView& P, const CurveView& Q, const char* measure) {
    check_columns(P, "P");
    check_columns(Q, "Q");
    if (P.size() != Q.size() || P.dim() != Q.dim()) {
        throw std::invalid_argument(both_shapes(P, Q) + "; " + measure + " needs equal shapes");
    }
    check_points(P, "P", {measure, 1, false});
}

}  // namespace detail
}  // namespace curvewise
