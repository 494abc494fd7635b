// The search for the nearest targets of one query, by one thread (see curvewise/nearest.hpp).
//
// A heap holds the candidates by their bounds. The candidate with the smallest bound is removed. If
// its bound can be raised, it is, and the candidate returns to the heap; if not, its distance is
// computed. The search ends if the smallest bound is above the k-th best distance. The comparison
// is strict, since an equal distance with a smaller index would still come first. O(N) time for N
// targets, and O(log N) for each removal, in addition to bounds and distances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "curvewise/nearest.hpp"
#include "pairwise/targets.hpp"
#include "runtime/poller.hpp"

namespace curvewise::nearest {

using pairwise::TargetQuery;
using runtime::Poller;

// Smaller distances first, then smaller indices; NaN distances last.
bool is_nearer(const Neighbor& a, const Neighbor& b) noexcept;

class NeighborSearch {
   public:
    // Of the targets that are seen. Throws Stopped where the poller says so.
    NeighborSearch(const pairwise::Targets& targets, const pairwise::Seen& seen, Poller& poller);

    // The `count` nearest, in order. `left_out`: a target to skip, or -1. Counts `all_steps` as
    // done.
    std::vector<Neighbor> nearest(TargetQuery& query, std::int64_t all_steps, std::ptrdiff_t count,
                                  std::ptrdiff_t left_out);
    // All within `radius`, by index; the distances are nan where they are not wanted.
    std::vector<Neighbor> within(TargetQuery& query, std::int64_t all_steps, double radius,
                                 bool with_distances, std::ptrdiff_t left_out);

    const SearchRecord& record() const noexcept { return record_; }

   private:
    struct Candidate {
        double bound;
        std::ptrdiff_t target;
        int level;
    };

    static bool comes_later(const Candidate& a, const Candidate& b) noexcept;
    void look_at(TargetQuery& query, Candidate candidate);
    // The distance, or nan where it is not wanted, of a target that is within the radius.
    std::optional<double> distance_within(TargetQuery& query, std::ptrdiff_t target, double radius,
                                          bool is_wanted);
    double value(TargetQuery& query, std::ptrdiff_t target, double cutoff);
    double refined(TargetQuery& query, const Candidate& candidate);
    void keep_if_near(const Neighbor& found);
    // A distance above it is of no interest.
    double cutoff() const noexcept;
    void finish_pair(TargetQuery& query, std::ptrdiff_t target);

    pairwise::Seen seen_;
    Poller& poller_;
    std::unique_ptr<pairwise::ThreadMemory> memory_;
    std::vector<double> quick_;
    std::vector<Candidate> heap_;
    std::vector<Neighbor> best_;  // a heap with the furthest on top
    std::size_t most_ = 0;
    std::int64_t counted_ = 0;
    SearchRecord record_;
};

}  // namespace curvewise::nearest
