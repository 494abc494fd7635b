// Tests of bounds are made as long as they save more time than they take.
#include <cstddef>

#include "check.hpp"
#include "pairwise/bounded.hpp"

namespace {

using curvewise::pairwise::Trial;

// How many of some rows are tested, if every `period`-th test saves `saved` times its time.
int tested(int rows, int period, double saved) {
    Trial trial;
    int count = 0;
    for (int row = 0; row < rows; ++row) {
        if (!trial.is_due()) continue;
        trial.record(count % period == 0 ? saved : -1.0);
        ++count;
    }
    return count;
}

void the_rarer_they_pay_the_fewer_are_made() {
    CHECK(tested(6400, 1, 0.1) == 6400);
    CHECK(tested(6400, 5, 4.0) == 6400);
    CHECK(tested(6400, 2, 0.9) < 6400);
    CHECK(tested(6400, 3, 0.5) < 6400 / 2);
    CHECK(tested(6400, 1, -1.0) < 6400 / 64 + 16);
}

void a_test_that_pays_ends_the_rest() {
    Trial trial{4.0, 1};
    for (int k = 0; k < 5; ++k) trial.record(false);
    CHECK(trial.rests(1));
    CHECK(!trial.rests(2));
    trial.pass(1);
    CHECK(trial.is_due());
    for (int k = 0; k < 5; ++k) trial.record(true);
    for (int k = 0; k < 16; ++k) {
        CHECK(trial.is_due());
        trial.record(false);
    }
}

}  // namespace

int main() {
    return check::run(
        {{"the rarer they pay, the fewer are made", the_rarer_they_pay_the_fewer_are_made},
         {"a test that pays ends the rest", a_test_that_pays_ends_the_rest}});
}
