// The hooks of TargetBlock for one measure class that computes several pairs at once (see
// measure.hpp), and whose PreparedQ refers to stored points.
#pragma once

#include <cstddef>
#include <utility>

#include "pairwise/beside_of.hpp"
#include "pairwise/measure.hpp"
#include "pairwise/stored_curve.hpp"
#include "pairwise/targets.hpp"
#include "runtime/growing_list.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::pairwise {

template <class M>
class BlockOf final : public TargetBlock {
   public:
    // All must outlive this.
    BlockOf(const M& measure, const runtime::GrowingList<StoredCurve>& curves, std::ptrdiff_t dim)
        : measure_(measure), curves_(curves), dim_(dim) {}

    void set_rows(const CheckedCurve* const* queries, std::ptrdiff_t count,
                  Poller& poller) override {
        rows_.clear();
        rows_.reserve(static_cast<std::size_t>(count));
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            rows_.emplace_back(*queries[i], poller);
            measure_.check_p(rows_.back(), poller);
        }
    }
    void set_columns(const std::ptrdiff_t* targets, std::ptrdiff_t count) override {
        columns_.clear();
        columns_.reserve(static_cast<std::size_t>(count));
        for (std::ptrdiff_t j = 0; j < count; ++j) columns_.emplace_back(curves_[targets[j]], dim_);
    }
    std::ptrdiff_t gather(const std::ptrdiff_t* columns, std::ptrdiff_t count) override {
        return beside_.gather(measure_, columns_, columns, count, true);
    }
    bool bounds(std::ptrdiff_t row, double cutoff, double* out, Poller& poller) override {
        return beside_.columns().bounds(measure_, cutoff, rows_[static_cast<std::size_t>(row)], out,
                                        poller);
    }
    bool values(std::ptrdiff_t row, double* out, Poller& poller) override {
        return beside_.columns().values(measure_, rows_[static_cast<std::size_t>(row)], 0, out,
                                        poller);
    }
    bool pair_values(const std::pair<std::ptrdiff_t, std::ptrdiff_t>* pairs, std::ptrdiff_t count,
                     double* out, Poller& poller) override {
        return beside_.values(measure_, rows_, columns_, pairs, count, out, poller);
    }
    double value(std::ptrdiff_t row, std::ptrdiff_t column, double cutoff,
                 Poller& poller) override {
        return measure_(rows_[static_cast<std::size_t>(row)],
                        columns_[static_cast<std::size_t>(column)], {cutoff, 1, poller, memory_});
    }

   private:
    const M& measure_;
    const runtime::GrowingList<StoredCurve>& curves_;
    std::ptrdiff_t dim_;
    runtime::ScratchVector<typename M::PreparedP> rows_;
    runtime::ScratchVector<typename M::PreparedQ> columns_;
    PairsBeside<M> beside_;
    typename M::Memory memory_;
};

}  // namespace curvewise::pairwise
