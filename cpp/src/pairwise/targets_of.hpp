// The hooks of Targets for one measure class (see measure.hpp), with its bounds if it has some.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "curves/owned_curve.hpp"
#include "pairwise/measure.hpp"
#include "pairwise/targets.hpp"
#include "runtime/growing_list.hpp"

namespace curvewise::pairwise {

// Replaces M::Bounds: no value is below this bound, not even the value of a negative cost.
template <class M>
class NoBounds {
   public:
    static constexpr int levels = 1;
    void reserve(const M& /*measure*/, const std::vector<CurveView>& /*curves*/) noexcept {}
    void keep(const typename M::PreparedQ& /*Q*/) noexcept {}
    void make_room(const NoBounds& /*others*/) noexcept {}
    void take(NoBounds& /*others*/) noexcept {}

    class Query {
       public:
        Query(const M& measure, const NoBounds& /*bounds*/, const typename M::PreparedP& P) noexcept
            : measure_(measure), P_(P) {}
        void quick(double* bounds, std::ptrdiff_t count) const noexcept {
            std::fill_n(bounds, count, -std::numeric_limits<double>::infinity());
        }
        double refined(std::ptrdiff_t /*j*/, const typename M::PreparedQ& /*Q*/,
                       int /*level*/) const noexcept {
            return -std::numeric_limits<double>::infinity();
        }
        double value(std::ptrdiff_t /*j*/, const typename M::PreparedQ& Q,
                     const Call<typename M::Memory>& call) const {
            return measure_(P_, Q, call);
        }
        bool is_within(std::ptrdiff_t j, const typename M::PreparedQ& Q,
                       const Call<typename M::Memory>& call) const {
            return value(j, Q, call) <= call.cutoff;
        }

       private:
        const M& measure_;
        const typename M::PreparedP& P_;
    };
};

template <class M, class = void>
struct BoundsOf {
    using type = NoBounds<M>;
};
template <class M>
struct BoundsOf<M, std::void_t<typename M::Bounds>> {
    using type = typename M::Bounds;
};

template <class PreparedQ, class = void>
inline constexpr bool may_hold_points = false;
template <class PreparedQ>
inline constexpr bool
    may_hold_points<PreparedQ, std::void_t<decltype(&PreparedQ::look_at_own_points)>> = true;

template <class M>
class TargetsOf final : public Targets {
   public:
    explicit TargetsOf(const M& measure) : measure_(measure) {}

    void reserve(const std::vector<CurveView>& curves) override {
        curves_.make_room(static_cast<std::ptrdiff_t>(curves.size()));
        bounds_.reserve(measure_, curves);
    }
    void add(const CheckedCurve& Q, Poller& poller) override {
        PreparedQ curve = kept(Q, poller);
        bounds_.keep(curve);
        curves_.push_back(std::move(curve));
        points_ += Q.curve.size();
    }
    void make_room(const Targets& targets) override {
        const auto& others = static_cast<const TargetsOf&>(targets);
        curves_.make_room(others.curves_);
        owned_.make_room(others.owned_);
        bounds_.make_room(others.bounds_);
    }
    void take(Targets& targets) noexcept override {
        auto& others = static_cast<TargetsOf&>(targets);
        curves_.take(others.curves_);
        owned_.take(others.owned_);
        bounds_.take(others.bounds_);
        points_ += std::exchange(others.points_, 0);
    }
    Seen seen() const noexcept override {
        return {curves_.size(), curves_.size(), points_, nullptr};
    }
    const CheckedCurve& curve(std::ptrdiff_t j) const noexcept override {
        return curves_[j].checked;
    }
    void check(const CheckedCurve& P, Poller& poller) const override {
        measure_.check_p(typename M::PreparedP(P, poller), poller);
    }
    std::int64_t steps(std::ptrdiff_t n, const Seen& seen) const noexcept override {
        return M::steps(n, seen.remaining, seen.points);
    }
    std::unique_ptr<TargetQuery> query(const CheckedCurve& P, const Seen& seen,
                                       Poller& poller) const override {
        return std::make_unique<Query>(*this, seen.size, P, poller);
    }
    std::unique_ptr<ThreadMemory> make_memory() const override {
        return std::make_unique<OwnMemory>();
    }

   private:
    using PreparedQ = typename M::PreparedQ;
    using Bounds = typename BoundsOf<M>::type;
    struct OwnMemory final : ThreadMemory {
        typename M::Memory content;
    };

    class Query final : public TargetQuery {
       public:
        Query(const TargetsOf& targets, std::ptrdiff_t count, const CheckedCurve& P, Poller& poller)
            : targets_(targets),
              count_(count),
              P_(P, poller),
              bounds_(targets.measure_, targets.bounds_, P_) {
            targets.measure_.check_p(P_, poller);
        }
        int levels() const noexcept override { return Bounds::levels; }
        void quick(double* bounds) override { bounds_.quick(bounds, count_); }
        double refined(std::ptrdiff_t j, int level) override {
            return bounds_.refined(j, target(j), level);
        }
        double value(std::ptrdiff_t j, const PairCall& call) override {
            return bounds_.value(j, target(j), own(call));
        }
        bool is_within(std::ptrdiff_t j, const PairCall& call) override {
            return bounds_.is_within(j, target(j), own(call));
        }
        std::int64_t steps(std::ptrdiff_t j) const noexcept override {
            return M::steps(P_.checked.curve.size(), 1, target(j).checked.curve.size());
        }

       private:
        static Call<typename M::Memory> own(const PairCall& call) noexcept {
            typename M::Memory& memory = static_cast<OwnMemory&>(call.memory).content;
            return {call.cutoff, call.workers, call.poller, memory};
        }
        const typename M::PreparedQ& target(std::ptrdiff_t j) const noexcept {
            return targets_.curves_[j];
        }

        const TargetsOf& targets_;
        std::ptrdiff_t count_;
        typename M::PreparedP P_;
        typename Bounds::Query bounds_;
    };

    // With stored points: points that PreparedQ holds itself, or a separate copy.
    PreparedQ kept(const CheckedCurve& Q, Poller& poller) {
        if constexpr (may_hold_points<PreparedQ>) {
            PreparedQ prepared(Q, poller);
            if (prepared.holds_points()) {
                prepared.look_at_own_points();
                return prepared;
            }
        }
        curves::OwnedCurve points(Q.curve, poller);
        CheckedCurve copy = Q;
        copy.curve = points.view();
        owned_.push_back(std::move(points));
        return PreparedQ(copy, poller);
    }

    const M& measure_;
    runtime::GrowingList<PreparedQ> curves_;
    runtime::GrowingList<curves::OwnedCurve> owned_;  // whose points the curves refer to
    Bounds bounds_;
    std::int64_t points_ = 0;
};

}  // namespace curvewise::pairwise
