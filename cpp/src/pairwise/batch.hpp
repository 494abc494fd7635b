// A measure of many curves, for any measure class: the interface for cdist, pdist and Prepared.
// Every curve is checked and prepared once; pair_run.hpp computes the pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "curves/checks.hpp"
#include "curves/owned_curve.hpp"
#include "curvewise/pairwise.hpp"
#include "pairwise/pair_run.hpp"
#include "pairwise/targets.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::pairwise {

using curves::CurveList;

// The hooks are what a measure class offers (measure.hpp); BatchOf implements them.
class BatchMeasure : public runtime::InScratch {
   public:
    // All curves that take P's place, prepared.
    class Rows : public runtime::InScratch {
       public:
        Rows() = default;
        Rows(const Rows&) = delete;
        Rows(Rows&&) = delete;
        Rows& operator=(const Rows&) = delete;
        Rows& operator=(Rows&&) = delete;
        virtual ~Rows() = default;
    };

    BatchMeasure() = default;
    BatchMeasure(const BatchMeasure&) = delete;
    BatchMeasure(BatchMeasure&&) = delete;
    BatchMeasure& operator=(const BatchMeasure&) = delete;
    BatchMeasure& operator=(BatchMeasure&&) = delete;
    virtual ~BatchMeasure() = default;

    // The value of the one curve of `rows`, and Q.
    virtual double value(const Rows& rows, const CheckedCurve& Q, const BatchOptions& options,
                         Poller& poller) const = 0;

    virtual curves::Requirements requirements() const noexcept = 0;
    virtual void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const = 0;
    virtual bool may_be_negative() const noexcept = 0;
    virtual bool is_zero_to_itself(const curves::CheckedCurve& checked) const = 0;
    virtual PairTiles::Steps steps() const noexcept = 0;
    virtual std::unique_ptr<const Rows> prepare_rows(const runtime::ScratchVector<CheckedCurve>& P,
                                                     Poller& poller) const = 0;
    // The pairs of the rows, which must outlive them, with the curves that take Q's place. Larger
    // values than a cutoff need not be computed, if there is one.
    virtual std::unique_ptr<const PairValues> pairs(const Rows& rows,
                                                    const runtime::ScratchVector<CheckedCurve>& Q,
                                                    bool has_cutoff, Poller& poller) const = 0;
    // Throws where a row serves no Q.
    virtual void check_rows(const Rows& rows, Poller& poller) const = 0;
    // None yet. They must not outlive this.
    virtual std::unique_ptr<Targets> make_targets() const = 0;
};

// What a batch writes, and how.
struct BatchOutput {
    PairDestination destination;
    const BatchOptions& options;
    Control* control;
};

// Throws the errors that the functions below would throw before their work.
void check_batch(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB,
                 Control* control);
void check_batch(const BatchMeasure& measure, const CurveList& X, Control* control);

// Every curve of one list with every curve of the other; of one list, as pairs of `set`.
void compute_batch(const BatchMeasure& measure, const CurveList& XA, const CurveList& XB,
                   const BatchOutput& output);
void compute_batch(const BatchMeasure& measure, const CurveList& X, PairSet set,
                   const BatchOutput& output);

// A curve and a measure, prepared. Owns a copy of P.
class PreparedCurve {
   public:
    PreparedCurve(std::unique_ptr<const BatchMeasure> measure, const CurveView& P,
                  Control* control);
    double value(const CurveView& Q, const BatchOptions& options, Control* control) const;
    void values(const CurveList& Qs, const BatchOutput& output) const;
    const BatchMeasure& measure() const noexcept { return *measure_; }

   private:
    PreparedCurve(std::unique_ptr<const BatchMeasure> measure, const CurveView& P, Poller&& poller);

    std::unique_ptr<const BatchMeasure> measure_;
    curves::OwnedCurve points_;
    CurveView P_;
    std::unique_ptr<const BatchMeasure::Rows> rows_;
};

// Of every measure, defined beside it.
std::unique_ptr<const BatchMeasure> batch_measure(const AreaOptions& options);
std::unique_ptr<const BatchMeasure> batch_measure(const CurveLengthOptions& options);
std::unique_ptr<const BatchMeasure> batch_measure(const DtwOptions& options);
std::unique_ptr<const BatchMeasure> batch_measure(const FrechetOptions& options);
std::unique_ptr<const BatchMeasure> batch_measure(const FrechetContinuousOptions& options);
std::unique_ptr<const BatchMeasure> batch_measure(const HausdorffOptions& options);
std::unique_ptr<const BatchMeasure> batch_measure(const HausdorffContinuousOptions& options);
std::unique_ptr<const BatchMeasure> batch_measure(const PcmOptions& options);
std::unique_ptr<const BatchMeasure> batch_measure(const Recurrence& recurrence);
template <class Options, class = std::enable_if_t<is_edit_distance<Options>>>
std::unique_ptr<const BatchMeasure> batch_measure(const Options& options) {
    return batch_measure(options.recurrence());
}

}  // namespace curvewise::pairwise
