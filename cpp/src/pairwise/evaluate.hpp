// A measure of one pair of curves: checked, prepared, computed.
#pragma once

#include <limits>
#include <type_traits>

#include "pairwise/measure.hpp"

namespace curvewise::pairwise {

// Returns the result of use(prepared_p, prepared_q, call).
template <class M, class Use>
auto with_pair(const M& measure, const CurveView& P, const CurveView& Q, Control* control,
               Use use) {
    check_shapes(measure.requirements(), {P, "P"}, {Q, "Q"});
    Poller poller(control);
    poller.begin(M::steps(P.size(), 1, Q.size()));
    const bool on_sphere = measure.requirements().on_sphere;
    const CheckedCurve checked_p(P, "P", poller, on_sphere), checked_q(Q, "Q", poller, on_sphere);
    measure.check_sizes(P.size(), Q.size());
    const typename M::PreparedP p(checked_p, poller);
    const typename M::PreparedQ q(checked_q, poller);
    typename M::Memory memory;
    const Call<typename M::Memory> call{std::numeric_limits<double>::infinity(), measure.workers(),
                                        poller, memory};
    if constexpr (std::is_void_v<decltype(use(p, q, call))>) {
        use(p, q, call);
        poller.finish();
    } else {
        auto result = use(p, q, call);
        poller.finish();
        return result;
    }
}

template <class M>
double evaluate(const M& measure, const CurveView& P, const CurveView& Q, Control* control) {
    return with_pair(measure, P, Q, control, [&](const auto& p, const auto& q, const auto& call) {
        return measure(p, q, call);
    });
}

}  // namespace curvewise::pairwise
