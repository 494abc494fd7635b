/// \file
/// The list of measures. Code that treats all of them in the same way (batches, compare, the C
/// interface, a language binding) uses this list: it then includes each measure that is added here.
///
///     curvewise::for_each_measure([](const auto& defaults) { std::puts(defaults.measure); });
#pragma once

#include <variant>

#include "curvewise/area.hpp"
#include "curvewise/curve_length.hpp"
#include "curvewise/dtw.hpp"
#include "curvewise/edit_distances.hpp"
#include "curvewise/frechet.hpp"
#include "curvewise/frechet_continuous.hpp"
#include "curvewise/hausdorff.hpp"
#include "curvewise/hausdorff_continuous.hpp"
#include "curvewise/pcm.hpp"

namespace curvewise {

namespace detail {
template <class... Options, class... More>
std::variant<Options..., More...> joined(const std::variant<Options...>*,
                                         const std::variant<More...>*);
using SingleMeasure =
    std::variant<AreaOptions, PcmOptions, FrechetOptions, DtwOptions, CurveLengthOptions,
                 FrechetContinuousOptions, HausdorffOptions, HausdorffContinuousOptions>;
}  // namespace detail

/// A measure, chosen by the type of its options.
using Measure = decltype(detail::joined(static_cast<const detail::SingleMeasure*>(nullptr),
                                        static_cast<const EditDistance*>(nullptr)));

namespace detail {
template <class Visit, class... Options>
void for_each_alternative(const std::variant<Options...>* /*type*/, Visit&& visit) {
    (visit(Options{}), ...);
}
}  // namespace detail

/// Calls visit(options), with the default options of every measure in the order of the list.
template <class Visit>
void for_each_measure(Visit&& visit) {
    detail::for_each_alternative(static_cast<const Measure*>(nullptr), visit);
}

/// The measure of P and Q. Throws the errors of the measure's own function.
[[nodiscard]] CURVEWISE_EXPORT double evaluate(const Measure& measure, const CurveView& P,
                                               const CurveView& Q, Control* control = nullptr);

}  // namespace curvewise
