#include "pairwise/batch.hpp"

#include <algorithm>
#include <utility>

#include "runtime/workers.hpp"

namespace curvewise::pairwise {
namespace {

// The curves of a list, found finite; their shapes have been checked.
std::vector<CheckedCurve> checked(const BatchMeasure& measure, const CurveList& list,
                                  Poller& poller) {
    const bool on_sphere = measure.requirements().on_sphere;
    std::vector<CheckedCurve> result;
    result.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        poller.poll_in_loop(i);
        result.emplace_back(list[i], list.name_of(i), poller, on_sphere);
    }
    return result;
}

Sizes sizes_of(const CurveList& list) {
    Sizes sizes;
    sizes.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) sizes.push_back(list[i].size());
    return sizes;
}

// Of each size one.
Sizes distinct(const std::vector<CheckedCurve>& curves) {
    Sizes sizes;
    sizes.reserve(curves.size());
    for (const CheckedCurve& checked : curves) sizes.push_back(checked.curve.size());
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    return sizes;
}

// Both sides, checked and prepared; their shapes have been checked.
struct Sides {
    Sides(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB, Poller& poller)
        : Sides(measure, checked(measure, XA, poller), checked(measure, XB, poller), poller) {}
    // Of one list with itself.
    Sides(const BatchMeasure& measure, const CurveList& X, Poller& poller)
        : Sides(measure, checked(measure, X, poller), poller) {}

    std::unique_ptr<const BatchMeasure::Rows> rows;
    std::unique_ptr<const PairValues> pairs;

   private:
    Sides(const BatchMeasure& measure, const std::vector<CheckedCurve>& X, Poller& poller)
        : Sides(measure, X, X, poller) {}
    Sides(const BatchMeasure& measure, const std::vector<CheckedCurve>& P,
          const std::vector<CheckedCurve>& Q, Poller& poller) {
        check_sizes(measure, P, Q);
        rows = measure.prepare_rows(P, poller);
        pairs = measure.pairs(*rows, Q, poller);
        measure.check_rows(*rows, poller);
    }

    static void check_sizes(const BatchMeasure& measure, const std::vector<CheckedCurve>& P,
                            const std::vector<CheckedCurve>& Q) {
        const Sizes columns = distinct(Q);
        for (const std::ptrdiff_t n : distinct(P)) {
            for (const std::ptrdiff_t m : columns) measure.check_sizes(n, m);
        }
    }
};

PairTiles tiles_of(const BatchMeasure& measure, const Sizes& rows, const Sizes& columns,
                   PairSet set, const BatchOutput& output) {
    return {rows, columns, set, measure.steps(), runtime::resolve_workers(output.options.workers)};
}

void run(const PairValues& pairs, const PairTiles& tiles, const BatchOutput& output,
         Poller& poller) {
    run_pairs(pairs, tiles, output.destination, output.options, poller);
    poller.finish();
}

}  // namespace

void check_batch(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB,
                 Control* control) {
    if (XA.size() == 0 || XB.size() == 0) return;
    check_shapes(measure.requirements(), XA, XB);
    Poller poller(control);
    const Sides sides(measure, XA, XB, poller);
}

void check_batch(const BatchMeasure& measure, const CurveList& X, Control* control) {
    if (X.size() == 0) return;
    check_shapes(measure.requirements(), X);
    Poller poller(control);
    const Sides sides(measure, X, poller);
}

void compute_batch(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB,
                   const BatchOutput& output) {
    if (XA.size() == 0 || XB.size() == 0) return;
    check_shapes(measure.requirements(), XA, XB);
    const PairTiles tiles =
        tiles_of(measure, sizes_of(XA), sizes_of(XB), PairSet::rectangle, output);
    Poller poller(output.control);
    poller.begin(tiles.total());
    const Sides sides(measure, XA, XB, poller);
    run(*sides.pairs, tiles, output, poller);
}

void compute_batch(const BatchMeasure& measure, const CurveList& X, PairSet set,
                   const BatchOutput& output) {
    if (X.size() == 0) return;
    check_shapes(measure.requirements(), X);
    const PairTiles tiles = tiles_of(measure, sizes_of(X), sizes_of(X), set, output);
    Poller poller(output.control);
    poller.begin(tiles.total());
    const Sides sides(measure, X, poller);
    run(*sides.pairs, tiles, output, poller);
}

PreparedCurve::PreparedCurve(std::unique_ptr<const BatchMeasure> measure, const CurveView& P,
                             Control* control)
    : PreparedCurve(std::move(measure), P, Poller(control)) {}

PreparedCurve::PreparedCurve(std::unique_ptr<const BatchMeasure> measure, const CurveView& P,
                             Poller&& poller)
    : measure_(std::move(measure)),
      points_((check_shapes(measure_->requirements(), {P, "P"}), curves::OwnedCurve(P, poller))),
      P_(points_.view()),
      rows_(measure_->prepare_rows(checked(*measure_, {P_, "P"}, poller), poller)) {
    measure_->check_rows(*rows_, poller);
}

double PreparedCurve::value(const CurveView& Q, Control* control) const {
    check_shapes(measure_->requirements(), {P_, "P"}, {Q, "Q"});
    Poller poller(control);
    poller.begin(measure_->steps()(P_.size(), 1, Q.size()));
    const CheckedCurve checked_q(Q, "Q", poller, measure_->requirements().on_sphere);
    measure_->check_sizes(P_.size(), Q.size());
    const double value = measure_->value(*rows_, checked_q, poller);
    poller.finish();
    return value;
}

void PreparedCurve::values(const CurveList& Qs, const BatchOutput& output) const {
    if (Qs.size() == 0) return;
    check_shapes(measure_->requirements(), {P_, "P"}, Qs);
    const PairTiles tiles =
        tiles_of(*measure_, {P_.size()}, sizes_of(Qs), PairSet::rectangle, output);
    Poller poller(output.control);
    poller.begin(tiles.total());
    const std::vector<CheckedCurve> columns = checked(*measure_, Qs, poller);
    for (const std::ptrdiff_t m : distinct(columns)) measure_->check_sizes(P_.size(), m);
    const auto pairs = measure_->pairs(*rows_, columns, poller);
    run(*pairs, tiles, output, poller);
}

}  // namespace curvewise::pairwise
