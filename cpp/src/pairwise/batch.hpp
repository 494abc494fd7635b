// A measure whatever its class: what cdist, pdist, Prepared and evaluate() call.
#pragma once

#include <cstddef>
#include <memory>

#include "curves/checks.hpp"
#include "curvewise/pairwise.hpp"

namespace curvewise::detail {

// Where the value of pair (i, j) goes.
class PairDestination {
   public:
    enum class Shape { matrix, mirrored, condensed };

    PairDestination(double* out, std::size_t columns, Shape shape) noexcept
        : out_(out), columns_(static_cast<std::ptrdiff_t>(columns)), shape_(shape) {}

    void write(std::ptrdiff_t i, std::ptrdiff_t j, double value) const noexcept {
        if (shape_ == Shape::condensed) {
            out_[i * columns_ - i * (i + 1) / 2 + j - i - 1] = value;
            return;
        }
        out_[i * columns_ + j] = value;
        if (shape_ == Shape::mirrored) out_[j * columns_ + i] = value;
    }

   private:
    double* out_;
    std::ptrdiff_t columns_;
    Shape shape_;
};

class BatchMeasure {
   public:
    BatchMeasure() = default;
    BatchMeasure(const BatchMeasure&) = delete;
    BatchMeasure(BatchMeasure&&) = delete;
    BatchMeasure& operator=(const BatchMeasure&) = delete;
    BatchMeasure& operator=(BatchMeasure&&) = delete;
    virtual ~BatchMeasure() = default;

    // Of one pair.
    virtual double value(const CurveView& P, const CurveView& Q, Control* control) const = 0;
    // Every curve of one list with every curve of the other.
    virtual void rectangle(const CurveList& XA, const CurveList& XB,
                           const PairDestination& destination, const BatchOptions& options,
                           Control* control) const = 0;
    // The same of a list with itself.
    virtual void square(const CurveList& X, const PairDestination& destination,
                        const BatchOptions& options, Control* control) const = 0;
    // Every two curves of one list, for a symmetric measure.
    virtual void triangle(const CurveList& X, const PairDestination& destination,
                          const BatchOptions& options, Control* control) const = 0;
    virtual std::shared_ptr<const Prepared::State> prepared(const CurveView& P) const = 0;
};

}  // namespace curvewise::detail

// A curve and a measure, prepared.
class curvewise::Prepared::State {
   public:
    State() = default;
    State(const State&) = delete;
    State(State&&) = delete;
    State& operator=(const State&) = delete;
    State& operator=(State&&) = delete;
    virtual ~State() = default;
    virtual double value(const CurveView& Q, Control* control) const = 0;
    virtual void values(const std::vector<CurveView>& Qs, double* out, const BatchOptions& options,
                        Control* control) const = 0;
};
