// Simultaneous calls of several threads, on the same curves, the same Prepared and the same Index:
// each returns the result of a single call. ThreadSanitizer checks the rest (.ci/sanitize threads).
#include <cstdint>
#include <thread>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

// Similar loops, so that bounds and pruning have something to do, all above 0.
std::vector<Curve> curves(std::size_t count) {
    Random random(1);
    std::vector<Curve> found;
    while (found.size() < count) {
        Curve curve = random.walk(120 + random.index(80));
        for (std::ptrdiff_t i = 0; i < curve.size(); ++i) curve(i, 1) += 100.0;
        found.push_back(curve);
    }
    return found;
}

// Every measure of them, by every kind of call.
class Shared {
   public:
    Shared(const std::vector<CurveView>& curves, const Measure& measure)
        : curves_(curves),
          measure_(measure),
          prepared_(curves.front(), measure),
          index_(curves, measure) {}

    std::vector<double> values() const {
        const std::size_t k = curves_.size();
        std::vector<double> found{evaluate(measure_, curves_[0], curves_[1])};
        found.resize(1 + 3 * k + k * k);
        prepared_(curves_, &found[1]);
        std::vector<std::int64_t> places(2 * k);
        SearchOptions search;
        search.workers = 2;
        index_.kneighbors(curves_, 2, &found[1 + k], places.data(), search);
        BatchOptions batch;
        batch.workers = 2;
        cdist(curves_, measure_, &found[1 + 3 * k], batch);
        for (const std::int64_t place : places) found.push_back(static_cast<double>(place));
        return found;
    }

   private:
    const std::vector<CurveView>& curves_;
    Measure measure_;
    Prepared prepared_;
    Index index_;
};

template <class Work>
void at_once(std::size_t count, Work work) {
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < count; ++t) threads.emplace_back(work, t);
    for (std::thread& thread : threads) thread.join();
}

void the_same_values_as_alone() {
    const std::vector<Curve> owned = curves(5);
    const std::vector<CurveView> views = views_of(owned);
    for_each_measure([&](const auto& options) {
        const check::Note note(options.measure);
        const Shared shared(views, options);
        const std::vector<double> alone = shared.values();
        std::vector<std::vector<double>> found(4);
        at_once(found.size(), [&](std::size_t t) { found[t] = shared.values(); });
        for (const std::vector<double>& one : found) CHECK_EQUAL(one, alone);
    });
}

// Searches see the index before or after an addition, and nothing between.
void searches_while_curves_are_added() {
    const std::vector<Curve> owned = curves(12);
    const std::vector<CurveView> views = views_of(owned);
    Index index({views[0]}, FrechetOptions{});
    std::vector<double> nearest(3, -1.0);
    at_once(4, [&](std::size_t t) {
        if (t == 3) {
            for (std::size_t k = 1; k < views.size(); ++k) index.add({views[k]});
            return;
        }
        for (int k = 0; k < 30; ++k) {
            std::int64_t place = -1;
            index.kneighbors({views[0]}, 1, &nearest[t], &place);
        }
    });
    CHECK_EQUAL(nearest, (std::vector<double>(3, 0.0)));
    CHECK_EQUAL(index.size(), views.size());
}

}  // namespace

int main() {
    return check::run({{"the same values as alone", the_same_values_as_alone},
                       {"searches while curves are added", searches_while_curves_are_added}});
}
