// Whether lower bounds of a pair exceed a cutoff, so that a batch need not compute the pair; and
// whether it pays to find out.
#pragma once

#include <algorithm>
#include <cstddef>

namespace curvewise::pairwise {

// Whether a bound of a level above 0 is above the cutoff, for P's query (M::Bounds::Query, see
// measure.hpp), Q number j, and `levels` levels. A level that does not come near the cutoff ends
// the test: the next one rarely raises a bound several times.
template <class Query, class PreparedQ>
bool is_above(Query& query, std::ptrdiff_t j, const PreparedQ& Q, double cutoff, int levels) {
    constexpr double most_raise = 4.0;
    for (int level = 1; level < levels; ++level) {
        const double bound = query.refined(j, Q, level);
        if (bound > cutoff) return true;
        if (bound * most_raise < cutoff) return false;
    }
    return false;
}

// Whether tests pay. Where few of them do, only some are made, so that they cost next to nothing.
class Trial {
   public:
    Trial() = default;
    // With less credit in the beginning, and a longer first rest.
    Trial(int credit, int first_rest) noexcept : credit_(credit), first_rest_(first_rest) {}

    bool is_due() noexcept {
        if (resting_ == 0) return true;
        --resting_;
        return false;
    }
    void record(bool has_paid) noexcept {
        credit_ = std::min(credit_ + (has_paid ? gain : -1), most_credit);
        if (has_paid) rest_ = 0;
        if (credit_ >= 0) return;
        credit_ = 0;
        rest_ = std::min(rest_ == 0 ? first_rest_ : 2 * rest_ + 1, longest_rest);
        resting_ = rest_;
    }

   private:
    // A test that pays makes up for so many that do not.
    static constexpr int gain = 4;
    static constexpr int most_credit = 16;
    static constexpr int longest_rest = 63;

    int credit_ = most_credit / 2;
    int first_rest_ = 1;
    int rest_ = 0;
    int resting_ = 0;
};

}  // namespace curvewise::pairwise
