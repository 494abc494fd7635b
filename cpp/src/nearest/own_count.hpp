// A search counts whole pairs, so the computation of a distance must not count them again.
#pragma once

#include "runtime/poller.hpp"

namespace curvewise::nearest {

// As long as this is there, the poller counts no steps.
class OwnCount {
   public:
    explicit OwnCount(runtime::Poller& poller) noexcept
        : poller_(poller), was_counting_(poller.set_counting(false)) {}
    OwnCount(const OwnCount&) = delete;
    OwnCount(OwnCount&&) = delete;
    OwnCount& operator=(const OwnCount&) = delete;
    OwnCount& operator=(OwnCount&&) = delete;
    ~OwnCount() { poller_.set_counting(was_counting_); }

   private:
    runtime::Poller& poller_;
    bool was_counting_;
};

}  // namespace curvewise::nearest
