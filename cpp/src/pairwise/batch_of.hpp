// The hooks of BatchMeasure for one measure class (see measure.hpp). Instantiated by each measure's
// own file.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "pairwise/batch.hpp"
#include "pairwise/beside_of.hpp"
#include "pairwise/bounded.hpp"
#include "pairwise/measure.hpp"
#include "pairwise/targets_of.hpp"
#include "runtime/scratch.hpp"
#include "runtime/workers.hpp"

namespace curvewise::pairwise {

template <class M>
class BatchOf final : public BatchMeasure {
   public:
    explicit BatchOf(const M& measure) : measure_(measure) {}

    double value(const Rows& rows, const CheckedCurve& Q, const BatchOptions& options,
                 Poller& poller) const override {
        const PreparedP& p = sides(rows).front();
        const PreparedQ q(Q, poller);
        Memory memory;
        const std::ptrdiff_t workers = runtime::resolve_workers(options.workers);
        return measure_(p, q, {options.cutoff, workers, poller, memory});
    }

    curves::Requirements requirements() const noexcept override { return measure_.requirements(); }

    void check_sizes(std::ptrdiff_t n, std::ptrdiff_t m) const override {
        measure_.check_sizes(n, m);
    }

    bool may_be_negative() const noexcept override { return measure_.may_be_negative(); }

    bool is_zero_to_itself(const curves::CheckedCurve& checked) const override {
        return measure_.is_zero_to_itself(checked);
    }

    PairTiles::Steps steps() const noexcept override { return M::steps; }

    std::unique_ptr<const Rows> prepare_rows(const runtime::ScratchVector<CheckedCurve>& P,
                                             Poller& poller) const override {
        return std::make_unique<PreparedRows>(P, poller);
    }

    void check_rows(const Rows& rows, Poller& poller) const override {
        for (const PreparedP& row : sides(rows)) measure_.check_p(row, poller);
    }

    std::unique_ptr<Targets> make_targets() const override {
        return std::make_unique<TargetsOf<M>>(measure_);
    }

    std::unique_ptr<const PairValues> pairs(const Rows& rows,
                                            const runtime::ScratchVector<CheckedCurve>& Q,
                                            bool has_cutoff, Poller& poller) const override {
        return std::make_unique<Pairs>(measure_, sides(rows), Q, has_cutoff, poller);
    }

   private:
    using PreparedP = typename M::PreparedP;
    using PreparedQ = typename M::PreparedQ;
    using Memory = typename M::Memory;

    template <class Side>
    static runtime::ScratchVector<Side> prepare_all(
        const runtime::ScratchVector<CheckedCurve>& curves, Poller& poller) {
        runtime::ScratchVector<Side> result;
        result.reserve(curves.size());
        for (const CheckedCurve& curve : curves) {
            poller.poll_in_loop(result.size());
            result.emplace_back(curve, poller);
        }
        return result;
    }

    struct PreparedRows final : Rows {
        PreparedRows(const runtime::ScratchVector<CheckedCurve>& P, Poller& poller)
            : sides(prepare_all<PreparedP>(P, poller)) {}
        runtime::ScratchVector<PreparedP> sides;
    };

    static const runtime::ScratchVector<PreparedP>& sides(const Rows& rows) noexcept {
        return static_cast<const PreparedRows&>(rows).sides;
    }

    class Pairs final : public PairValues {
       public:
        Pairs(const M& measure, const runtime::ScratchVector<PreparedP>& rows,
              const runtime::ScratchVector<CheckedCurve>& Q, bool has_cutoff, Poller& poller)
            : measure_(measure), rows_(rows), columns_(prepare_all<PreparedQ>(Q, poller)) {
            if (Bounds::levels > 1 && has_cutoff && are_worth_bounds()) keep_bounds(Q);
        }

        bool is_swept() const noexcept override { return M::is_swept; }
        PairTiles::Steps steps() const noexcept override { return M::steps; }
        std::ptrdiff_t row_points(std::ptrdiff_t i) const noexcept override {
            return rows_[static_cast<std::size_t>(i)].checked.curve.size();
        }
        std::ptrdiff_t column_points(std::ptrdiff_t j) const noexcept override {
            return columns_[static_cast<std::size_t>(j)].checked.curve.size();
        }
        std::unique_ptr<ThreadMemory> make_memory() const override {
            return std::make_unique<OwnMemory>();
        }
        bool are_bounded() const noexcept override { return are_bounded_; }
        double value(std::ptrdiff_t i, std::ptrdiff_t j, const PairCall& call) const override {
            auto& own = static_cast<OwnMemory&>(call.memory);
            const PreparedP& P = rows_[static_cast<std::size_t>(i)];
            const PreparedQ& Q = columns_[static_cast<std::size_t>(j)];
            const Call<Memory> of_pair{call.cutoff, call.workers, call.poller, own.content};
            if (!are_bounded_ || !own.trial.is_due()) return measure_(P, Q, of_pair);
            return bounded_value(own, i, j, of_pair);
        }
        std::ptrdiff_t most_beside(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept override {
            if (columns_.empty()) return 1;
            return Beside::most(measure_, n, m, columns_.front().checked.curve.dim());
        }
        std::ptrdiff_t gather(const std::ptrdiff_t* columns, std::ptrdiff_t count,
                              const PairCall& call) const override {
            auto& own = static_cast<OwnMemory&>(call.memory);
            const bool has_cutoff = call.cutoff < std::numeric_limits<double>::infinity();
            return own.beside.gather(measure_, columns_, columns, count, has_cutoff);
        }
        bool values(std::ptrdiff_t i, std::ptrdiff_t first, double* out,
                    const PairCall& call) const override {
            return static_cast<OwnMemory&>(call.memory)
                .beside.columns()
                .values(measure_, rows_[static_cast<std::size_t>(i)], first, out, call.poller);
        }
        std::ptrdiff_t candidates(std::ptrdiff_t i, std::ptrdiff_t first, std::ptrdiff_t* places,
                                  double& saved, const PairCall& call) const override {
            return static_cast<OwnMemory&>(call.memory)
                .beside.columns()
                .candidates(measure_, call.cutoff, rows_[static_cast<std::size_t>(i)], first,
                            places, saved, call.poller);
        }
        bool pair_values(const std::pair<std::ptrdiff_t, std::ptrdiff_t>* pairs,
                         std::ptrdiff_t count, double* out, const PairCall& call) const override {
            return static_cast<OwnMemory&>(call.memory)
                .beside.values(measure_, rows_, columns_, pairs, count, out, call.poller);
        }

       private:
        using Beside = typename BesideOf<M>::type;
        using Bounds = typename BoundsOf<M>::type;
        struct OwnMemory final : ThreadMemory {
            Memory content;
            PairsBeside<M> beside;
            std::optional<typename Bounds::Query> query;
            std::ptrdiff_t query_of = -1;
            Trial trial;
        };

        // Those of the columns take as long as some pairs. Pairs that are computed at once have
        // bounds of their own.
        bool are_worth_bounds() const noexcept {
            constexpr std::size_t fewest_rows = 4;
            std::ptrdiff_t n = 0, m = 0;
            for (const PreparedP& P : rows_) n = std::max(n, P.checked.curve.size());
            for (const PreparedQ& Q : columns_) m = std::max(m, Q.checked.curve.size());
            return rows_.size() >= fewest_rows && most_beside(n, m) == 1;
        }
        // What a tested pair takes, for the poller: about a microsecond.
        static constexpr std::int64_t bound_effort = 1 << 10;

        void keep_bounds(const runtime::ScratchVector<CheckedCurve>& Q) {
            std::vector<CurveView> views;
            views.reserve(Q.size());
            for (const CheckedCurve& checked : Q) views.push_back(checked.curve);
            bounds_.reserve(measure_, views);
            for (const PreparedQ& column : columns_) bounds_.keep(column);
            are_bounded_ = true;
        }

        // The value, or infinity if a bound is above the cutoff.
        double bounded_value(OwnMemory& own, std::ptrdiff_t i, std::ptrdiff_t j,
                             const Call<Memory>& call) const {
            if (own.query_of != i) {
                own.query.emplace(measure_, bounds_, rows_[static_cast<std::size_t>(i)]);
                own.query_of = i;
            }
            const PreparedQ& Q = columns_[static_cast<std::size_t>(j)];
            double bound = 0.0;
            own.query->quick(j, 1, &bound);
            const bool is_out =
                bound > call.cutoff || is_above(*own.query, j, Q, call.cutoff, Bounds::levels);
            own.trial.record(is_out);
            if (is_out) {
                if (M::is_swept)
                    call.poller.count_steps(steps()(row_points(i), 1, column_points(j)), 0);
                call.poller.spend(bound_effort);
                return std::numeric_limits<double>::infinity();
            }
            return own.query->value(j, Q, call);
        }

        const M& measure_;
        const runtime::ScratchVector<PreparedP>& rows_;
        runtime::ScratchVector<PreparedQ> columns_;
        Bounds bounds_;
        bool are_bounded_ = false;
    };

    M measure_;
};

}  // namespace curvewise::pairwise
