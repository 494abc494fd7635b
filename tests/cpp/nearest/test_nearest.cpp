// The index against all distances and a stable sort, for every measure. Runs of a long curve and
// the mean under dtw against their definitions. Control ends a search.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "check.hpp"
#include "curves.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;

std::vector<Curve> random_curves(Random& random, std::size_t count, std::ptrdiff_t longest) {
    std::vector<Curve> curves;
    while (curves.size() < count) {
        Curve curve = random.walk(2 + random.index(longest));
        curve(0, 0) -= 1.0;  // a walk of two points may have zero length
        // Now and then one of the same distances as another.
        curves.push_back(curves.size() % 5 == 4 ? curves[curves.size() - 3] : curve);
    }
    return curves;
}

std::vector<Measure> measures() {
    DtwOptions symmetric2, window, open, squares, negative;
    symmetric2.step_pattern = StepPattern::symmetric2;
    window.window = 5;
    open.open_begin = open.open_end = true;
    squares.ground.metric = Metric::sqeuclidean;
    // Its distances are below 0, so 0 is not a lower bound of them.
    negative.own_steps.rows = {{1, 1, 1, -1}, {1, 0, 0, -1}, {2, 1, 0, -1},
                               {2, 0, 0, 2},  {3, 0, 1, -1}, {3, 0, 0, 2}};
    FrechetOptions chebyshev;
    chebyshev.ground.metric = Metric::chebyshev;
    std::vector<Measure> all{symmetric2, window, open, squares, negative, chebyshev};
    for_each_measure([&](const auto& defaults) { all.push_back(defaults); });
    for (Measure& measure : all) {
        if (auto* options = std::get_if<CurveLengthOptions>(&measure)) {
            options->scale = LengthScale::range;
        }
    }
    return all;
}

// By distance, then index.
std::vector<Neighbor> sorted_row(const double* row, std::size_t count) {
    std::vector<Neighbor> all;
    for (std::size_t j = 0; j < count; ++j) all.push_back({static_cast<std::int64_t>(j), row[j]});
    std::stable_sort(all.begin(), all.end(),
                     [](const Neighbor& a, const Neighbor& b) { return a.distance < b.distance; });
    return all;
}

void neighbors_are_those_of_a_sorted_table() {
    Random random(1);
    for (const Measure& measure : measures()) {
        const check::Note note("measure " + std::to_string(measure.index()));
        for (const std::ptrdiff_t longest : {8, 70}) {
            const std::vector<Curve> curves = random_curves(random, 30, longest);
            const std::vector<Curve> queries = random_curves(random, 4, longest);
            const std::vector<CurveView> C = views_of(curves), X = views_of(queries);
            std::vector<double> table(X.size() * C.size());
            cdist(X, C, measure, table.data());
            Index index(std::vector<CurveView>(C.begin(), C.begin() + 7), measure);
            index.add(std::vector<CurveView>(C.begin() + 7, C.end()));
            CHECK_EQUAL(index.size(), C.size());
            for (const std::size_t k : {std::size_t{1}, std::size_t{5}, C.size()}) {
                for (const std::ptrdiff_t workers : {1, 3}) {
                    std::vector<double> distances(X.size() * k);
                    std::vector<std::int64_t> indices(X.size() * k);
                    index.kneighbors(X, static_cast<std::ptrdiff_t>(k), distances.data(),
                                     indices.data(), {workers});
                    for (std::size_t i = 0; i < X.size(); ++i) {
                        const auto row = sorted_row(table.data() + i * C.size(), C.size());
                        for (std::size_t j = 0; j < k; ++j) {
                            CHECK_EQUAL(indices[i * k + j], row[j].index);
                            CHECK_EQUAL(distances[i * k + j], row[j].distance);
                        }
                    }
                }
            }
            const double radius = table[3];
            const auto within = index.radius_neighbors(X, radius);
            for (std::size_t i = 0; i < X.size(); ++i) {
                auto row = sorted_row(table.data() + i * C.size(), C.size());
                row.erase(std::remove_if(row.begin(), row.end(),
                                         [&](const Neighbor& n) { return n.distance > radius; }),
                          row.end());
                CHECK_EQUAL(within[i].size(), row.size());
                for (std::size_t j = 0; j < row.size() && j < within[i].size(); ++j) {
                    CHECK_EQUAL(within[i][j].index, row[j].index);
                    CHECK_EQUAL(within[i][j].distance, row[j].distance);
                }
            }
        }
    }
}

void bounds_leave_most_pairs_out() {
    // Groups that lie far apart: of 99 others, 9 are in the same.
    Random random(2);
    std::vector<Curve> curves;
    for (int i = 0; i < 100; ++i) {
        Curve curve = random.curve(100, 2);
        for (std::ptrdiff_t k = 0; k < 100; ++k) curve(k, 0) += 50.0 * (i % 10);
        curves.push_back(curve);
    }
    for (const Measure& measure : {Measure(DtwOptions{}), Measure(FrechetOptions{})}) {
        const Index index(views_of(curves), measure);
        SearchRecord record;
        SearchOptions options;
        options.record = &record;
        std::vector<double> distances(100);
        std::vector<std::int64_t> indices(100);
        index.kneighbors(1, distances.data(), indices.data(), options);
        CHECK_EQUAL(record.pairs, 100 * 99);
        CHECK(record.computed <= 100 * 9);
        for (std::size_t i = 0; i < 100; ++i) {
            CHECK_EQUAL(indices[i] % 10, static_cast<std::int64_t>(i % 10));
        }
    }
}

// Curves of a walk, which are near to those next to them: without these, others are the nearest.
void curves_next_to_one_are_left_out() {
    Random random(3);
    std::vector<Curve> curves;
    for (int i = 0; i < 300; ++i) {  // enough for trees
        Curve curve = random.curve(4, 2);
        for (std::ptrdiff_t k = 0; k < 4; ++k) curve(k, 0) += 0.1 * i;
        curves.push_back(curve);
    }
    const std::vector<CurveView> C = views_of(curves);
    std::vector<double> table(C.size() * C.size());
    cdist(C, C, DtwOptions{}, table.data());
    const Index index(C, DtwOptions{});
    for (const std::ptrdiff_t exclusion : {0, 5, 149, 150, 298, 300}) {
        SearchRecord counts;
        SearchOptions options;
        options.workers = 2;
        options.record = &counts;
        options.exclusion = exclusion;
        const std::vector<Neighbor> found = index.kneighbors(2, options);
        const auto within = index.radius_neighbors(table[200], options);
        std::int64_t pairs = 0;
        for (std::ptrdiff_t i = 0; i < 300; ++i) {
            std::vector<Neighbor> row = sorted_row(table.data() + i * 300, 300);
            row.erase(std::remove_if(row.begin(), row.end(),
                                     [&](const Neighbor& other) {
                                         return std::abs(other.index - i) <= exclusion;
                                     }),
                      row.end());
            pairs += static_cast<std::int64_t>(row.size());
            row.resize(std::max<std::size_t>(row.size(), 2),
                       {-1, std::numeric_limits<double>::infinity()});
            for (std::ptrdiff_t j = 0; j < 2; ++j) {
                CHECK_EQUAL(found[static_cast<std::size_t>(2 * i + j)].index,
                            row[static_cast<std::size_t>(j)].index);
                CHECK_EQUAL(found[static_cast<std::size_t>(2 * i + j)].distance,
                            row[static_cast<std::size_t>(j)].distance);
            }
            const auto is_within = [&](const Neighbor& other) {
                return other.distance <= table[200];
            };
            CHECK_EQUAL(static_cast<std::ptrdiff_t>(within[static_cast<std::size_t>(i)].size()),
                        std::count_if(row.begin(), row.end(), is_within));
        }
        CHECK_EQUAL(counts.pairs, 2 * pairs);  // of both searches
    }
    SearchOptions options;
    options.exclusion = -1;
    CHECK_THROWS(index.kneighbors(1, options), std::invalid_argument,
                 "exclusion is -1; give a whole number >= 0");
}

// The second curve has the smaller bound and is computed first. The bound of the first one equals
// the distance that was found. The first one is as near and comes before it.
void a_bound_that_is_the_distance_is_looked_at() {
    const Curve query{{0, 0}}, first{{5, 0}}, second{{0, 0}, {3, 4}, {0, 0}};
    const Index index({first, second}, FrechetOptions{});
    double distance = 0.0;
    std::int64_t place = -1;
    index.kneighbors({query}, 1, &distance, &place);
    CHECK_EQUAL(distance, 5.0);
    CHECK_EQUAL(place, 0);
}

void a_control_ends_a_search() {
    Random random(3);
    const std::vector<Curve> curves = random_curves(random, 40, 300);
    const Index index(views_of(curves), DtwOptions{});
    std::vector<double> distances(curves.size() * 30);
    std::vector<std::int64_t> indices(curves.size() * 30);
    for (const std::ptrdiff_t workers : {1, 2}) {
        Control control;
        control.stop();
        CHECK_THROWS(index.kneighbors(30, distances.data(), indices.data(), {workers}, &control),
                     Stopped, "stopped before the work was done");
        Control counted;
        index.kneighbors(30, distances.data(), indices.data(), {workers}, &counted);
        CHECK_EQUAL(counted.done(), counted.total());
    }
}

void refusals_name_the_curve() {
    const Curve line{{0, 0}, {1, 1}}, solid{{0, 0, 0}};
    const double infinity = std::numeric_limits<double>::infinity();
    const Curve broken{{0, 0}, {1, infinity}};
    Index index({line}, FrechetOptions{});
    CHECK_THROWS(index.add({line, broken}), std::invalid_argument,
                 "curves[1][1, 1] is inf; curves must be finite");
    CHECK_EQUAL(index.size(), std::size_t{1});
    CHECK_THROWS(index.radius_neighbors({solid}, 1.0), std::invalid_argument,
                 "curve 0 of the index has shape (2, 2) and X[0] has shape (1, 3); both need the "
                 "same number of coordinates");
    double distance = 0.0;
    std::int64_t place = 0;
    CHECK_THROWS(index.kneighbors({line}, 2, &distance, &place), std::invalid_argument,
                 "n_neighbors is 2; give a whole number from 1 to 1, the curves of the index");
}

// Without distances, for measures without a faster decision; for all curves of the index, moved.
void radius_neighbors_of_the_index() {
    Random random(7);
    const std::vector<Curve> owned = random_curves(random, 8, 30);
    const std::vector<CurveView> C = views_of(owned);
    SearchOptions alone;
    alone.sort_results = alone.with_distances = false;
    for (const Measure& measure : measures()) {
        Index first(C, measure);
        Index index = std::move(first);
        std::vector<double> all(C.size() * C.size());
        cdist(C, C, measure, all.data());
        std::vector<double> sorted = all;
        std::sort(sorted.begin(), sorted.end());
        const double radius = sorted[sorted.size() / 2];
        const auto found = index.radius_neighbors(radius, alone);
        for (std::size_t i = 0; i < C.size(); ++i) {
            std::vector<std::int64_t> expected, indices;
            for (std::size_t j = 0; j < C.size(); ++j) {
                if (j != i && all[i * C.size() + j] <= radius) {
                    expected.push_back(static_cast<std::int64_t>(j));
                }
            }
            for (const Neighbor& neighbor : found[i]) indices.push_back(neighbor.index);
            CHECK_EQUAL(indices, expected);
        }
        first = std::move(index);
        CHECK_EQUAL(first.curves().size(), C.size());
        CHECK_EQUAL(first.curves()[3].size(), C[3].size());
        CHECK_EQUAL(first.curves()[3](1, 1), C[3](1, 1));
    }
    const Curve P{{0, 0}};
    CHECK_THROWS(Index({P}, LcssOptions{}).radius_neighbors(-1.0), std::invalid_argument,
                 "radius is -1.000000; give a number >= 0");
}

void runs_are_those_of_open_ends() {
    Random random(4);
    DtwOptions open;
    open.open_begin = open.open_end = true;
    for (int i = 0; i < 200; ++i) {
        const std::ptrdiff_t dim = 1 + random.index(3);
        const Curve P = random.lattice_curve(1 + random.index(8), dim);
        const Curve Q = random.lattice_curve(1 + random.index(i % 8 == 0 ? 400 : 40), dim);
        const check::Note note(test::described(P, Q));
        const std::vector<Subsequence> found = subsequences(P, Q, 6);
        CHECK_EQUAL(found[0].distance, dtw(P, Q, open));
        std::vector<int> used(static_cast<std::size_t>(Q.size()));
        for (std::size_t k = 0; k < found.size(); ++k) {
            CHECK(k == 0 || found[k - 1].distance <= found[k].distance);
            CHECK_EQUAL(dtw(P, Q.part(found[k].start, found[k].stop + 1)), found[k].distance);
            for (std::ptrdiff_t j = found[k].start; j <= found[k].stop; ++j) {
                CHECK_EQUAL(used[static_cast<std::size_t>(j)]++, 0);
            }
        }
        FrechetOptions frechet_options;
        for (const Subsequence& one : subsequences(P, Q, 3, frechet_options)) {
            CHECK_EQUAL(frechet(P, Q.part(one.start, one.stop + 1)), one.distance);
        }
    }
    DtwOptions window;
    window.window = 3;
    const Curve P{{0}, {1}};
    CHECK_THROWS(subsequences(P, P, 1, window), std::invalid_argument,
                 "open_begin and open_end cannot be combined with window");
    CHECK_THROWS(subsequences(P, P, 0), std::invalid_argument, "k is 0; give a whole number >= 1");
}

// Also where their squares are not equal: 1 + 2^-52, and 1.
void of_equal_distances_the_first_run_comes_first() {
    const Curve P{{0.0, 0.0}}, Q{{3.0, 4.0}, {1.0, 0x1p-26}, {1.0, 0.0}};
    const std::vector<Subsequence> found = subsequences(P, Q, 3, FrechetOptions{});
    CHECK_EQUAL(found.size(), std::size_t{3});
    for (std::size_t k = 0; k < found.size(); ++k) {
        CHECK_EQUAL(found[k].stop, std::ptrdiff_t{k == 2 ? 0 : k == 1 ? 2 : 1});
        CHECK_EQUAL(found[k].distance, k == 2 ? 5.0 : 1.0);
    }
}

// Every run by its definition, with more runs than are processed together.
void runs_outside_are_what_each_run_lies_outside() {
    const std::ptrdiff_t n = 7;
    for (const std::ptrdiff_t dim : {1, 2, 3, 4}) {
        Random random(static_cast<unsigned>(dim));
        const std::ptrdiff_t m = 90;
        std::vector<double> Q, low, high;
        for (std::ptrdiff_t i = 0; i < m * dim; ++i) Q.push_back(1e3 + random.uniform(-3.0, 3.0));
        for (std::ptrdiff_t i = 0; i < n * dim; ++i) {
            low.push_back(random.uniform(-1.0, 0.5));
            high.push_back(low.back() + random.uniform(0.0, 0.7));
        }
        for (const Metric metric :
             {Metric::euclidean, Metric::sqeuclidean, Metric::cityblock, Metric::chebyshev}) {
            const auto outside = [&](bool of_largest) {
                return runs_outside({low.data(), n, dim}, {high.data(), n, dim}, {Q.data(), m, dim},
                                    metric, of_largest);
            };
            const RunsOutside sums = outside(false), largest = outside(true);
            const std::size_t count = static_cast<std::size_t>(m - n + 1);
            CHECK_EQUAL(sums.totals.size(), count);
            CHECK_EQUAL(sums.scales.size(), count * static_cast<std::size_t>(dim));
            for (std::size_t k = 0; k < count; ++k) {
                const auto at = [&](std::ptrdiff_t i, std::ptrdiff_t c) {
                    return static_cast<std::size_t>(i * dim + c);
                };
                std::vector<double> beyond(low.size());
                for (std::ptrdiff_t c = 0; c < dim; ++c) {
                    const double* const x = Q.data() + at(static_cast<std::ptrdiff_t>(k), c);
                    double mean = 0.0, square = 0.0;
                    for (std::ptrdiff_t i = 0; i < n; ++i) mean += x[i * dim] / n;
                    for (std::ptrdiff_t i = 0; i < n; ++i) {
                        square += (x[i * dim] - mean) * (x[i * dim] - mean) / n;
                    }
                    CHECK_CLOSE(sums.scales[static_cast<std::size_t>(c) * count + k],
                                1.0 / std::sqrt(square), 1e-10);
                    for (std::ptrdiff_t i = 0; i < n; ++i) {
                        const double z = (x[i * dim] - mean) / std::sqrt(square);
                        beyond[at(i, c)] = z - std::min(std::max(z, low[at(i, c)]), high[at(i, c)]);
                    }
                }
                double sum = 0.0, most = 0.0;
                const std::vector<double> origin(static_cast<std::size_t>(dim));
                for (std::ptrdiff_t i = 0; i < n; ++i) {
                    DtwOptions options;
                    options.ground.metric = metric;
                    const double distance =
                        dtw({beyond.data() + at(i, 0), 1, dim}, {origin.data(), 1, dim}, options);
                    sum += distance;
                    most = std::max(most, distance);
                }
                CHECK_CLOSE(sums.totals[k], sum, 1e-9);
                CHECK_CLOSE(largest.totals[k], most, 1e-9);
            }
        }
    }
    const double x[] = {0.0, 1.0, 2.0};
    CHECK_EQUAL(runs_outside({x, 3, 1}, {x, 3, 1}, {x, 2, 1}, Metric::minkowski, false).totals,
                std::vector<double>{});
    CHECK_THROWS(runs_outside({x, 1, 1}, {x, 2, 1}, {x, 3, 1}, Metric::euclidean, false),
                 std::invalid_argument,
                 "low, high and Q have shapes (1, 1), (2, 1) and (3, 1); give the corners of one "
                 "box or more, in Q's dimensions");
    CHECK_THROWS(runs_outside({x, 1, 1}, {x, 1, 1}, {x, 3, 1}, Metric::haversine, false),
                 std::invalid_argument,
                 "there are no bounds of this metric; give euclidean, sqeuclidean, cityblock or "
                 "chebyshev");
}

void the_mean_of_points_is_theirs() {
    const Curve zero{{0.0}}, four{{4.0}}, start{{1.0}};
    const DtwMean mean = dtw_mean({zero, four}, {1.0, 3.0}, start);
    CHECK_EQUAL(mean.points, std::vector<double>{3.0});
    CHECK_EQUAL(mean.costs.back(), 1.0 * 9.0 + 3.0 * 1.0);
}

void the_mean_lowers_the_sum() {
    Random random(5);
    const std::vector<Curve> curves = random_curves(random, 9, 40);
    const std::vector<CurveView> C = views_of(curves);
    const std::vector<double> weights{1, 2, 0, 1, 1, 3, 1, 1, 1};
    DtwMeanOptions options;
    const DtwMean mean = dtw_mean(C, weights, C[1], options);
    CHECK(std::is_sorted(mean.costs.rbegin(), mean.costs.rend()));
    CHECK(mean.costs.back() < mean.costs.front());
    DtwOptions squares;
    squares.ground.metric = Metric::sqeuclidean;
    const CurveView points(mean.points.data(), curves[1].size(), 2);
    double cost = 0.0;
    for (std::size_t i = 0; i < C.size(); ++i) cost += weights[i] * dtw(points, C[i], squares);
    CHECK_CLOSE(mean.costs.back(), cost, 1e-12);
    options.workers = 3;
    CHECK_EQUAL(dtw_mean(C, weights, C[1], options).points, mean.points);
    Control control;
    control.stop();
    CHECK_THROWS(dtw_mean(C, weights, C[1], options, &control), Stopped,
                 "stopped before the work was done");
    CHECK_THROWS(dtw_mean(C, {1, 2}, C[1], {}), std::invalid_argument,
                 "weights has 2 entries for 9 curves; give one for each");
    CHECK_THROWS(dtw_mean(C, {1, 2, 0, 1, -1, 3, 1, 1, 1}, C[1], {}), std::invalid_argument,
                 "weights[4] is -1.000000; give a finite number >= 0");
    CHECK_THROWS(dtw_mean(C, std::vector<double>(9, 0.0), C[1], {}), std::invalid_argument,
                 "all weights are 0; give one that is not");
    options.tolerance = -0.5;
    CHECK_THROWS(dtw_mean(C, weights, C[1], options), std::invalid_argument,
                 "tolerance is -0.500000; give a number >= 0");
}

}  // namespace

int main() {
    return check::run(
        {{"neighbors are those of a sorted table", neighbors_are_those_of_a_sorted_table},
         {"bounds leave most pairs out", bounds_leave_most_pairs_out},
         {"curves next to one are left out", curves_next_to_one_are_left_out},
         {"a bound that is the distance is looked at", a_bound_that_is_the_distance_is_looked_at},
         {"a control ends a search", a_control_ends_a_search},
         {"refusals name the curve", refusals_name_the_curve},
         {"radius neighbors of the index", radius_neighbors_of_the_index},
         {"runs are those of open ends", runs_are_those_of_open_ends},
         {"of equal distances the first run comes first",
          of_equal_distances_the_first_run_comes_first},
         {"runs outside are what each run lies outside",
          runs_outside_are_what_each_run_lies_outside},
         {"the mean of points is theirs", the_mean_of_points_is_theirs},
         {"the mean lowers the sum", the_mean_lowers_the_sum}});
}
