// The batches of one measure class (see measure.hpp): every curve is checked and prepared once,
// then pair_run.hpp computes all pairs. Instantiated by each measure's own file.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "pairwise/batch.hpp"
#include "pairwise/evaluate.hpp"
#include "pairwise/measure.hpp"
#include "pairwise/pair_run.hpp"
#include "pairwise/pair_tiles.hpp"

namespace curvewise::detail {

// The curves of a list, found finite; their shapes have been checked.
inline std::vector<CheckedCurve> checked(const CurveList& list) {
    std::vector<CheckedCurve> result;
    result.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) result.emplace_back(list[i], list.name_of(i));
    return result;
}

template <class Side>
std::vector<Side> prepare_all(const std::vector<CheckedCurve>& curves) {
    std::vector<Side> result;
    result.reserve(curves.size());
    for (const CheckedCurve& curve : curves) result.emplace_back(curve);
    return result;
}

inline Sizes sizes_of(const std::vector<CheckedCurve>& curves) {
    Sizes sizes;
    sizes.reserve(curves.size());
    for (const CheckedCurve& checked : curves) sizes.push_back(checked.curve.size());
    return sizes;
}

// Of each size one.
inline Sizes distinct(Sizes sizes) {
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    return sizes;
}

template <class M>
void check_all_sizes(const M& measure, const Sizes& rows, const Sizes& columns) {
    for (const std::ptrdiff_t n : distinct(rows)) {
        for (const std::ptrdiff_t m : distinct(columns)) measure.check_sizes(n, m);
    }
}

template <class M>
class BatchOf final : public BatchMeasure {
   public:
    using PreparedP = typename M::PreparedP;
    using PreparedQ = typename M::PreparedQ;

    explicit BatchOf(const M& measure) : measure_(measure) {}

    double value(const CurveView& P, const CurveView& Q, Control* control) const override {
        return evaluate(measure_, P, Q, control);
    }

    void rectangle(const CurveList& XA, const CurveList& XB, const PairDestination& destination,
                   const BatchOptions& options, Control* control) const override {
        if (XA.size() == 0 || XB.size() == 0) return;
        check_shapes(measure_.requirements(), XA, XB);
        run(checked(XA), checked(XB), PairSet::rectangle, destination, options, control);
    }

    void square(const CurveList& X, const PairDestination& destination, const BatchOptions& options,
                Control* control) const override {
        run_one_list(X, PairSet::rectangle, destination, options, control);
    }

    void triangle(const CurveList& X, const PairDestination& destination,
                  const BatchOptions& options, Control* control) const override {
        run_one_list(X, PairSet::triangle, destination, options, control);
    }

    std::shared_ptr<const Prepared::State> prepared(const CurveView& P) const override;

   private:
    void run_one_list(const CurveList& X, PairSet set, const PairDestination& destination,
                      const BatchOptions& options, Control* control) const {
        if (X.size() == 0) return;
        check_shapes(measure_.requirements(), X);
        const std::vector<CheckedCurve> curves = checked(X);
        run(curves, curves, set, destination, options, control);
    }

    void run(const std::vector<CheckedCurve>& rows, const std::vector<CheckedCurve>& columns,
             PairSet set, const PairDestination& destination, const BatchOptions& options,
             Control* control) const {
        const Sizes row_sizes = sizes_of(rows), column_sizes = sizes_of(columns);
        check_all_sizes(measure_, row_sizes, column_sizes);
        const auto prepared_rows = prepare_all<PreparedP>(rows);
        const auto prepared_columns = prepare_all<PreparedQ>(columns);
        for (const PreparedP& row : prepared_rows) measure_.check_p(row);
        const PairTiles tiles(row_sizes, column_sizes, set, M::steps,
                              resolve_workers(options.workers));
        PairRun<M>(measure_, prepared_rows, prepared_columns, tiles, destination, options)
            .run(control);
    }

    M measure_;
};

// Owns a copy of P.
template <class M>
class PreparedOf final : public Prepared::State {
   public:
    using PreparedQ = typename M::PreparedQ;

    PreparedOf(const M& measure, const CurveView& P)
        : measure_(measure),
          points_((check_shapes(measure.requirements(), {P, "P"}), contiguous(P))),
          P_(P.is_flat() ? CurveView(points_.data(), P.size(), 1, 1, 0)
                         : CurveView(points_.data(), P.size(), P.dim())),
          rows_(prepare_all<typename M::PreparedP>({CheckedCurve(P_, "P")})) {
        measure.check_p(rows_[0]);
    }

    double value(const CurveView& Q, Control* control) const override {
        check_shapes(measure_.requirements(), {P_, "P"}, {Q, "Q"});
        const CheckedCurve checked_q(Q, "Q");
        measure_.check_sizes(P_.size(), Q.size());
        Poller poller(control);
        poller.begin(M::steps(P_.size(), 1, Q.size()));
        const PreparedQ q(checked_q);
        typename M::Memory memory;
        const double value =
            measure_(rows_[0], q, {std::numeric_limits<double>::infinity(), 1, poller, memory});
        poller.finish();
        return value;
    }

    void values(const std::vector<CurveView>& Qs, double* out, const BatchOptions& options,
                Control* control) const override {
        if (Qs.empty()) return;
        const CurveList list(Qs, "Q");
        check_shapes(measure_.requirements(), {P_, "P"}, list);
        const std::vector<CheckedCurve> columns = checked(list);
        const Sizes row_size{P_.size()}, column_sizes = sizes_of(columns);
        check_all_sizes(measure_, row_size, column_sizes);
        const PairTiles tiles(row_size, column_sizes, PairSet::rectangle, M::steps,
                              resolve_workers(options.workers));
        const PairDestination destination(out, Qs.size(), PairDestination::Shape::matrix);
        PairRun<M>(measure_, rows_, prepare_all<PreparedQ>(columns), tiles, destination, options)
            .run(control);
    }

   private:
    // Row by row.
    static std::vector<double> contiguous(const CurveView& curve) {
        std::vector<double> copy;
        copy.reserve(static_cast<std::size_t>(curve.size() * curve.dim()));
        for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
            for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) copy.push_back(curve(i, c));
        }
        return copy;
    }

    M measure_;
    std::vector<double> points_;
    CurveView P_;
    std::vector<typename M::PreparedP> rows_;
};

template <class M>
std::shared_ptr<const Prepared::State> BatchOf<M>::prepared(const CurveView& P) const {
    return std::make_shared<PreparedOf<M>>(measure_, P);
}

}  // namespace curvewise::detail
