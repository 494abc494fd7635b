// What a call sees of an index: its curves, and the numbers of points that these have. A view never
// changes. add() and remove() make another one, which the index shows to later calls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "pairwise/targets.hpp"

namespace curvewise::nearest {

// The indices of the targets. The first ones may have gaps, because curves were removed before they
// were targets; then each is the next.
class TargetIndices {
   public:
    TargetIndices() = default;
    // Throws std::invalid_argument unless they ascend from 0 to below `next`.
    TargetIndices(std::vector<std::int64_t> first, std::int64_t next);

    std::int64_t operator[](std::ptrdiff_t target) const noexcept;
    // The target of an index below that of the next; -1 where there is none.
    std::ptrdiff_t target(std::int64_t index) const noexcept;

   private:
    std::vector<std::int64_t> first_;
    std::int64_t next_ = 0;  // the index of the target behind the first ones
};

struct IndexView {
    using Sizes = std::set<std::ptrdiff_t>;

    pairwise::Seen seen;
    std::shared_ptr<const Sizes> sizes = std::make_shared<const Sizes>();

    // The targets that remain, in order.
    std::vector<std::ptrdiff_t> targets() const;
};

// How many curves of each number of points remain. Used by one thread at a time, which first makes
// the next view, and then cannot fail.
class SizeCounts {
   public:
    using Counts = std::map<std::ptrdiff_t, std::ptrdiff_t>;

    // The sizes where these are more or fewer: the given ones unless some size appears or vanishes.
    std::shared_ptr<const IndexView::Sizes> with(const Counts& more,
                                                 std::shared_ptr<const IndexView::Sizes> sizes);
    std::shared_ptr<const IndexView::Sizes> without(
        const Counts& fewer, std::shared_ptr<const IndexView::Sizes> sizes) const;
    // After with(more).
    void add(const Counts& more) noexcept;
    void remove(const Counts& fewer) noexcept;

   private:
    Counts counts_;
};

// The view without the targets of these indices, which are added to `fewer` by their numbers of
// points. Throws std::invalid_argument for an index of no curve.
IndexView without(const IndexView& view, const std::vector<std::int64_t>& indices,
                  const TargetIndices& all, const pairwise::Targets& targets,
                  SizeCounts::Counts& fewer);

}  // namespace curvewise::nearest
