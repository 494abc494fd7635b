// What an Index may be asked after it was moved, and by the report of one of its own calls.
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

void an_index_that_was_moved_from_is_empty() {
    const Curve P{{0, 0}, {1, 1}};
    Index first({P}, DtwOptions{});
    const Index second = std::move(first);
    CHECK_EQUAL(second.size(), std::size_t{1});
    CHECK_EQUAL(first.size(), std::size_t{0});
    CHECK_EQUAL(first.curves().size(), std::size_t{0});
    const char* const message = "the index has been moved from; make another, or assign one to it";
    double distance = 0.0;
    std::int64_t place = 0;
    CHECK_THROWS(first.add({P}), std::logic_error, message);
    CHECK_THROWS(first.kneighbors({P}, 1, &distance, &place), std::logic_error, message);
    CHECK_THROWS(first.kneighbors(1, &distance, &place), std::logic_error, message);
    CHECK_THROWS(first.radius_neighbors({P}, 1.0), std::logic_error, message);
    CHECK_THROWS(first.radius_neighbors(1.0), std::logic_error, message);
    first = Index({P, P}, DtwOptions{});
    first.add({P});
    CHECK_EQUAL(first.size(), std::size_t{3});
}

// A report may ask the index, but not add to it: that would wait for the end of its own call.
void a_report_does_not_wait_for_its_own_call() {
    const Curve P = Random(13).curve(2000, 2);
    Index index({P, P}, DtwOptions{});
    double distance = 0.0;
    std::int64_t place = -1;
    int reports = 0;
    const auto ask = [&](std::int64_t, std::int64_t) {
        ++reports;
        CHECK_EQUAL(index.size(), std::size_t{2});
        CHECK_EQUAL(index.curves().size(), std::size_t{2});
        index.kneighbors({P.part(0, 5)}, 1, &distance, &place);
        return true;
    };
    const auto add = [&](std::int64_t, std::int64_t) {
        index.add({P});
        return true;
    };
    const char* const message =
        "add was called by the report of a call of the same index, for whose end it would wait; "
        "add the curves after that call";
    const std::chrono::milliseconds often(0);
    double found[2];
    std::int64_t nearest[2];
    for (const std::ptrdiff_t workers : {1, 2}) {
        Control asking(ask, often), adding(add, often), adding_anew(add, often);
        index.kneighbors({P, P}, 1, found, nearest, {workers}, &asking);
        CHECK_THROWS(index.kneighbors({P, P}, 1, found, nearest, {workers}, &adding),
                     std::logic_error, message);
        CHECK_THROWS(index.add({P}, &adding_anew), std::logic_error, message);
        CHECK_EQUAL(index.size(), std::size_t{2});
    }
    CHECK(reports > 2);
    Control asking(ask, often);
    index.add({}, &asking);
    index.add({P});
    CHECK_EQUAL(index.size(), std::size_t{3});
}

}  // namespace

int main() {
    return check::run(
        {{"an index that was moved from is empty", an_index_that_was_moved_from_is_empty},
         {"a report does not wait for its own call", a_report_does_not_wait_for_its_own_call}});
}
