// The hooks of BatchMeasure for one measure class (see measure.hpp). Instantiated by each measure's
// own file.
#pragma once

#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "pairwise/batch.hpp"
#include "pairwise/measure.hpp"
#include "pairwise/targets_of.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::pairwise {

// Replaces M::Beside: every pair by itself.
template <class M>
struct NothingBeside {
    static std::ptrdiff_t most(const M& /*measure*/, std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/,
                               std::ptrdiff_t /*dim*/) noexcept {
        return 1;
    }
    static std::ptrdiff_t gather(const M& /*measure*/,
                                 const typename M::PreparedQ* const* /*curves*/,
                                 std::ptrdiff_t /*count*/) noexcept {
        return 0;
    }
    static bool values(const M& /*measure*/, const typename M::PreparedP& /*P*/,
                       std::ptrdiff_t /*first*/, double* /*out*/, Poller& /*poller*/) noexcept {
        return false;
    }
};

template <class M, class = void>
struct BesideOf {
    using type = NothingBeside<M>;
};
template <class M>
struct BesideOf<M, std::void_t<typename M::Beside>> {
    using type = typename M::Beside;
};

template <class M>
class BatchOf final : public BatchMeasure {
   public:
    explicit BatchOf(const M& measure) : measure_(measure) {}

    double value(const Rows& rows, const CheckedCurve& Q, Poller& poller) const override {
        const PreparedP& p = sides(rows).front();
        const PreparedQ q(Q, poller);
        Memory memory;
        return measure_(p, q, {std::numeric_limits<double>::infinity(), 1, poller, memory});
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
                                            Poller& poller) const override {
        return std::make_unique<Pairs>(measure_, sides(rows), Q, poller);
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
              const runtime::ScratchVector<CheckedCurve>& Q, Poller& poller)
            : measure_(measure), rows_(rows), columns_(prepare_all<PreparedQ>(Q, poller)) {}

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
        double value(std::ptrdiff_t i, std::ptrdiff_t j, const PairCall& call) const override {
            Memory& memory = static_cast<OwnMemory&>(call.memory).content;
            return measure_(rows_[static_cast<std::size_t>(i)],
                            columns_[static_cast<std::size_t>(j)],
                            {call.cutoff, call.workers, call.poller, memory});
        }
        std::ptrdiff_t most_beside(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept override {
            if (columns_.empty()) return 1;
            return Beside::most(measure_, n, m, columns_.front().checked.curve.dim());
        }
        std::ptrdiff_t gather(const std::ptrdiff_t* columns, std::ptrdiff_t count,
                              ThreadMemory& memory) const override {
            auto& own = static_cast<OwnMemory&>(memory);
            own.gathered.clear();
            for (std::ptrdiff_t k = 0; k < count; ++k) {
                own.gathered.push_back(&columns_[static_cast<std::size_t>(columns[k])]);
            }
            return own.beside.gather(measure_, own.gathered.data(), count);
        }
        bool values(std::ptrdiff_t i, std::ptrdiff_t first, double* out,
                    const PairCall& call) const override {
            return static_cast<OwnMemory&>(call.memory)
                .beside.values(measure_, rows_[static_cast<std::size_t>(i)], first, out,
                               call.poller);
        }

       private:
        using Beside = typename BesideOf<M>::type;
        struct OwnMemory final : ThreadMemory {
            Memory content;
            Beside beside;
            runtime::ScratchVector<const PreparedQ*> gathered;
        };

        const M& measure_;
        const runtime::ScratchVector<PreparedP>& rows_;
        runtime::ScratchVector<PreparedQ> columns_;
    };

    M measure_;
};

}  // namespace curvewise::pairwise
