// Indexes with trees over their first bounds: answers and counts are those of a search of all
// bounds, for every number of curves around the sizes of leaves and trees, however they were added.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"
#include "nearest/neighbor_search.hpp"
#include "pairwise/batch.hpp"

namespace {

using namespace curvewise;
using curves::CheckedCurve;
using nearest::NeighborSearch;
using pairwise::BoundForest;
using pairwise::Seen;
using pairwise::Targets;
using runtime::Poller;
using test::Curve;
using test::Random;

constexpr std::ptrdiff_t fewest = BoundForest::fewest_rows;
constexpr std::ptrdiff_t leaf = pairwise::BoundTree::leaf_rows;

// Short curves, in groups or not, of which many are equally far; now and then one beyond the usual
// range, whose distance may overflow.
Curve some_curve(Random& random, std::ptrdiff_t dim) {
    const std::ptrdiff_t n = 1 + random.index(5);
    Curve curve = random.index(4) == 0 ? random.curve(n, dim) : random.lattice_curve(n, dim);
    const auto group = static_cast<double>(random.index(5));
    for (std::ptrdiff_t i = 0; i < n; ++i) curve(i, 0) += 3.0 * group;
    if (random.index(80) != 0) return curve;
    return curve.times_power_of_two(random.index(2) == 0 ? 1015 : -600);
}

std::vector<Curve> some_curves(Random& random, std::ptrdiff_t count, std::ptrdiff_t dim) {
    std::vector<Curve> curves;
    for (std::ptrdiff_t j = 0; j < count; ++j) curves.push_back(some_curve(random, dim));
    return curves;
}

Curve on_globe(Curve curve) {
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        curve(i, 0) = std::remainder(20.0 * curve(i, 0), 360.0);
        curve(i, 1) = std::remainder(20.0 * curve(i, 1), 90.0);
    }
    return curve;
}

struct Case {
    const char* name;
    Measure measure;
    bool has_trees;
};

std::vector<Case> cases() {
    DtwOptions band, squares, open, normalized, on_sphere, minkowski, negative;
    band.window_fraction = 0.7;
    squares.ground.metric = Metric::sqeuclidean;
    squares.step_pattern = StepPattern::symmetric2;
    open.open_begin = true;
    open.ground.metric = Metric::cityblock;
    normalized.step_pattern = StepPattern::symmetric2;
    normalized.normalize = true;
    on_sphere.ground.metric = Metric::haversine;
    minkowski.ground = {Metric::minkowski, 3.0};
    negative.own_steps.rows = {{1, 1, 1, -1}, {1, 0, 0, -1}, {2, 1, 0, -1},
                               {2, 0, 0, 2},  {3, 0, 1, -1}, {3, 0, 0, 2}};
    FrechetOptions chebyshev;
    chebyshev.ground.metric = Metric::chebyshev;
    return {{"dtw", DtwOptions{}, true},
            {"dtw in a band", band, true},
            {"dtw of squares", squares, true},
            {"open dtw", open, true},
            {"normalized dtw", normalized, true},
            {"dtw on the sphere", on_sphere, true},
            {"dtw with minkowski", minkowski, false},
            {"negative dtw", negative, false},
            {"frechet", FrechetOptions{}, true},
            {"frechet with chebyshev", chebyshev, true},
            {"frechet_continuous", FrechetContinuousOptions{}, true},
            {"hausdorff", HausdorffOptions{}, false}};
}

bool is_on_sphere(const Measure& measure) {
    const auto* const options = std::get_if<DtwOptions>(&measure);
    return options != nullptr && options->ground.metric == Metric::haversine;
}

std::vector<Neighbor> in_order(const double* row, std::ptrdiff_t count, std::ptrdiff_t left_out) {
    std::vector<Neighbor> all;
    for (std::ptrdiff_t j = 0; j < count; ++j) {
        if (j != left_out) all.push_back({j, row[j]});
    }
    std::stable_sort(all.begin(), all.end(), nearest::is_nearer);
    return all;
}

template <class Found, class Expected>
void check_equal(const Found& found, const Expected& expected) {
    CHECK_EQUAL(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size() && k < expected.size(); ++k) {
        CHECK_EQUAL(found[k].index, expected[k].index);
        CHECK(found[k].distance == expected[k].distance ||
              (std::isnan(found[k].distance) && std::isnan(expected[k].distance)));
    }
}

void check_answers(const Index& index, const std::vector<CurveView>& C,
                   const std::vector<CurveView>& X, const Measure& measure) {
    const auto size = static_cast<std::ptrdiff_t>(C.size());
    std::vector<double> table(X.size() * C.size());
    cdist(X, C, measure, table.data());
    for (const std::ptrdiff_t k : {std::ptrdiff_t{1}, std::min<std::ptrdiff_t>(10, size), size}) {
        const auto count = static_cast<std::size_t>(k);
        std::vector<double> distances(X.size() * count);
        std::vector<std::int64_t> indices(X.size() * count);
        SearchRecord record;
        SearchOptions options;
        options.record = &record;
        Control control;
        index.kneighbors(X, k, distances.data(), indices.data(), options, &control);
        CHECK_EQUAL(control.done(), control.total());
        CHECK_EQUAL(record.pairs, static_cast<std::int64_t>(X.size() * C.size()));
        CHECK(record.computed >= static_cast<std::int64_t>(X.size() * count));
        for (std::size_t i = 0; i < X.size(); ++i) {
            std::vector<Neighbor> found, expected = in_order(&table[i * C.size()], size, -1);
            expected.resize(count);
            for (std::size_t n = i * count; n < (i + 1) * count; ++n) {
                found.push_back({indices[n], distances[n]});
            }
            check_equal(found, expected);
        }
    }
    std::vector<double> sorted = table;
    std::sort(sorted.begin(), sorted.end());
    for (const double radius : {sorted[0], sorted[sorted.size() / 50], sorted[sorted.size() / 2]}) {
        if (!(radius >= 0.0)) continue;
        SearchOptions by_index;
        by_index.sort_results = false;
        const auto found = index.radius_neighbors(X, radius, by_index);
        for (std::size_t i = 0; i < X.size(); ++i) {
            std::vector<Neighbor> expected;
            for (std::ptrdiff_t j = 0; j < size; ++j) {
                const double distance = table[i * C.size() + static_cast<std::size_t>(j)];
                if (distance <= radius) expected.push_back({j, distance});
            }
            check_equal(found[i], expected);
        }
    }
}

void answers_are_those_of_all_distances() {
    for (const Case& tested : cases()) {
        const check::Note note(tested.name);
        const bool on_sphere = is_on_sphere(tested.measure);
        for (const std::ptrdiff_t size :
             {fewest - 1, fewest, fewest + 1, 6 * leaf - 1, 6 * leaf, 6 * leaf + 1, 8 * leaf,
              8 * leaf + 1, 64 * leaf, 64 * leaf + 1}) {
            if (size > 1000 && !tested.has_trees) continue;
            const check::Note of_size(std::to_string(size) + " curves");
            Random random(static_cast<std::uint64_t>(size));
            const std::ptrdiff_t dim = on_sphere ? 2 : 1 + size % 3;
            std::vector<Curve> curves = some_curves(random, size + 2, dim);
            if (on_sphere) {
                for (Curve& curve : curves) curve = on_globe(curve.times_power_of_two(-3));
            }
            const std::vector<CurveView> all = views_of(curves);
            const std::vector<CurveView> C(all.begin(), all.end() - 2);
            check_answers(Index(C, tested.measure), C, {all.end() - 2, all.end()}, tested.measure);
        }
    }
}

void answers_are_right_after_every_addition() {
    Random random(21);
    const Measure measures[] = {FrechetOptions{}, DtwOptions{}, FrechetContinuousOptions{}};
    for (const Measure& measure : measures) {
        const std::vector<Curve> curves = some_curves(random, 3000, 2);
        const std::vector<CurveView> all = views_of(curves);
        Index index({all.begin(), all.begin() + 3}, measure);
        std::ptrdiff_t size = 3;
        // With the 3 before: no tree; a tree; another, merged with it; a part of a leaf behind; a
        // tree behind these; one that is merged with all before.
        for (const std::ptrdiff_t more : {250, 2, 1, 0, 255, 1, 31, 257, 700, 40, 1000, 1}) {
            index.add({all.begin() + size, all.begin() + size + more});
            size += more;
            const check::Note note(std::to_string(size) + " curves");
            CHECK_EQUAL(index.size(), static_cast<std::size_t>(size));
            check_answers(index, {all.begin(), all.begin() + size}, {all.end() - 2, all.end()},
                          measure);
        }
    }
}

// The index without the curves that were removed from it, in the same trees.
void removed_curves_are_in_no_answer() {
    Random random(22);
    const std::vector<Curve> curves = some_curves(random, 700, 2);
    const std::vector<CurveView> all = views_of(curves);
    Index index(all, FrechetOptions{});
    std::vector<std::int64_t> removed;
    std::vector<CurveView> remaining;
    std::vector<std::int64_t> indices;
    for (std::size_t j = 0; j < all.size(); ++j) {
        if (j % 3 == 0 || j / 64 == 4) {
            removed.push_back(static_cast<std::int64_t>(j));
        } else {
            remaining.push_back(all[j]);
            indices.push_back(static_cast<std::int64_t>(j));
        }
    }
    index.remove(removed);
    const Index expected(remaining, FrechetOptions{});
    SearchRecord record;
    SearchOptions options;
    options.record = &record;
    const std::ptrdiff_t k = 5;
    const std::vector<Neighbor> found = index.kneighbors(k, options);
    const std::vector<Neighbor> those = expected.kneighbors(k);
    const auto count = static_cast<std::int64_t>(remaining.size());
    CHECK_EQUAL(record.pairs, count * (count - 1));
    CHECK_EQUAL(found.size(), those.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK_EQUAL(found[i].index, indices[static_cast<std::size_t>(those[i].index)]);
        CHECK_EQUAL(found[i].distance, those[i].distance);
    }
}

bool are_equal(const SearchRecord& a, const SearchRecord& b) {
    return a.pairs == b.pairs && a.refined == b.refined && a.computed == b.computed;
}

nearest::Question nearest_of(std::ptrdiff_t count) {
    nearest::Question question;
    question.count = count;
    return question;
}

nearest::Question all_within(double radius) {
    nearest::Question question;
    question.radius = radius;
    return question;
}

// A search raises and computes the same bounds and distances with trees as without.
void trees_change_no_count() {
    Random random(23);
    Poller poller(nullptr);
    for (const Case& tested : cases()) {
        const check::Note note(tested.name);
        const auto measure = std::visit(
            [](const auto& options) { return pairwise::batch_measure(options); }, tested.measure);
        const bool on_sphere = measure->requirements().on_sphere;
        const auto targets = measure->make_targets();
        std::vector<Curve> curves = some_curves(random, 1000, 2);
        for (Curve& curve : curves) {
            if (on_sphere) curve = on_globe(curve.times_power_of_two(-3));
        }
        targets->reserve(views_of(curves), pairwise::PointSource::others);
        for (const Curve& curve : curves) {
            targets->add(CheckedCurve(curve, "curve", poller, on_sphere), poller);
        }
        targets->plant(poller);
        const Seen seen = targets->seen();
        CHECK_EQUAL(seen.forest != nullptr, tested.has_trees);
        Seen without_trees = seen;
        without_trees.forest = nullptr;
        for (std::ptrdiff_t i = 0; i < 40; ++i) {
            const CheckedCurve P(curves[static_cast<std::size_t>(i)], "P", poller, on_sphere);
            NeighborSearch search(*targets, seen, poller), linear(*targets, without_trees, poller);
            const auto query = targets->query(P, poller);
            const auto found = search.answer(*query, 0, nearest_of(1 + i), {i, i});
            const auto again = targets->query(P, poller);
            check_equal(found, linear.answer(*again, 0, nearest_of(1 + i), {i, i}));
            CHECK(are_equal(search.take_record(), linear.take_record()));
            const double radius = found[static_cast<std::size_t>(i / 2)].distance;
            check_equal(search.answer(*query, 0, all_within(radius), {}),
                        linear.answer(*again, 0, all_within(radius), {}));
            CHECK(are_equal(search.take_record(), linear.take_record()));
        }
    }
}

// A search that needs many leaves reads all first bounds instead, once it has read the first ones.
void many_leaves_are_read_in_order() {
    Random random(25);
    Poller poller(nullptr);
    const auto measure = pairwise::batch_measure(FrechetOptions{});
    const auto targets = measure->make_targets();
    std::vector<Curve> curves;
    for (int j = 0; j < 300 * leaf; ++j) {
        curves.push_back(j % 2 == 0 ? random.curve(2, 2) : random.lattice_curve(2, 2));
    }
    targets->reserve(views_of(curves), pairwise::PointSource::others);
    for (const Curve& curve : curves) {
        targets->add(CheckedCurve(curve, "curve", poller, false), poller);
    }
    targets->plant(poller);
    Seen seen = targets->seen();
    std::vector<bool> removed(1000);
    for (std::size_t j = 0; j < removed.size(); j += 3) removed[j] = true;
    seen.removed = std::make_shared<const std::vector<bool>>(removed);
    Seen without_trees = seen;
    without_trees.forest = nullptr;
    NeighborSearch search(*targets, seen, poller), linear(*targets, without_trees, poller);
    const auto query = targets->query(CheckedCurve(curves[4], "P", poller, false), poller);
    for (const std::ptrdiff_t k : {std::ptrdiff_t{1}, 200 * leaf, 290 * leaf}) {
        const auto found = search.answer(*query, 0, nearest_of(k), {4, 4});
        check_equal(found, linear.answer(*query, 0, nearest_of(k), {4, 4}));
        const double radius = found.back().distance;
        check_equal(search.answer(*query, 0, all_within(radius), {4, 4}),
                    linear.answer(*query, 0, all_within(radius), {4, 4}));
        CHECK(are_equal(search.take_record(), linear.take_record()));
    }
}

// Groups far apart: a search looks into few leaves.
class Counted final : public pairwise::TargetQuery {
   public:
    explicit Counted(pairwise::TargetQuery& query) : query_(query) {}
    int levels() const noexcept override { return query_.levels(); }
    void quick(std::ptrdiff_t first, std::ptrdiff_t count, double* bounds) override {
        bounds_ += count;
        query_.quick(first, count, bounds);
    }
    void quick(std::ptrdiff_t first, const pairwise::BoundTree::Leaf& leaf,
               double* bounds) override {
        bounds_ += leaf.count;
        query_.quick(first, leaf, bounds);
    }
    void of_boxes(const double* boxes, std::ptrdiff_t count, double* bounds) override {
        bounds_ += count;
        query_.of_boxes(boxes, count, bounds);
    }
    double refined(std::ptrdiff_t j, int level) override { return query_.refined(j, level); }
    double value(std::ptrdiff_t j, const pairwise::PairCall& call) override {
        return query_.value(j, call);
    }
    bool is_within(std::ptrdiff_t j, const pairwise::PairCall& call) override {
        return query_.is_within(j, call);
    }
    std::int64_t steps(std::ptrdiff_t j) const noexcept override { return query_.steps(j); }
    std::ptrdiff_t bounds() const noexcept { return bounds_; }

   private:
    pairwise::TargetQuery& query_;
    std::ptrdiff_t bounds_ = 0;
};

void most_bounds_are_left_out() {
    Random random(24);
    Poller poller(nullptr);
    const Measure measures[] = {FrechetOptions{}, DtwOptions{}, FrechetContinuousOptions{}};
    for (const Measure& options : measures) {
        const auto measure =
            std::visit([](const auto& given) { return pairwise::batch_measure(given); }, options);
        const auto targets = measure->make_targets();
        std::vector<Curve> curves;
        for (int j = 0; j < 4000; ++j) {
            curves.push_back(random.curve(12, 2));
            const double x = 10.0 * static_cast<double>(random.index(20));
            const double y = 10.0 * static_cast<double>(random.index(20));
            for (std::ptrdiff_t i = 0; i < 12; ++i) {
                curves.back()(i, 0) += x;
                curves.back()(i, 1) += y;
            }
        }
        targets->reserve(views_of(curves), pairwise::PointSource::others);
        for (const Curve& curve : curves) {
            targets->add(CheckedCurve(curve, "curve", poller, false), poller);
        }
        targets->plant(poller);
        const Seen seen = targets->seen();
        NeighborSearch search(*targets, seen, poller);
        const auto query = targets->query(CheckedCurve(curves[0], "P", poller, false), poller);
        Counted nearest(*query), within(*query);
        const double radius = search.answer(nearest, 0, nearest_of(3), {0, 0}).back().distance;
        CHECK(nearest.bounds() < 250);
        CHECK_EQUAL(search.answer(within, 0, all_within(radius), {0, 0}).size(), std::size_t{3});
        CHECK(within.bounds() < 250);
    }
}

}  // namespace

int main() {
    return check::run(
        {{"answers are those of all distances", answers_are_those_of_all_distances},
         {"answers are right after every addition", answers_are_right_after_every_addition},
         {"removed curves are in no answer", removed_curves_are_in_no_answer},
         {"trees change no count", trees_change_no_count},
         {"many leaves are read in order", many_leaves_are_read_in_order},
         {"most bounds are left out", most_bounds_are_left_out}});
}
