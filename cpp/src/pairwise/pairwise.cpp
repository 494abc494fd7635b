#include "curvewise/pairwise.hpp"

#include <stdexcept>
#include <string>

#include "pairwise/batch.hpp"
#include "runtime/workers.hpp"

namespace curvewise {
namespace {

using detail::CurveList;
using detail::PairDestination;

std::unique_ptr<const detail::BatchMeasure> batch_of(const Measure& measure) {
    return std::visit([](const auto& options) { return detail::batch_measure(options); }, measure);
}

void check_options(const BatchOptions& options) {
    detail::resolve_workers(options.workers);
    if (!(options.cutoff >= 0.0)) {
        throw std::invalid_argument("cutoff is " + std::to_string(options.cutoff) +
                                    "; give a number >= 0");
    }
}

}  // namespace

bool is_symmetric(const Measure& measure) noexcept {
    return std::visit([](const auto& options) { return options.is_symmetric(); }, measure);
}

double evaluate(const Measure& measure, const CurveView& P, const CurveView& Q, Control* control) {
    return batch_of(measure)->value(P, Q, control);
}

void cdist(const std::vector<CurveView>& XA, const std::vector<CurveView>& XB,
           const Measure& measure, double* out, const BatchOptions& options, Control* control) {
    check_options(options);
    const PairDestination destination(out, XB.size(), PairDestination::Shape::matrix);
    batch_of(measure)->rectangle({XA, "XA"}, {XB, "XB"}, destination, options, control);
}

void cdist(const std::vector<CurveView>& X, const Measure& measure, double* out,
           const BatchOptions& options, Control* control) {
    check_options(options);
    if (!is_symmetric(measure)) {
        const PairDestination matrix(out, X.size(), PairDestination::Shape::matrix);
        return batch_of(measure)->square({X, "XA"}, matrix, options, control);
    }
    for (std::size_t i = 0; i < X.size(); ++i) out[i * X.size() + i] = 0.0;
    const PairDestination mirrored(out, X.size(), PairDestination::Shape::mirrored);
    batch_of(measure)->triangle({X, "XA"}, mirrored, options, control);
}

void pdist(const std::vector<CurveView>& X, const Measure& measure, double* out,
           const BatchOptions& options, Control* control) {
    if (!is_symmetric(measure)) {
        throw std::invalid_argument(
            "pdist needs a measure for which d(P, Q) = d(Q, P), which this one with these options "
            "is not; use cdist");
    }
    check_options(options);
    const PairDestination condensed(out, X.size(), PairDestination::Shape::condensed);
    batch_of(measure)->triangle({X, "X"}, condensed, options, control);
}

Prepared::Prepared(const CurveView& P, const Measure& measure)
    : state_(batch_of(measure)->prepared(P)) {}

double Prepared::operator()(const CurveView& Q, Control* control) const {
    return state_->value(Q, control);
}

void Prepared::operator()(const std::vector<CurveView>& Qs, double* out,
                          const BatchOptions& options, Control* control) const {
    check_options(options);
    state_->values(Qs, out, options, control);
}

}  // namespace curvewise
