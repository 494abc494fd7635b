// Several pairs of one measure class at once, by its class for that (see measure.hpp). For one
// thread, with curves from lists of prepared curves.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "pairwise/beside_effort.hpp"
#include "pairwise/measure.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::pairwise {

// For measures without one: every pair by itself.
template <class M>
struct NothingBeside {
    static std::ptrdiff_t most(const M& /*measure*/, std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/,
                               std::ptrdiff_t /*dim*/) noexcept {
        return 1;
    }
    static BesideEffort effort(const M& /*measure*/, std::ptrdiff_t /*n*/, std::ptrdiff_t /*m*/,
                               std::ptrdiff_t /*dim*/) noexcept {
        return {};
    }
    static std::ptrdiff_t gather(const M& /*measure*/,
                                 const typename M::PreparedQ* const* /*curves*/,
                                 std::ptrdiff_t /*count*/, bool /*has_cutoff*/) noexcept {
        return 0;
    }
    static bool values(const M& /*measure*/, const typename M::PreparedP& /*P*/,
                       std::ptrdiff_t /*first*/, double* /*out*/, Poller& /*poller*/) noexcept {
        return false;
    }
    static std::ptrdiff_t candidates(const M& /*measure*/, double /*cutoff*/,
                                     const typename M::PreparedP& /*P*/, std::ptrdiff_t /*first*/,
                                     std::ptrdiff_t* /*places*/, double& /*saved*/,
                                     Poller& /*poller*/) noexcept {
        return -1;
    }
    static bool bounds(const M& /*measure*/, double /*cutoff*/, const typename M::PreparedP& /*P*/,
                       double* /*out*/, Poller& /*poller*/) noexcept {
        return false;
    }
    static bool pair_values(const M& /*measure*/, const typename M::PreparedP* const* /*Ps*/,
                            const typename M::PreparedQ* const* /*Qs*/, std::ptrdiff_t /*count*/,
                            double* /*out*/, Poller& /*poller*/) noexcept {
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
inline constexpr bool has_beside = !std::is_same_v<typename BesideOf<M>::type, NothingBeside<M>>;

// The columns that were taken last, and pairs.
template <class M>
class PairsBeside {
   public:
    using PreparedP = typename M::PreparedP;
    using PreparedQ = typename M::PreparedQ;
    using Beside = typename BesideOf<M>::type;

    // Takes the first of these columns, and returns their number, which may be 0.
    std::ptrdiff_t gather(const M& measure, const runtime::ScratchVector<PreparedQ>& all,
                          const std::ptrdiff_t* columns, std::ptrdiff_t count, bool has_cutoff) {
        gathered_.clear();
        for (std::ptrdiff_t k = 0; k < count; ++k) {
            gathered_.push_back(&all[static_cast<std::size_t>(columns[k])]);
        }
        return columns_.gather(measure, gathered_.data(), count, has_cutoff);
    }
    Beside& columns() noexcept { return columns_; }

    // Writes the values of pairs (row, column); false, and nothing done, where they are not for
    // this.
    bool values(const M& measure, const runtime::ScratchVector<PreparedP>& rows,
                const runtime::ScratchVector<PreparedQ>& columns,
                const std::pair<std::ptrdiff_t, std::ptrdiff_t>* pairs, std::ptrdiff_t count,
                double* out, Poller& poller) {
        gathered_rows_.clear();
        gathered_.clear();
        for (std::ptrdiff_t k = 0; k < count; ++k) {
            gathered_rows_.push_back(&rows[static_cast<std::size_t>(pairs[k].first)]);
            gathered_.push_back(&columns[static_cast<std::size_t>(pairs[k].second)]);
        }
        return pairs_.pair_values(measure, gathered_rows_.data(), gathered_.data(), count, out,
                                  poller);
    }

   private:
    Beside columns_;
    Beside pairs_;
    runtime::ScratchVector<const PreparedP*> gathered_rows_;
    runtime::ScratchVector<const PreparedQ*> gathered_;
};

}  // namespace curvewise::pairwise
