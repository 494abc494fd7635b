// Values and derivatives of many pairs: a pair at a time to each thread (see gradient.hpp).
#include <chrono>
#include <stdexcept>
#include <string>

#include "curvewise/gradient.hpp"
#include "runtime/workers.hpp"

namespace curvewise {
using runtime::Poller;

void values_and_gradients(const DifferentiableMeasure& measure, const std::vector<CurveView>& P,
                          const std::vector<CurveView>& Q, double* values,
                          const std::vector<Gradients>& out, std::ptrdiff_t workers,
                          Control* control) {
    if (P.size() != Q.size() || P.size() != out.size()) {
        throw std::invalid_argument("there are " + std::to_string(P.size()) + " P, " +
                                    std::to_string(Q.size()) + " Q and " +
                                    std::to_string(out.size()) +
                                    " places for derivatives; give as many of each");
    }
    // The error of one pair among many names the pair.
    const auto compute = [&](std::size_t k, Control* watch) {
        try {
            std::visit(
                [&](const auto& options) {
                    const bool is_value = out[k].by_p == nullptr && out[k].by_q == nullptr;
                    values[k] = is_value ? evaluate(options, P[k], Q[k], watch)
                                         : value_and_gradients(options, P[k], Q[k], out[k], watch);
                },
                measure);
        } catch (const std::invalid_argument& error) {
            if (P.size() == 1) throw;
            throw std::invalid_argument("pair " + std::to_string(k) + ": " + error.what());
        }
    };
    Poller poller(control);
    poller.begin(static_cast<std::int64_t>(P.size()));
    runtime::for_each(P.size(), runtime::resolve_workers(workers), poller, [&](Poller& own) {
        return [&](std::size_t k) {
            // Another Control watches a pair; its steps are not counted here.
            Control pair([&](std::int64_t, std::int64_t) { return !own.poll(); },
                         std::chrono::milliseconds(20));
            compute(k, control == nullptr ? nullptr : &pair);
            if (own.count_steps(1)) throw Stopped();
        };
    });
    poller.finish();
}

}  // namespace curvewise
