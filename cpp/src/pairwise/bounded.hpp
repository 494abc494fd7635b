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

// Whether tests pay. If they save less than they take, only some are made.
class Trial {
   public:
    Trial() = default;
    // With less credit in the beginning, and a longer first rest.
    Trial(double credit, std::ptrdiff_t first_rest) noexcept
        : credit_(credit), first_rest_(first_rest) {}

    bool is_due() noexcept {
        if (!rests(1)) return true;
        pass(1);
        return false;
    }
    // Whether none of the next tests is due.
    bool rests(std::ptrdiff_t count) const noexcept { return resting_ >= count; }
    void pass(std::ptrdiff_t count) noexcept { resting_ -= count; }
    void record(bool has_paid) noexcept { record(has_paid ? gain : -1.0); }
    // `saved` is the time that a test has saved, divided by its time; -1 if it saved none.
    void record(double saved) noexcept {
        credit_ = std::min(credit_ + saved, most_credit);
        if (saved > 0.0) rest_ = 0;
        if (credit_ >= 0.0) return;
        credit_ = 0.0;
        rest_ = std::min(rest_ == 0 ? first_rest_ : 2 * rest_ + 1, longest_rest);
        resting_ = rest_;
    }

   private:
    // A test that pays makes up for this number of tests that do not.
    static constexpr double gain = 4.0;
    static constexpr double most_credit = 16.0;
    static constexpr std::ptrdiff_t longest_rest = 63;

    double credit_ = most_credit / 2.0;
    std::ptrdiff_t first_rest_ = 1;
    std::ptrdiff_t rest_ = 0;
    std::ptrdiff_t resting_ = 0;
};

}  // namespace curvewise::pairwise
