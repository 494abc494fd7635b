// The targets that a query has found: the nearest ones so far, or all within a radius.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "curvewise/nearest.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::nearest {

// Smaller distances first, then smaller indices; NaN distances last.
bool is_nearer(const Neighbor& a, const Neighbor& b) noexcept;

// A search for the `count` nearest, or, where that is 0, for all within a radius. Their distances
// are nan where they are not wanted.
struct Question {
    std::ptrdiff_t count = 0;
    double radius = std::numeric_limits<double>::infinity();
    bool with_distances = true;
};

class FoundNeighbors {
   public:
    void begin(const Question& question) noexcept {
        question_ = question;
        found_.clear();
    }
    // A distance above it is of no interest.
    double cutoff() const noexcept {
        if (question_.count == 0) return question_.radius;
        if (!is_full() || std::isnan(furthest().distance)) {
            return std::numeric_limits<double>::infinity();
        }
        return furthest().distance;
    }
    void keep(const Neighbor& found) {
        if (question_.count == 0) return keep_within(found);
        if (is_full()) {
            if (!is_nearer(found, furthest())) return;
            if (!are_few()) std::pop_heap(found_.begin(), found_.end(), is_nearer);
            found_.pop_back();
        }
        found_.push_back(found);
        if (are_few()) {
            insert_last();
        } else {
            std::push_heap(found_.begin(), found_.end(), is_nearer);
        }
    }
    // The nearest in order; those within a radius by index.
    runtime::ScratchVector<Neighbor>& sorted() {
        if (question_.count > 0) {
            if (!are_few()) std::sort(found_.begin(), found_.end(), is_nearer);
        } else {
            std::sort(found_.begin(), found_.end(),
                      [](const Neighbor& a, const Neighbor& b) { return a.index < b.index; });
        }
        return found_;
    }

   private:
    bool is_full() const noexcept {
        return found_.size() == static_cast<std::size_t>(question_.count);
    }
    // Few are kept in order, which takes less time than a heap.
    bool are_few() const noexcept { return question_.count <= 16; }
    const Neighbor& furthest() const noexcept { return are_few() ? found_.back() : found_.front(); }
    // The last one among the others, which are in order.
    void insert_last() noexcept {
        const Neighbor last = found_.back();
        std::size_t k = found_.size() - 1;
        for (; k > 0 && is_nearer(last, found_[k - 1]); --k) found_[k] = found_[k - 1];
        found_[k] = last;
    }
    void keep_within(const Neighbor& found) {
        if (!(found.distance <= question_.radius)) return;
        found_.push_back(found);
        if (!question_.with_distances) {
            found_.back().distance = std::numeric_limits<double>::quiet_NaN();
        }
    }

    Question question_;
    // Of the nearest, in order, or a heap with the furthest on top.
    runtime::ScratchVector<Neighbor> found_;
};

}  // namespace curvewise::nearest
