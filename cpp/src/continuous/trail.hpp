// What a walk through the free-space diagram (reachable.hpp) reached of some of its rows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "continuous/reachable.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

// The reachable runs of a few rows, at most `most` runs in all.
class Trail {
   public:
    struct Mark {
        std::ptrdiff_t row;
        Runs runs;
    };

    explicit Trail(std::ptrdiff_t most_runs) noexcept : most_runs_(most_runs) {}

    void note(std::ptrdiff_t row, const Runs& runs) {
        if (row % stride_ != 0) return;
        marks_.push_back({row, runs});
        held_ += static_cast<std::ptrdiff_t>(runs.size());
        if (held_ > most_runs_) thin_out();
    }
    void forget_from(std::ptrdiff_t row) {
        while (!marks_.empty() && marks_.back().row >= row) {
            held_ -= static_cast<std::ptrdiff_t>(marks_.back().runs.size());
            marks_.pop_back();
        }
    }
    // The last mark at `row` or before it. Row 0 is always marked.
    const Mark& before(std::ptrdiff_t row) const noexcept {
        std::size_t k = marks_.size() - 1;
        while (k > 0 && marks_[k].row > row) --k;
        return marks_[k];
    }

   private:
    void thin_out() {
        stride_ *= 2;
        held_ = 0;
        std::size_t kept = 0;
        for (Mark& mark : marks_) {
            if (mark.row % stride_ != 0) continue;
            held_ += static_cast<std::ptrdiff_t>(mark.runs.size());
            std::swap(marks_[kept++], mark);
        }
        marks_.resize(kept);
    }

    std::ptrdiff_t most_runs_;
    std::ptrdiff_t held_ = 0;
    std::ptrdiff_t stride_ = 8;
    runtime::ScratchVector<Mark> marks_;
};

}  // namespace curvewise::continuous
