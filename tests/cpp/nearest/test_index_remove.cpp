// Curves that were removed from an index: later calls answer as an index of the others, whose
// indices stay, and calls that run see the curves that were there when they began.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

using Indices = std::vector<std::int64_t>;

void check_equal(const std::vector<Neighbor>& found, const std::vector<Neighbor>& expected,
                 const Indices& indices) {
    CHECK_EQUAL(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size() && k < expected.size(); ++k) {
        CHECK_EQUAL(found[k].index, indices[static_cast<std::size_t>(expected[k].index)]);
        CHECK_EQUAL(found[k].distance, expected[k].distance);
    }
}

// The curves of `indices` remain in `index`, and answer as an index of these alone.
void check_answers(const Index& index, const Indices& indices, const std::vector<CurveView>& curves,
                   const std::vector<CurveView>& X, const Measure& measure) {
    CHECK_EQUAL(index.indices(), indices);
    CHECK_EQUAL(index.size(), indices.size());
    CHECK_EQUAL(index.next_index(), static_cast<std::int64_t>(curves.size()));
    std::vector<CurveView> remaining;
    for (const std::int64_t j : indices) remaining.push_back(curves[static_cast<std::size_t>(j)]);
    CHECK_EQUAL(index.curves().size(), remaining.size());
    const Index expected(remaining, measure);
    const auto count = static_cast<std::ptrdiff_t>(indices.size());
    for (const std::ptrdiff_t k : {std::ptrdiff_t{1}, count / 2, count - 1}) {
        Indices rows;
        std::int64_t total = 0;
        Control control([&](std::int64_t, std::int64_t all) {
            total = all;
            return true;
        });
        SearchRecord record;
        SearchOptions options{2};
        options.record = &record;
        options.rows = &rows;
        const std::vector<Neighbor> found = index.kneighbors(k, options, &control);
        check_equal(found, expected.kneighbors(k), indices);
        CHECK_EQUAL(rows, indices);
        CHECK_EQUAL(record.pairs, count * (count - 1));
        std::vector<double> distances(found.size());
        Indices places(found.size());
        index.kneighbors(k, distances.data(), places.data());
        for (std::size_t i = 0; i < found.size(); ++i) {
            CHECK_EQUAL(distances[i], found[i].distance);
            CHECK_EQUAL(places[i], found[i].index);
        }
        std::vector<double> theirs(X.size() * static_cast<std::size_t>(k)), ours(theirs.size());
        Indices their_places(theirs.size()), our_places(theirs.size());
        expected.kneighbors(X, k, theirs.data(), their_places.data());
        index.kneighbors(X, k, ours.data(), our_places.data());
        CHECK_EQUAL(ours, theirs);
        for (std::size_t i = 0; i < ours.size(); ++i) {
            CHECK_EQUAL(our_places[i], indices[static_cast<std::size_t>(their_places[i])]);
        }
        const double radius = theirs.back();
        const auto within = index.radius_neighbors(X, radius);
        const auto within_expected = expected.radius_neighbors(X, radius);
        for (std::size_t i = 0; i < X.size(); ++i) {
            check_equal(within[i], within_expected[i], indices);
        }
        rows.clear();
        const auto own = index.radius_neighbors(radius, options);
        const auto own_expected = expected.radius_neighbors(radius);
        CHECK_EQUAL(rows, indices);
        CHECK_EQUAL(own.size(), indices.size());
        for (std::size_t i = 0; i < own.size(); ++i) check_equal(own[i], own_expected[i], indices);
    }
}

void answers_are_those_of_the_others() {
    DtwOptions window, on_sphere;
    window.window = 6;
    on_sphere.ground.metric = Metric::haversine;
    std::vector<Measure> measures{window, on_sphere};
    for_each_measure([&](const auto& defaults) { measures.push_back(defaults); });
    for (Measure& measure : measures) {
        if (auto* options = std::get_if<CurveLengthOptions>(&measure)) {
            options->scale = LengthScale::range;
        }
        const check::Note note("measure " + std::to_string(measure.index()));
        Random random(21);
        std::vector<Curve> owners, asked;
        for (int i = 0; i < 24; ++i) owners.push_back(random.walk(14 + random.index(5)));
        for (int i = 0; i < 3; ++i) asked.push_back(random.walk(12 + random.index(5)));
        for (int i = 0; i < 4; ++i) owners[static_cast<std::size_t>(5 * i + 4)] = owners[0];
        const std::vector<CurveView> all = test::views_of(owners), X = test::views_of(asked);
        std::vector<CurveView> curves(all.begin(), all.begin() + 15);
        Index index(curves, measure);
        index.remove({});
        index.remove({3, 0, 14});
        Indices indices{1, 2, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
        check_answers(index, indices, curves, X, measure);
        index.add({all.begin() + 15, all.end()});
        for (std::int64_t j = 15; j < 24; ++j) indices.push_back(j);
        check_answers(index, indices, all, X, measure);
        index.remove({9, 20, 23, 4});
        for (const std::int64_t j : {9, 20, 23, 4}) {
            indices.erase(std::find(indices.begin(), indices.end(), j));
        }
        check_answers(index, indices, all, X, measure);
        Index copy(index.curves(), index.indices(), index.next_index(), measure);
        check_answers(copy, indices, all, X, measure);
        for (Index* const one : {&index, &copy}) {
            one->add({all.begin(), all.begin() + 2});
            one->remove({24, 1});
        }
        CHECK_EQUAL(copy.indices(), index.indices());
        CHECK_THROWS(copy.remove({9}), std::invalid_argument,
                     "indices[0] is 9, which was removed before; give indices of curves that "
                     "remain");
    }
}

void none_is_removed_if_one_is_refused() {
    const Curve P{{0, 0}, {1, 1}};
    Index index({P, P, P, P, P}, DtwOptions{});
    index.remove({3});
    const auto refuses = [&](const Indices& indices, const char* message) {
        CHECK_THROWS(index.remove(indices), std::invalid_argument, message);
        CHECK_EQUAL(index.indices(), (Indices{0, 1, 2, 4}));
    };
    refuses({0, 5}, "indices[1] is 5; give indices of curves of the index, from 0 to 4");
    refuses({-1}, "indices[0] is -1; give indices of curves of the index, from 0 to 4");
    refuses({0, 1, 3},
            "indices[2] is 3, which was removed before; give indices of curves that remain");
    refuses({2, 0, 2}, "indices[2] is 2 again; give each index once");
    std::vector<double> distances(20);
    Indices places(20);
    CHECK_THROWS(index.kneighbors({P}, 5, distances.data(), places.data()), std::invalid_argument,
                 "n_neighbors is 5; give a whole number from 1 to 4, the curves of the index");
    CHECK_THROWS(index.kneighbors(4), std::invalid_argument,
                 "n_neighbors is 4; give a whole number from 1 to 3, the other curves of the "
                 "index");
    index.remove({0, 1, 2, 4});
    CHECK_EQUAL(index.size(), std::size_t{0});
    CHECK_EQUAL(index.radius_neighbors({P}, 1.0)[0].size(), std::size_t{0});
    CHECK_EQUAL(index.radius_neighbors(1.0).size(), std::size_t{0});
    const Curve solid{{0, 0, 0}, {1, 1, 1}};
    CHECK_THROWS(index.add({solid}), std::invalid_argument,
                 "curve 0 of the index has shape (2, 2) and curves[0] has shape (2, 3); both need "
                 "the same number of coordinates");
    index.add({P});
    CHECK_EQUAL(index.indices(), Indices{5});
    CHECK_THROWS(Index({P}, {0, 1}, 2, DtwOptions{}), std::invalid_argument,
                 "there are 2 indices for 1 curves; give one for each");
    CHECK_THROWS(Index({P, P}, {1, 1}, 2, DtwOptions{}), std::invalid_argument,
                 "indices[1] is 1; give indices in ascending order from 0 to below next_index, 2");
    Index none({}, DtwOptions{});
    CHECK_THROWS(none.remove({0}), std::invalid_argument,
                 "indices[0] is 0; the index has no curves");
}

// The band of a window admits no path between curves whose lengths differ too much.
void a_removed_curve_refuses_no_query() {
    DtwOptions options;
    options.window = 0;
    const Curve two{{0}, {1}}, three{{0}, {1}, {2}};
    Index index({two, three, three}, options);
    double distance = 0.0;
    std::int64_t place = 0;
    index.remove({1});
    CHECK_THROWS(index.kneighbors({two}, 1, &distance, &place), std::invalid_argument,
                 "window=0 admits no path between 2 and 3 points; use at least 1");
    index.remove({2});
    index.kneighbors({two}, 1, &distance, &place);
    CHECK_EQUAL(place, std::int64_t{0});
    index.add({two, three});
    index.remove({4});
    CHECK_EQUAL(index.kneighbors(1).size(), std::size_t{2});
}

void a_report_removes_nothing() {
    const Curve P = Random(13).curve(2000, 2);
    Index index({P, P}, DtwOptions{});
    Control removing(
        [&](std::int64_t, std::int64_t) {
            index.remove({0});
            return true;
        },
        std::chrono::milliseconds(0));
    std::vector<double> distances(2);
    Indices places(2);
    CHECK_THROWS(index.kneighbors({P, P}, 1, distances.data(), places.data(), {}, &removing),
                 std::logic_error,
                 "remove was called by the report of a call of the same index, which still sees "
                 "the curves; remove them after that call");
    CHECK_EQUAL(index.size(), std::size_t{2});
}

void a_search_sees_what_is_removed_meanwhile() {
    const Curve P = Random(15).curve(300, 2);
    Index index({P, P, P}, DtwOptions{});
    std::atomic<bool> is_asking{false}, may_end{false};
    Control slow(
        [&](std::int64_t, std::int64_t) {
            is_asking = true;
            while (!may_end) std::this_thread::yield();
            return true;
        },
        std::chrono::milliseconds(0));
    std::vector<Neighbor> found;
    std::thread search([&] { found = index.kneighbors(2, SearchOptions{}, &slow); });
    while (!is_asking) std::this_thread::yield();
    index.remove({0, 1});
    CHECK_EQUAL(index.size(), std::size_t{1});
    double distance = -1.0;
    std::int64_t place = -1;
    index.kneighbors({P}, 1, &distance, &place);
    CHECK_EQUAL(place, std::int64_t{2});
    may_end = true;
    search.join();
    CHECK_EQUAL(found.size(), std::size_t{6});
    const Indices expected{1, 2, 0, 2, 0, 1};
    for (std::size_t k = 0; k < found.size(); ++k) CHECK_EQUAL(found[k].index, expected[k]);
}

// Curves are added in order and removed in order, so a search sees a run of them.
void searches_see_a_run_of_curves_while_others_add_and_remove() {
    const std::int64_t all = 600, most = 12;
    std::vector<Curve> owners;
    for (std::int64_t j = 0; j < all; ++j) {
        const double up = static_cast<double>(j);
        owners.push_back(j % 3 == 0 ? Curve{{0, up}, {0, up}} : Curve{{0, up}, {0, up}, {0, up}});
    }
    const std::vector<CurveView> curves = test::views_of(owners);
    Index index({curves[0], curves[1], curves[2]}, FrechetOptions{});
    std::atomic<std::int64_t> added{3}, removing_next{0}, removed{0};
    std::atomic<bool> is_done{false};
    // What was there at first, without what had been removed.
    const auto check_run = [&](const Indices& seen, std::int64_t begin, std::int64_t end) {
        CHECK(seen.size() >= 2);
        if (seen.empty()) return;
        for (std::size_t k = 1; k < seen.size(); ++k) CHECK_EQUAL(seen[k], seen[k - 1] + 1);
        CHECK(seen.front() >= begin && seen.front() <= removing_next);
        CHECK(seen.back() >= end - 1);
    };
    std::vector<std::thread> asking;
    for (int t = 0; t < 2; ++t) {
        asking.emplace_back([&, t] {
            const Curve Q{{0, 0}};
            for (bool is_last = false; !is_last;) {
                is_last = is_done;
                const std::int64_t begin = removed, end = added;
                Indices seen;
                SearchOptions options{1};
                options.rows = &seen;
                if (t == 0) {
                    const auto within = index.radius_neighbors({Q}, 1e6, {1, false});
                    for (const Neighbor& found : within[0]) seen.push_back(found.index);
                } else {
                    const std::vector<Neighbor> found = index.kneighbors(1, options);
                    CHECK_EQUAL(found.size(), seen.size());
                    for (std::size_t k = 0; k < found.size(); ++k) {
                        CHECK_EQUAL(found[k].distance, 1.0);
                        CHECK_EQUAL(found[k].index, k == 0 ? seen[1] : seen[k] - 1);
                    }
                }
                check_run(seen, begin, end);
            }
        });
    }
    std::thread removal([&] {
        while (removed < all - 2) {
            if (removed + 2 >= added) {
                std::this_thread::yield();
                continue;
            }
            const std::int64_t next = removed;
            removing_next = next + 1;
            index.remove({next});
            removed = next + 1;
        }
    });
    while (added < all) {
        if (added - removed > most) {
            std::this_thread::yield();
            continue;
        }
        const std::int64_t end = std::min(added + 1 + added % 4, all);
        index.add({curves.begin() + added, curves.begin() + end});
        added = end;
    }
    removal.join();
    is_done = true;
    for (std::thread& thread : asking) thread.join();
    CHECK_EQUAL(index.indices(), (Indices{all - 2, all - 1}));
}

}  // namespace

int main() {
    return check::run(
        {{"answers are those of the others", answers_are_those_of_the_others},
         {"none is removed if one is refused", none_is_removed_if_one_is_refused},
         {"a removed curve refuses no query", a_removed_curve_refuses_no_query},
         {"a report removes nothing", a_report_removes_nothing},
         {"a search sees what is removed meanwhile", a_search_sees_what_is_removed_meanwhile},
         {"searches see a run of curves while others add and remove",
          searches_see_a_run_of_curves_while_others_add_and_remove}});
}
