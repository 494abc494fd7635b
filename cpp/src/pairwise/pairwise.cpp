#include "curvewise/pairwise.hpp"

#include <stdexcept>
#include <string>

#include "pairwise/batch.hpp"
#include "runtime/workers.hpp"

namespace curvewise {
namespace {

using curves::CurveList;
using pairwise::PairDestination;

std::unique_ptr<const pairwise::BatchMeasure> batch_of(const Measure& measure) {
    return std::visit([](const auto& options) { return pairwise::batch_measure(options); },
                      measure);
}

void check_options(const BatchOptions& options, const pairwise::BatchMeasure& measure) {
    runtime::resolve_workers(options.workers);
    curves::check_limit("cutoff", options.cutoff, measure.may_be_negative());
}

}  // namespace

bool is_symmetric(const Measure& measure) {
    return std::visit([](const auto& options) { return options.is_symmetric(); }, measure);
}

double evaluate(const Measure& measure, const CurveView& P, const CurveView& Q, Control* control) {
    return std::visit(
        [&](const auto& options) {
            // The overload for this very type, which every measure has.
            using Options = decltype(options);
            double (*const value)(Options, const CurveView&, const CurveView&, Control*) = evaluate;
            return value(options, P, Q, control);
        },
        measure);
}

void check_batch(const std::vector<CurveView>& XA, const std::vector<CurveView>& XB,
                 const Measure& measure, Control* control) {
    check_batch(*batch_of(measure), {XA, "XA"}, {XB, "XB"}, control);
}

void check_batch(const std::vector<CurveView>& X, const Measure& measure, Control* control) {
    check_batch(*batch_of(measure), {X, "XA"}, control);
}

void cdist(const std::vector<CurveView>& XA, const std::vector<CurveView>& XB,
           const Measure& measure, double* out, const BatchOptions& options, Control* control) {
    const auto batch = batch_of(measure);
    check_options(options, *batch);
    const PairDestination matrix(out, XB.size(), PairDestination::Shape::matrix);
    compute_batch(*batch, {XA, "XA"}, {XB, "XB"}, {matrix, options, control});
}

void cdist(const std::vector<CurveView>& X, const Measure& measure, double* out,
           const BatchOptions& options, Control* control) {
    const auto batch = batch_of(measure);
    check_options(options, *batch);
    const bool halves = is_symmetric(measure);
    const PairDestination destination(
        out, X.size(), halves ? PairDestination::Shape::mirrored : PairDestination::Shape::matrix);
    compute_batch(*batch, {X, "XA"},
                  halves ? pairwise::PairSet::triangle : pairwise::PairSet::rectangle,
                  {destination, options, control});
}

void pdist(const std::vector<CurveView>& X, const Measure& measure, double* out,
           const BatchOptions& options, Control* control) {
    if (!is_symmetric(measure)) {
        throw std::invalid_argument(
            "pdist needs a measure for which d(P, Q) = d(Q, P), which this one with these options "
            "is not; use cdist");
    }
    const auto batch = batch_of(measure);
    check_options(options, *batch);
    const PairDestination condensed(out, X.size(), PairDestination::Shape::condensed);
    compute_batch(*batch, {X, "X"}, pairwise::PairSet::triangle, {condensed, options, control});
}

class Prepared::State : public pairwise::PreparedCurve {
   public:
    using PreparedCurve::PreparedCurve;
};

Prepared::Prepared(const CurveView& P, const Measure& measure, Control* control)
    : state_(std::allocate_shared<const State>(runtime::ScratchAllocator<State>(),
                                               batch_of(measure), P, control)) {}

double Prepared::operator()(const CurveView& Q, Control* control) const {
    return state_->value(Q, {}, control);
}

double Prepared::operator()(const CurveView& Q, const BatchOptions& options,
                            Control* control) const {
    check_options(options, state_->measure());
    return state_->value(Q, options, control);
}

void Prepared::operator()(const std::vector<CurveView>& Qs, double* out,
                          const BatchOptions& options, Control* control) const {
    check_options(options, state_->measure());
    const PairDestination row(out, Qs.size(), PairDestination::Shape::matrix);
    state_->values({Qs, "Q"}, {row, options, control});
}

}  // namespace curvewise
