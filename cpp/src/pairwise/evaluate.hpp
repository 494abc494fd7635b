// A measure of one pair of curves: checked, prepared, computed.
#pragma once

#include <limits>
#include <type_traits>

#include "pairwise/measure.hpp"

namespace curvewise::pairwise {

// Returns the result of use(checked_p, checked_q, poller).
template <class M, class Use>
auto with_checked_pair(const M& measure, const CurveView& P, const CurveView& Q, Control* control,
                       Use use) {
    check_shapes(measure.requirements(), {P, "P"}, {Q, "Q"});
    Poller poller(control);
    poller.begin(M::steps(P.size(), 1, Q.size()));
    const bool on_sphere = measure.requirements().on_sphere;
    const CheckedCurve checked_p(P, "P", poller, on_sphere), checked_q(Q, "Q", poller, on_sphere);
    measure.check_sizes(P.size(), Q.size());
    if constexpr (std::is_void_v<decltype(use(checked_p, checked_q, poller))>) {
        use(checked_p, checked_q, poller);
        poller.finish();
    } else {
        auto result = use(checked_p, checked_q, poller);
        poller.finish();
        return result;
    }
}

// A curve that outlives what is prepared of it.
template <class Prepared>
Prepared prepared_in_place(const CheckedCurve& curve, Poller& poller) {
    if constexpr (std::is_constructible_v<Prepared, CheckedCurve, Poller&, PointsStay>) {
        if (curve.curve.row_major() != nullptr) return {curve, poller, PointsStay()};
    }
    return {curve, poller};
}

// Returns the result of use(prepared_p, prepared_q, call).
template <class M, class Use>
auto with_prepared(const M& measure, const CheckedCurve& checked_p, const CheckedCurve& checked_q,
                   Poller& poller, Use use) {
    const auto p = prepared_in_place<typename M::PreparedP>(checked_p, poller);
    const auto q = prepared_in_place<typename M::PreparedQ>(checked_q, poller);
    typename M::Memory memory;
    return use(p, q,
               Call<typename M::Memory>{std::numeric_limits<double>::infinity(), measure.workers(),
                                        poller, memory});
}

// The same of curves that are not checked.
template <class M, class Use>
auto with_pair(const M& measure, const CurveView& P, const CurveView& Q, Control* control,
               Use use) {
    return with_checked_pair(measure, P, Q, control,
                             [&](const CheckedCurve& p, const CheckedCurve& q, Poller& poller) {
                                 return with_prepared(measure, p, q, poller, use);
                             });
}

template <class M>
double evaluate(const M& measure, const CurveView& P, const CurveView& Q, Control* control) {
    return with_pair(measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
        return measure(p, q, call);
    });
}

}  // namespace curvewise::pairwise
