// One curve against many stored curves, for any measure: the pairs of a search for the nearest.
// Every pair has its value, and may have lower bounds of it, from cheap to expensive. No bound is
// above the computed value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "curves/checks.hpp"
#include "pairwise/beside_effort.hpp"
#include "pairwise/bound_tree.hpp"
#include "pairwise/pair_run.hpp"
#include "pairwise/stored_curve.hpp"

namespace curvewise::pairwise {

using curves::CheckedCurve;

// One P, prepared, for one thread.
class TargetQuery : public runtime::InScratch {
   public:
    TargetQuery() = default;
    TargetQuery(const TargetQuery&) = delete;
    TargetQuery(TargetQuery&&) = delete;
    TargetQuery& operator=(const TargetQuery&) = delete;
    TargetQuery& operator=(TargetQuery&&) = delete;
    virtual ~TargetQuery() = default;

    // The number of bounds of a pair, at least 1.
    virtual int levels() const noexcept = 0;
    // Writes the first bound of each of `count` targets from `first` on.
    virtual void quick(std::ptrdiff_t first, std::ptrdiff_t count, double* bounds) = 0;
    // Of those in a leaf of a tree, whose rows begin with target `first`.
    virtual void quick(std::ptrdiff_t first, const BoundTree::Leaf& leaf, double* bounds) = 0;
    // Writes a bound for each of `count` boxes: no first bound of a target with its row in the box
    // is below.
    virtual void of_boxes(const double* boxes, std::ptrdiff_t count, double* bounds) = 0;
    // That of a level above 0.
    virtual double refined(std::ptrdiff_t j, int level) = 0;
    virtual double value(std::ptrdiff_t j, const PairCall& call) = 0;
    // Whether the value is at most the call's cutoff.
    virtual bool is_within(std::ptrdiff_t j, const PairCall& call) = 0;
    // The nominal steps of the pair with target j.
    virtual std::int64_t steps(std::ptrdiff_t j) const noexcept = 0;
};

// Rows of queries and columns of targets. Several pairs are computed at once, in less time than one
// by one. For one thread.
class TargetBlock : public runtime::InScratch {
   public:
    TargetBlock() = default;
    TargetBlock(const TargetBlock&) = delete;
    TargetBlock(TargetBlock&&) = delete;
    TargetBlock& operator=(const TargetBlock&) = delete;
    TargetBlock& operator=(TargetBlock&&) = delete;
    virtual ~TargetBlock() = default;

    // Replaces the rows, or the columns. The curves must outlive them.
    virtual void set_rows(const CheckedCurve* const* queries, std::ptrdiff_t count,
                          Poller& poller) = 0;
    virtual void set_columns(const std::ptrdiff_t* targets, std::ptrdiff_t count) = 0;
    // Takes the first of these columns, which have the same number of points, and returns their
    // number: 0 if they are not for this.
    virtual std::ptrdiff_t gather(const std::ptrdiff_t* columns, std::ptrdiff_t count) = 0;
    // Writes a lower bound of the value of a row and each column taken; one above the cutoff may be
    // any other that is. Returns false, and does nothing, if a curve lacks one.
    virtual bool bounds(std::ptrdiff_t row, double cutoff, double* out, Poller& poller) = 0;
    // Writes the values of a row and the columns taken. Returns false, and does nothing, where the
    // row is not for this.
    virtual bool values(std::ptrdiff_t row, double* out, Poller& poller) = 0;
    // The same for pairs of a row and a column. All rows have the same number of points, and so
    // have all columns.
    virtual bool pair_values(const std::pair<std::ptrdiff_t, std::ptrdiff_t>* pairs,
                             std::ptrdiff_t count, double* out, Poller& poller) = 0;
    // One by itself.
    virtual double value(std::ptrdiff_t row, std::ptrdiff_t column, double cutoff,
                         Poller& poller) = 0;
};

// The targets that a call sees: those of the first `size` that are not removed. Others may be added
// or removed meanwhile.
struct Seen {
    std::ptrdiff_t size = 0;
    std::ptrdiff_t remaining = 0;
    std::int64_t points = 0;  // of all that remain together
    // By target, shorter where the last ones remain; null if none is removed.
    std::shared_ptr<const std::vector<bool>> removed;
    // Over the first bounds, of those that are removed, too; null where there are no trees.
    std::shared_ptr<const BoundForest> forest;

    bool has(std::ptrdiff_t j) const noexcept {
        const auto place = static_cast<std::size_t>(j);
        return removed == nullptr || place >= removed->size() || !(*removed)[place];
    }
};

// Where the points of curves are that are added: in memory of others, to be copied; in memory that
// is held; or there with their bounds.
enum class PointSource { others, held, held_with_bounds };

// All curves that take Q's place, prepared. What is added stays as it is. So queries may be made,
// and used, by several threads at once, while one thread adds more: a call has seen() from the
// thread that adds, and reads nothing behind.
class Targets {
   public:
    Targets() = default;
    Targets(const Targets&) = delete;
    Targets(Targets&&) = delete;
    Targets& operator=(const Targets&) = delete;
    Targets& operator=(Targets&&) = delete;
    virtual ~Targets() = default;

    // Prepares for all curves that will be added here.
    virtual void reserve(const std::vector<CurveView>& curves, PointSource source) = 0;
    // Keeps a copy of the points. Throws where the curve serves no P.
    virtual void add(const CheckedCurve& Q, Poller& poller) = 0;
    // The same without a copy: the points are in layout(), with PointBlocks::padding finite numbers
    // behind, in memory that is held. The bounds may be there, too, as write_bounds() writes them,
    // and are otherwise null.
    virtual void look_at(const CheckedCurve& Q, const StoredCurve& stored, const double* bounds,
                         Poller& poller) = 0;
    virtual void hold(std::shared_ptr<const void> points) = 0;
    virtual PointLayout layout() const noexcept = 0;
    virtual const StoredCurve& stored(std::ptrdiff_t j) const noexcept = 0;
    // What files name the kind of the bounds, or 0 where these cannot be stored; how many numbers
    // those of a curve have, and these.
    virtual std::uint64_t bounds_format() const noexcept = 0;
    virtual std::ptrdiff_t bounds_size(std::ptrdiff_t points,
                                       std::ptrdiff_t dim) const noexcept = 0;
    virtual void write_bounds(std::ptrdiff_t j, double* to) const noexcept = 0;
    // Makes the trees of those that were added to none.
    virtual void plant(Poller& poller) = 0;
    // Adds those of `others`, of the same measure, for which room was made, and leaves it empty.
    // The trees of both are merged.
    virtual void make_room(const Targets& others) = 0;
    virtual void take(Targets& others) noexcept = 0;
    // All, for the thread that adds. None is removed: what is removed stays here, and callers skip
    // it.
    virtual Seen seen() const noexcept = 0;

    // As it was added, without its name, with the points that are kept.
    virtual CheckedCurve curve(std::ptrdiff_t j) const = 0;
    // Throws where P serves no Q, as query() does.
    virtual void check(const CheckedCurve& P, Poller& poller) const = 0;
    virtual std::unique_ptr<TargetQuery> query(const CheckedCurve& P, Poller& poller) const = 0;
    // The nominal steps of a P of n points with all that are seen.
    virtual std::int64_t steps(std::ptrdiff_t n, const Seen& seen) const noexcept = 0;
    virtual std::unique_ptr<ThreadMemory> make_memory() const = 0;
    // How many pairs of n and m points are computed at once; 1 where one by one is as fast.
    virtual std::ptrdiff_t most_beside(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept = 0;
    // The cost of pairs that are computed several at a time.
    virtual BesideEffort effort_beside(std::ptrdiff_t n, std::ptrdiff_t m) const noexcept = 0;
    // Null where all pairs are computed one by one.
    virtual std::unique_ptr<TargetBlock> make_block() const = 0;
};

}  // namespace curvewise::pairwise
