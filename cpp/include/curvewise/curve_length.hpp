/// \file
/// The curve-length measure: OF2 of Andrade-Campos, de-Carvalho & Valente (2012). Point i of P, at
/// arc length s_i of L_P, is compared with the point of Q at s_i L_Q / L_P. Each curve's lengths
/// are measured after division by its own largest |x| and |y|. The value is
///
///     sqrt(sum over i of ln(1 + |dx_i / x_scale|)^2 + ln(1 + |dy_i / y_scale|)^2)
///
/// It is without units, and not symmetric. Time O(n + m), memory O(n + m). Throws
/// std::invalid_argument for a curve that is not finite, has fewer than 2 points, not 2
/// coordinates, or no length, and if the scale is 0. Throws std::bad_alloc and Stopped. Safe from
/// any number of threads.
///
///     curvewise::CurveLengthOptions options;
///     options.scale = curvewise::LengthScale::mean_abs;   // a loop, centred on zero
///     const double value = curvewise::curve_length(experiment, simulation, options);
#pragma once

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/options.hpp"

namespace curvewise {

class Control;

/// The divisor of the differences in x (and in y), each taken over P.
enum class LengthScale {
    mean,      ///< the paper's; 0 or nearly so for loops centred on zero
    mean_abs,  ///< the mean of |x|
    range      ///< max x - min x
};

/// The names of the enumerators, in their order.
constexpr auto choice_names(LengthScale /*scale*/) noexcept {
    return names_up_to<LengthScale::range>("mean", "mean_abs", "range");
}

/// Options of curve_length().
struct CurveLengthOptions {
    static constexpr const char* measure = "curve_length";
    static constexpr bool is_planar = true;  ///< for curves of two coordinates only

    LengthScale scale = LengthScale::mean;

    static constexpr bool is_symmetric() noexcept { return false; }
    /// The elementary steps, of some nanoseconds each, that curves of n and m points take, roughly.
    static constexpr double work(double n, double m, double /*dim*/) noexcept { return n + m; }
};

/// Calls visit() with the name and the value of each option (options.hpp).
template <class Visit>
void visit_options(CurveLengthOptions& options, Visit&& visit) {
    visit("scale", options.scale);
}

/// The norm of the residuals: dimensionless.
[[nodiscard]] CURVEWISE_EXPORT double curve_length(const CurveView& P, const CurveView& Q,
                                                   const CurveLengthOptions& options = {},
                                                   Control* control = nullptr);

/// For a least-squares solver: writes r_x to out[2 i] and r_y to out[2 i + 1] for every point of P,
/// 2 P.size() numbers. The measure is their Euclidean norm.
CURVEWISE_EXPORT void curve_length_residuals(const CurveView& P, const CurveView& Q, double* out,
                                             const CurveLengthOptions& options = {},
                                             Control* control = nullptr);

/// For code that treats all measures in the same way (measure.hpp).
[[nodiscard]] inline double evaluate(const CurveLengthOptions& options, const CurveView& P,
                                     const CurveView& Q, Control* control = nullptr) {
    return curve_length(P, Q, options, control);
}

}  // namespace curvewise
