/// \file
/// One measure between many curves: all pairs of two lists (cdist), all pairs within one (pdist),
/// or one curve against others as they come (Prepared). Work that depends on one curve alone (its
/// checks, its packing for the kernels, its scaling) is done once a curve and not once a pair.
///
///     const std::vector<curvewise::CurveView> X = ...;
///     const std::vector<double> distances =
///         curvewise::pdist(X, curvewise::DtwOptions{}, curvewise::BatchOptions{-1});  // all cores
///
/// Threads take tiles of pairs, the largest pairs first. If a pair is large compared with all
/// others, all threads sweep it together. Neither their number nor their order changes a value:
/// each is the result of the measure's own function for the pair. Memory: packed copies of some of
/// the curves at a time, at most about 100 MB, or four curves a thread if that is more, and some
/// kilobytes a thread. Curves may be of floats.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "curvewise/curve.hpp"
#include "curvewise/export.h"
#include "curvewise/measure.hpp"

namespace curvewise {

class Control;

/// Whether d(P, Q) = d(Q, P): dtw without open ends, frechet, and (to rounding) area except with
/// Spacing::arc_length.
[[nodiscard]] CURVEWISE_EXPORT bool is_symmetric(const Measure& measure);

/// How a batch is run.
struct BatchOptions {
    /// Threads for this call, -1 for one per core. (The `workers` of the measure are not used.)
    std::ptrdiff_t workers = 1;
    /// A larger value becomes infinity, and takes less time. If a lower bound of dtw, frechet or
    /// frechet_continuous is above the cutoff, the pair is not computed; otherwise its computation
    /// ends early. At least 0, except if the measure may be negative (dtw with own steps of
    /// negative weight).
    double cutoff = std::numeric_limits<double>::infinity();
};

/// Writes the measure of XA[i] (as P) and XB[j] (as Q) to out[i * XB.size() + j]. Throws before any
/// work: std::invalid_argument as the measure does, with the name of the curve (XA[3]), and for
/// curves of different dimension. Throws std::bad_alloc and Stopped.
CURVEWISE_EXPORT void cdist(const std::vector<CurveView>& XA, const std::vector<CurveView>& XB,
                            const Measure& measure, double* out, const BatchOptions& options = {},
                            Control* control = nullptr);

/// The same for one list with itself. Each pair of a symmetric measure is computed once, in the
/// order (i, j) with i < j. The diagonal is written without work if it is known to be 0.
CURVEWISE_EXPORT void cdist(const std::vector<CurveView>& X, const Measure& measure, double* out,
                            const BatchOptions& options = {}, Control* control = nullptr);

/// The same in a vector: XA.size() rows of XB.size() values.
[[nodiscard]] inline std::vector<double> cdist(const std::vector<CurveView>& XA,
                                               const std::vector<CurveView>& XB,
                                               const Measure& measure,
                                               const BatchOptions& options = {},
                                               Control* control = nullptr) {
    std::vector<double> out(XA.size() * XB.size());
    cdist(XA, XB, measure, out.data(), options, control);
    return out;
}
/// The same of one list with itself.
[[nodiscard]] inline std::vector<double> cdist(const std::vector<CurveView>& X,
                                               const Measure& measure,
                                               const BatchOptions& options = {},
                                               Control* control = nullptr) {
    std::vector<double> out(X.size() * X.size());
    cdist(X, measure, out.data(), options, control);
    return out;
}

/// Throws the errors that cdist of these lists would throw before its work. For code that cuts a
/// batch into parts: a part does not have the index of the curve in the whole list.
CURVEWISE_EXPORT void check_batch(const std::vector<CurveView>& XA,
                                  const std::vector<CurveView>& XB, const Measure& measure,
                                  Control* control = nullptr);
/// The same for cdist and pdist of one list.
CURVEWISE_EXPORT void check_batch(const std::vector<CurveView>& X, const Measure& measure,
                                  Control* control = nullptr);

/// Writes the measure of X[i] and X[j] for i < j, row by row, k (k-1) / 2 values. The pair (i, j)
/// goes to out[i k - i (i+1) / 2 + j - i - 1]. For symmetric measures only. Throws as cdist does.
CURVEWISE_EXPORT void pdist(const std::vector<CurveView>& X, const Measure& measure, double* out,
                            const BatchOptions& options = {}, Control* control = nullptr);

/// The same in a vector.
[[nodiscard]] inline std::vector<double> pdist(const std::vector<CurveView>& X,
                                               const Measure& measure,
                                               const BatchOptions& options = {},
                                               Control* control = nullptr) {
    std::vector<double> out(X.empty() ? 0 : X.size() * (X.size() - 1) / 2);
    pdist(X, measure, out.data(), options, control);
    return out;
}

/// A curve P, checked, packed and scaled once, for comparison with others. Owns a copy of P. Cheap
/// to copy, and a move is a copy. Any number of threads may call it.
class Prepared {
   public:
    CURVEWISE_EXPORT Prepared(const CurveView& P, const Measure& measure,
                              Control* control = nullptr);
    Prepared(const Prepared&) = default;
    Prepared& operator=(const Prepared&) = default;
    ~Prepared() = default;

    /// The measure of P and Q. Throws as the measure does.
    [[nodiscard]] CURVEWISE_EXPORT double operator()(const CurveView& Q,
                                                     Control* control = nullptr) const;
    /// The same with a cutoff for this call: a larger value becomes infinity, and takes less time.
    [[nodiscard]] CURVEWISE_EXPORT double operator()(const CurveView& Q,
                                                     const BatchOptions& options,
                                                     Control* control = nullptr) const;
    /// Writes the measure of P and each of Qs to out[j], as cdist would.
    CURVEWISE_EXPORT void operator()(const std::vector<CurveView>& Qs, double* out,
                                     const BatchOptions& options = {},
                                     Control* control = nullptr) const;

    class State;

   private:
    std::shared_ptr<const State> state_;
};

}  // namespace curvewise
