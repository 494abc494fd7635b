#include "pairwise/batch.hpp"

#include <algorithm>
#include <utility>

#include "runtime/workers.hpp"

namespace curvewise::detail {
namespace {

// The curves of a list, found finite; their shapes have been checked.
std::vector<CheckedCurve> checked(const CurveList& list) {
    std::vector<CheckedCurve> result;
    result.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) result.emplace_back(list[i], list.name_of(i));
    return result;
}

Sizes sizes_of(const std::vector<CheckedCurve>& curves) {
    Sizes sizes;
    sizes.reserve(curves.size());
    for (const CheckedCurve& checked : curves) sizes.push_back(checked.curve.size());
    return sizes;
}

// Of each size one.
Sizes distinct(Sizes sizes) {
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    return sizes;
}

// Both sides, prepared.
struct Sides {
    Sides(const BatchMeasure& measure, const std::vector<CheckedCurve>& P,
          const std::vector<CheckedCurve>& Q)
        : row_sizes(sizes_of(P)), column_sizes(sizes_of(Q)) {
        for (const std::ptrdiff_t n : distinct(row_sizes)) {
            for (const std::ptrdiff_t m : distinct(column_sizes)) measure.check_sizes(n, m);
        }
        rows = measure.prepare_rows(P);
        pairs = measure.pairs(*rows, Q);
        measure.check_rows(*rows);
    }

    Sizes row_sizes;
    Sizes column_sizes;
    std::unique_ptr<const BatchMeasure::Rows> rows;
    std::unique_ptr<const PairValues> pairs;
};

// Row by row.
std::vector<double> contiguous(const CurveView& curve) {
    std::vector<double> copy;
    copy.reserve(static_cast<std::size_t>(curve.size() * curve.dim()));
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) copy.push_back(curve(i, c));
    }
    return copy;
}

void run(const Sides& sides, PairSet set, const BatchOutput& output) {
    const PairTiles tiles(sides.row_sizes, sides.column_sizes, set, sides.pairs->steps(),
                          resolve_workers(output.options.workers));
    run_pairs(*sides.pairs, tiles, output.destination, output.options, output.control);
}

}  // namespace

void check_batch(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB) {
    if (XA.size() == 0 || XB.size() == 0) return;
    check_shapes(measure.requirements(), XA, XB);
    const Sides sides(measure, checked(XA), checked(XB));
}

void check_batch(const BatchMeasure& measure, const CurveList& X) {
    if (X.size() == 0) return;
    check_shapes(measure.requirements(), X);
    const std::vector<CheckedCurve> curves = checked(X);
    const Sides sides(measure, curves, curves);
}

void compute_batch(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB,
                   const BatchOutput& output) {
    if (XA.size() == 0 || XB.size() == 0) return;
    check_shapes(measure.requirements(), XA, XB);
    run(Sides(measure, checked(XA), checked(XB)), PairSet::rectangle, output);
}

void compute_batch(const BatchMeasure& measure, const CurveList& X, PairSet set,
                   const BatchOutput& output) {
    if (X.size() == 0) return;
    check_shapes(measure.requirements(), X);
    const std::vector<CheckedCurve> curves = checked(X);
    run(Sides(measure, curves, curves), set, output);
}

PreparedCurve::PreparedCurve(std::unique_ptr<const BatchMeasure> measure, const CurveView& P)
    : measure_(std::move(measure)),
      points_((check_shapes(measure_->requirements(), {P, "P"}), contiguous(P))),
      P_(P.is_flat() ? CurveView(points_.data(), P.size(), 1, 1, 0)
                     : CurveView(points_.data(), P.size(), P.dim())),
      rows_(measure_->prepare_rows({CheckedCurve(P_, "P")})) {
    measure_->check_rows(*rows_);
}

double PreparedCurve::value(const CurveView& Q, Control* control) const {
    check_shapes(measure_->requirements(), {P_, "P"}, {Q, "Q"});
    const CheckedCurve checked_q(Q, "Q");
    measure_->check_sizes(P_.size(), Q.size());
    Poller poller(control);
    const double value = measure_->value(*rows_, checked_q, poller);
    poller.finish();
    return value;
}

void PreparedCurve::values(const CurveList& Qs, const BatchOutput& output) const {
    if (Qs.size() == 0) return;
    check_shapes(measure_->requirements(), {P_, "P"}, Qs);
    const std::vector<CheckedCurve> columns = checked(Qs);
    const Sizes column_sizes = sizes_of(columns);
    for (const std::ptrdiff_t m : distinct(column_sizes)) measure_->check_sizes(P_.size(), m);
    const auto pairs = measure_->pairs(*rows_, columns);
    const PairTiles tiles({P_.size()}, column_sizes, PairSet::rectangle, pairs->steps(),
                          resolve_workers(output.options.workers));
    run_pairs(*pairs, tiles, output.destination, output.options, output.control);
}

}  // namespace curvewise::detail
