// The checks of curves that are added to an index, or searched for, before any work.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "curves/checks.hpp"
#include "curvewise/curve.hpp"
#include "nearest/index_view.hpp"
#include "nearest/query_run.hpp"
#include "pairwise/batch.hpp"
#include "pairwise/targets.hpp"
#include "runtime/poller.hpp"

namespace curvewise::nearest {

class IndexChecks {
   public:
    // All must outlive this.
    IndexChecks(const pairwise::BatchMeasure& measure, const Targets& targets,
                const TargetIndices& indices) noexcept
        : measure_(measure), targets_(targets), indices_(indices) {}

    CheckedCurve curve(const CurveView& curve, std::string name, Poller& poller) const;
    // The curves of X, or, where that is null, those of the view.
    Queries queries(const std::vector<CurveView>* X, const IndexView& view, Poller& poller) const;
    // The shapes of a list, which must agree with those of the index.
    void check_like_first(const curves::CurveList& list, const IndexView& view) const;

   private:
    void check_targets(const Queries& queries, const IndexView& view, Poller& poller) const;

    const pairwise::BatchMeasure& measure_;
    const Targets& targets_;
    const TargetIndices& indices_;
};

// Of the neighbours of a query in an index of `size` curves, which may be one of them.
void check_count(std::ptrdiff_t count, std::ptrdiff_t size, bool leaves_itself_out);

}  // namespace curvewise::nearest
