// The hooks of Targets for one measure class (see measure.hpp), with its bounds if it has some.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "curves/owned_curve.hpp"
#include "pairwise/block_of.hpp"
#include "pairwise/measure.hpp"
#include "pairwise/stored_curve.hpp"
#include "pairwise/targets.hpp"
#include "runtime/growing_list.hpp"

namespace curvewise::pairwise {

// Replaces M::Bounds: no value is below this bound, not even the value of a negative cost.
template <class M>
class NoBounds {
   public:
    static constexpr int levels = 1;
    static constexpr std::uint64_t format = 0;
    void reserve(const M& /*measure*/, const std::vector<CurveView>& /*curves*/) noexcept {}
    void keep(const typename M::PreparedQ& /*Q*/) noexcept {}
    static RowShape row_shape(const M& /*measure*/) noexcept { return {}; }
    void write_row(std::ptrdiff_t /*j*/, double* /*row*/) const noexcept {}
    void make_room(const NoBounds& /*others*/) noexcept {}
    void take(NoBounds& /*others*/) noexcept {}

    class Query {
       public:
        Query(const M& measure, const NoBounds& /*bounds*/, const typename M::PreparedP& P) noexcept
            : measure_(measure), P_(P) {}
        void quick(std::ptrdiff_t /*first*/, std::ptrdiff_t count, double* bounds) const noexcept {
            std::fill_n(bounds, count, -std::numeric_limits<double>::infinity());
        }
        // There are no trees.
        void quick(std::ptrdiff_t /*first*/, const BoundTree::Leaf& leaf,
                   double* bounds) const noexcept {
            quick(0, leaf.count, bounds);
        }
        void of_boxes(const double* /*boxes*/, std::ptrdiff_t count,
                      double* bounds) const noexcept {
            quick(0, count, bounds);
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

// Whether a PreparedQ only refers to stored points, and is made when it is needed. On the sphere,
// none does.
template <class PreparedQ>
inline constexpr bool is_view =
    std::is_constructible_v<PreparedQ, const StoredCurve&, std::ptrdiff_t>;

template <class PreparedQ, class = void>
inline constexpr PointLayout layout_of = PointLayout::rows;
template <class PreparedQ>
inline constexpr PointLayout layout_of<PreparedQ, std::void_t<decltype(PreparedQ::layout)>> =
    PreparedQ::layout;

template <class M>
class TargetsOf final : public Targets {
   public:
    explicit TargetsOf(const M& measure)
        : measure_(measure), on_sphere_(measure.requirements().on_sphere) {}

    void reserve(const std::vector<CurveView>& curves, PointSource source) override {
        const auto count = static_cast<std::ptrdiff_t>(curves.size());
        curves_.make_room(count);
        if (!are_views()) prepared_.make_room(count);
        if (source != PointSource::held_with_bounds) bounds_.reserve(measure_, curves);
        if (!curves.empty()) dim_ = curves[0].dim();
        if (source != PointSource::others || curves.empty()) return;
        std::ptrdiff_t numbers = 0;
        for (const CurveView& curve : curves) numbers += curve.size() * dim_;
        blocks_.reserve(numbers);
    }
    void add(const CheckedCurve& Q, Poller& poller) override {
        const std::ptrdiff_t size = Q.curve.size();
        double* const points = blocks_.append(size * dim_);
        write_points(Q.curve, layout(), points, poller);
        look_at(Q,
                {points, Q.largest, size, Q.curve.is_flat(),
                 squares_are_in_domain(points, size * dim_)},
                nullptr, poller);
    }
    void look_at(const CheckedCurve& Q, const StoredCurve& stored, const double* bounds,
                 Poller& poller) override {
        if (!are_views()) {
            PreparedQ prepared = with_stored(Q, stored, poller);
            bounds_.keep(prepared);
            prepared.checked.name = std::string();
            prepared_.push_back(std::move(prepared));
        } else if (bounds != nullptr) {
            if constexpr (Bounds::format != 0) bounds_.look_at(stored.size, dim_, bounds);
        } else if constexpr (is_view<PreparedQ>) {
            bounds_.keep(PreparedQ(stored, dim_));
        }
        curves_.push_back(stored);
        points_ += stored.size;
    }
    const StoredCurve& stored(std::ptrdiff_t j) const noexcept override { return curves_[j]; }
    std::uint64_t bounds_format() const noexcept override {
        return are_views() ? Bounds::format : 0;
    }
    std::ptrdiff_t bounds_size(std::ptrdiff_t points, std::ptrdiff_t dim) const noexcept override {
        if constexpr (Bounds::format != 0) {
            if (are_views()) return Bounds::stored_size(points, dim);
        }
        return 0;
    }
    void write_bounds(std::ptrdiff_t j, double* to) const noexcept override {
        if constexpr (Bounds::format != 0) bounds_.write(j, to);
    }
    void hold(std::shared_ptr<const void> points) override { blocks_.hold(std::move(points)); }
    PointLayout layout() const noexcept override {
        return on_sphere_ ? PointLayout::rows : layout_of<PreparedQ>;
    }
    void plant(Poller& poller) override { forest_ = with_trees_of(TargetsOf(measure_), poller); }
    void make_room(const Targets& targets) override {
        const auto& others = static_cast<const TargetsOf&>(targets);
        curves_.make_room(others.curves_);
        prepared_.make_room(others.prepared_);
        blocks_.make_room(others.blocks_);
        bounds_.make_room(others.bounds_);
        Poller unpolled(nullptr);
        merged_forest_ = with_trees_of(others, unpolled);
    }
    void take(Targets& targets) noexcept override {
        auto& others = static_cast<TargetsOf&>(targets);
        if (curves_.size() == 0) dim_ = others.dim_;
        curves_.take(others.curves_);
        prepared_.take(others.prepared_);
        blocks_.take(others.blocks_);
        bounds_.take(others.bounds_);
        points_ += std::exchange(others.points_, 0);
        forest_ = std::move(merged_forest_);
        others.forest_ = nullptr;
    }
    Seen seen() const noexcept override {
        return {curves_.size(), curves_.size(), points_, nullptr, forest_};
    }
    CheckedCurve curve(std::ptrdiff_t j) const override { return checked(curves_[j]); }
    void check(const CheckedCurve& P, Poller& poller) const override {
        if constexpr (M::checks_p) {
            const curves::LoadedCurve loaded(P, poller);
            measure_.check_p(typename M::PreparedP(loaded.checked(), poller), poller);
        }
    }
    std::int64_t steps(std::ptrdiff_t n, const Seen& seen) const noexcept override {
        return M::steps(n, seen.remaining, seen.points);
    }
    std::unique_ptr<TargetQuery> query(const CheckedCurve& P, Poller& poller) const override {
        return std::make_unique<Query>(*this, P, poller);
    }
    std::unique_ptr<ThreadMemory> make_memory() const override {
        return std::make_unique<OwnMemory>();
    }
    std::ptrdiff_t most_beside(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept override {
        return on_sphere_ ? 1 : BesideOf<M>::type::most(measure_, n, m, dim_);
    }
    BesideEffort effort_beside(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept override {
        return BesideOf<M>::type::effort(measure_, n, m, dim_);
    }
    std::unique_ptr<TargetBlock> make_block() const override {
        if constexpr (has_beside<M>) {
            return std::make_unique<BlockOf<M>>(measure_, curves_, dim_);
        } else {
            return nullptr;
        }
    }

   private:
    using PreparedQ = typename M::PreparedQ;
    using Bounds = typename BoundsOf<M>::type;
    struct OwnMemory final : ThreadMemory {
        typename M::Memory content;
    };

    class Query final : public TargetQuery {
       public:
        Query(const TargetsOf& targets, const CheckedCurve& P, Poller& poller)
            : targets_(targets), P_(P, poller), bounds_(targets.measure_, targets.bounds_, P_) {
            targets.measure_.check_p(P_, poller);
        }
        int levels() const noexcept override { return Bounds::levels; }
        void quick(std::ptrdiff_t first, std::ptrdiff_t count, double* bounds) override {
            bounds_.quick(first, count, bounds);
        }
        void quick(std::ptrdiff_t first, const BoundTree::Leaf& leaf, double* bounds) override {
            bounds_.quick(first, leaf, bounds);
        }
        void of_boxes(const double* boxes, std::ptrdiff_t count, double* bounds) override {
            bounds_.of_boxes(boxes, count, bounds);
        }
        double refined(std::ptrdiff_t j, int level) override {
            return targets_.with_target(
                j, [&](const PreparedQ& Q) { return bounds_.refined(j, Q, level); });
        }
        double value(std::ptrdiff_t j, const PairCall& call) override {
            return targets_.with_target(
                j, [&](const PreparedQ& Q) { return bounds_.value(j, Q, own(call)); });
        }
        bool is_within(std::ptrdiff_t j, const PairCall& call) override {
            return targets_.with_target(
                j, [&](const PreparedQ& Q) { return bounds_.is_within(j, Q, own(call)); });
        }
        std::int64_t steps(std::ptrdiff_t j) const noexcept override {
            return M::steps(P_.checked.curve.size(), 1, targets_.curves_[j].size);
        }

       private:
        static Call<typename M::Memory> own(const PairCall& call) noexcept {
            typename M::Memory& memory = static_cast<OwnMemory&>(call.memory).content;
            return {call.cutoff, call.workers, call.poller, memory};
        }

        const TargetsOf& targets_;
        typename M::PreparedP P_;
        typename Bounds::Query bounds_;
    };

    bool are_views() const noexcept { return is_view<PreparedQ> && !on_sphere_; }
    CheckedCurve checked(const StoredCurve& stored) const {
        return {stored.view(dim_, layout()), stored.largest, on_sphere_};
    }
    // One that is kept, and may refer to the points.
    PreparedQ with_stored(const CheckedCurve& Q, const StoredCurve& stored, Poller& poller) const {
        CheckedCurve here = Q;
        here.curve = stored.view(dim_, layout());
        if constexpr (std::is_constructible_v<PreparedQ, CheckedCurve, Poller&, PointsStay>) {
            return {here, poller, PointsStay()};
        } else {
            return {here, poller};
        }
    }
    // Calls use(target j, prepared).
    template <class Use>
    auto with_target(std::ptrdiff_t j, Use use) const {
        if constexpr (is_view<PreparedQ>) {
            if (!on_sphere_) return use(PreparedQ(curves_[j], dim_));
        }
        return use(prepared_[j]);
    }

    BoundForest forest_of() const { return forest_ ? *forest_ : BoundForest(); }
    // Over the bounds of these and the others.
    std::shared_ptr<const BoundForest> with_trees_of(const TargetsOf& others,
                                                     Poller& poller) const {
        const std::ptrdiff_t own = curves_.size(), size = own + others.curves_.size();
        if (size == 0) return nullptr;
        const auto write = [&](std::ptrdiff_t j, double* row) {
            if (j < own) return bounds_.write_row(j, row);
            others.bounds_.write_row(j - own, row);
        };
        const BoundRows rows{(own > 0 ? bounds_ : others.bounds_).row_shape(measure_), write};
        BoundForest forest = forest_of().with(own, others.forest_of(), size, rows, poller);
        if (forest.size() == 0) return nullptr;
        return std::make_shared<const BoundForest>(std::move(forest));
    }

    const M& measure_;
    bool on_sphere_;
    std::ptrdiff_t dim_ = 0;
    runtime::GrowingList<StoredCurve> curves_;
    runtime::GrowingList<PreparedQ> prepared_;  // none where they are views
    PointBlocks blocks_;
    Bounds bounds_;
    std::int64_t points_ = 0;
    std::shared_ptr<const BoundForest> forest_;         // null where there are no trees
    std::shared_ptr<const BoundForest> merged_forest_;  // with those for which room was made
};

}  // namespace curvewise::pairwise
