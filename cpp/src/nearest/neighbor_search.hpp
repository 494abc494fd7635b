// The search for the nearest targets of one query, by one thread (see curvewise/nearest.hpp).
//
// A heap holds the candidates by their bounds, and boxes of trees around more of them
// (pairwise/bound_tree.hpp). The candidate or box with the smallest bound is removed. A box is
// replaced by the boxes or candidates in it. If the bound of a candidate can be raised, it is, and
// the candidate returns to the heap; if not, its distance is computed. The search ends if the
// smallest bound is above the k-th best distance. The comparison is strict, since an equal distance
// with a smaller index would still come first. Of equal bounds, boxes come first. So the candidates
// are removed in the same order as without trees. O(log N) time for each removal, in addition to
// bounds and distances, and O(N) for N targets in no tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "curvewise/nearest.hpp"
#include "nearest/found_neighbors.hpp"
#include "nearest/left_out.hpp"
#include "pairwise/targets.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::nearest {

using pairwise::BoundForest;
using pairwise::BoundTree;
using pairwise::TargetQuery;
using runtime::Poller;

class NeighborSearch {
   public:
    // Of the targets that are seen. Throws Stopped where the poller says so.
    NeighborSearch(const pairwise::Targets& targets, const pairwise::Seen& seen, Poller& poller);

    // The nearest, in order, or all within a radius, by index. Counts `all_steps` as done.
    runtime::ScratchVector<Neighbor>& answer(TargetQuery& query, std::int64_t all_steps,
                                             const Question& question, LeftOut left_out);

    // The counts since the last call.
    SearchRecord take_record() noexcept { return std::exchange(record_, {}); }

    // How many first bounds were computed for the last query.
    std::ptrdiff_t first_bounds() const noexcept { return first_bounds_; }

   private:
    struct Candidate {
        double bound;
        std::ptrdiff_t target;  // or, of a box, the complement of its place in its level
        int level;              // of the bound, or of the box in its tree
        int tree = 0;
    };

    struct OpenLeaf {
        std::ptrdiff_t place;
        int tree;
    };
    // A type, not a function, so that the heap's loops hold its code.
    struct ComesLater {
        bool operator()(const Candidate& a, const Candidate& b) const noexcept {
            return a.bound != b.bound ? a.bound > b.bound : a.target > b.target;
        }
    };
    bool is_wanted(std::ptrdiff_t target) const noexcept {
        return !left_out_.has(target) && seen_.has(target);
    }
    void find_nearest(TargetQuery& query);
    void find_within(TargetQuery& query, const Question& question);
    // Also counts the pairs of the query.
    void leave_out(LeftOut targets) noexcept;
    void push(const Candidate& candidate);
    // Puts boxes of a tree on the heap, from the `first` one of their level on.
    void push_boxes(TargetQuery& query, int tree, int level, std::ptrdiff_t first);
    // Puts what is in a box on the heap, or in all.
    void look_into(TargetQuery& query, const Candidate& box);
    void look_into_all(TargetQuery& query);
    void look_at(TargetQuery& query, Candidate candidate);
    // The bounds of up to BoundTree::fan boxes, from the `first` one of their level on.
    struct BoxBounds {
        double bounds[BoundTree::fan];
        std::ptrdiff_t count;
    };
    static BoxBounds bounds_of(TargetQuery& query, const BoundTree& tree, int level,
                               std::ptrdiff_t first);
    // Finds the leaves of a tree with bounds within the radius, or more leaves than most_leaves_.
    void find_leaves(TargetQuery& query, int tree, int level, std::ptrdiff_t first, double radius);
    // Calls look_at(target) for the targets in leaves_ whose first bounds are within the radius.
    template <class LookAt>
    void for_marked_within(TargetQuery& query, double radius, LookAt look_at);
    // Keeps a target whose first bound is within the radius, if it is, too.
    void look_within(TargetQuery& query, std::ptrdiff_t target, const Question& question);
    // Writes the first bounds of targets, or of those in a leaf, to quick_.
    void bound(TargetQuery& query, std::ptrdiff_t first, std::ptrdiff_t end);
    void bound(TargetQuery& query, const OpenLeaf& leaf);
    // Calls use(target, its place in the leaf).
    template <class Use>
    void for_targets(const OpenLeaf& leaf, Use use) const;
    BoundTree::Leaf held(const OpenLeaf& leaf) const noexcept;
    std::ptrdiff_t all_leaves() const noexcept;
    // The number of targets in trees, which are the first ones.
    std::ptrdiff_t planted() const noexcept;
    void clear_marks() { marks_.assign(static_cast<std::size_t>((planted() + 63) / 64), 0); }
    void mark(std::ptrdiff_t target) noexcept {
        marks_[static_cast<std::size_t>(target / 64)] |= std::uint64_t{1} << (target % 64);
    }
    bool is_marked(std::ptrdiff_t target) const noexcept {
        return (marks_[static_cast<std::size_t>(target / 64)] >> (target % 64) & 1) != 0;
    }
    const std::vector<BoundForest::Planted>& trees() const noexcept;
    // The distance, which may be any within the radius where it is not wanted.
    double distance_within(TargetQuery& query, std::ptrdiff_t target, const Question& question);
    double value(TargetQuery& query, std::ptrdiff_t target, double cutoff);
    double refined(TargetQuery& query, std::ptrdiff_t target, int level);
    // A distance above it is of no interest.
    double cutoff() const noexcept { return found_.cutoff(); }
    void finish_pair(TargetQuery& query, std::ptrdiff_t target);

    pairwise::Seen seen_;
    Poller& poller_;
    std::unique_ptr<pairwise::ThreadMemory> memory_;
    runtime::ScratchVector<double> quick_;  // first bounds, with room for those of a leaf
    runtime::ScratchVector<Candidate> heap_;
    runtime::ScratchVector<std::uint64_t> marks_;  // one bit for each target in a tree
    runtime::ScratchVector<OpenLeaf> leaves_;
    std::size_t most_leaves_ = 0;
    LeftOut left_out_;
    FoundNeighbors found_;
    std::int64_t counted_ = 0;
    std::ptrdiff_t first_bounds_ = 0;
    SearchRecord record_;
};

}  // namespace curvewise::nearest
