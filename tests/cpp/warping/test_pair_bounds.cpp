// The bounds of a search, of the discrete measures and of the continuous one. No bound is above the
// computed value, and bounds do not rise beyond it from level to level. A sweep that skips the
// cells that they prune gives the value, or one above the cutoff.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "curvewise/curvewise.hpp"
#include "oracle.hpp"
#include "pairwise/batch.hpp"

namespace {

using namespace curvewise;
using curves::CheckedCurve;
using runtime::Poller;
using test::Curve;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Few points that are all near, many, in order or not, touching, equal, far.
Curve some_curve(Random& random, std::ptrdiff_t dim) {
    const std::ptrdiff_t n = 1 + random.index(random.index(2) == 0 ? 12 : 150);
    Curve curve = random.index(3) == 0 ? random.lattice_curve(n, dim) : random.curve(n, dim);
    for (std::ptrdiff_t i = 1; i < n && random.index(4) != 0; ++i) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) curve(i, c) += curve(i - 1, c);
    }
    const double offset = random.index(2) == 0 ? 0.0 : random.uniform(-30, 30);
    for (std::ptrdiff_t i = 0; i < n; ++i) curve(i, 0) += offset;
    return curve.times_power_of_two(static_cast<int>(random.index(2) * (random.index(9) - 4) * 10));
}

// The same, in degrees.
Curve on_globe(const Curve& curve) {
    Curve points = curve;
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        points(i, 0) = std::remainder(curve(i, 0), 360.0);
        points(i, 1) = std::remainder(curve(i, 1), 90.0);
    }
    return points;
}

// The first bounds of all targets, the same from trees. No bound of a box is above those in it.
std::vector<double> checked_first_bounds(pairwise::TargetQuery& query, const pairwise::Seen& seen) {
    std::vector<double> quick(static_cast<std::size_t>(seen.size));
    query.quick(0, seen.size, quick.data());
    if (seen.forest == nullptr) return quick;
    for (const auto& [first, tree] : seen.forest->trees()) {
        std::ptrdiff_t held = 1;
        for (int level = 0; level < tree->levels(); ++level) {
            for (std::ptrdiff_t b = 0; b < tree->boxes(level); ++b) {
                double of_box = -1.0;
                query.of_boxes(tree->box(level, b), 1, &of_box);
                CHECK(of_box >= 0.0);
                for (std::ptrdiff_t l = b * held; l < (b + 1) * held && l < tree->boxes(0); ++l) {
                    const pairwise::BoundTree::Leaf leaf = tree->leaf(l);
                    double bounds[pairwise::BoundTree::leaf_rows];
                    query.quick(first, leaf, bounds);
                    for (std::ptrdiff_t k = 0; k < leaf.count; ++k) {
                        CHECK_EQUAL(bounds[k],
                                    quick[static_cast<std::size_t>(first + leaf.places[k])]);
                        CHECK(of_box <= bounds[k]);
                    }
                }
            }
            held *= pairwise::BoundTree::fan;
        }
    }
    return quick;
}

template <class Options>
void bounds_hold(const Options& options, const std::vector<Curve>& curves) {
    const auto measure = pairwise::batch_measure(options);
    const bool on_sphere = measure->requirements().on_sphere;
    const auto targets = measure->make_targets();
    Poller poller(nullptr);
    // Each several times, so that there is a tree.
    std::vector<CurveView> all;
    while (all.size() < static_cast<std::size_t>(pairwise::BoundForest::fewest_rows + 40)) {
        for (const Curve& Q : curves) all.emplace_back(Q);
    }
    targets->reserve(all, pairwise::PointSource::others);
    for (const CurveView& Q : all) targets->add(CheckedCurve(Q, "Q", poller, on_sphere), poller);
    targets->plant(poller);
    const auto memory = targets->make_memory();
    for (const Curve& P : curves) {
        const auto query = targets->query(CheckedCurve(P, "P", poller, on_sphere), poller);
        const std::vector<double> quick = checked_first_bounds(*query, targets->seen());
        for (std::size_t j = 0; j < curves.size(); ++j) {
            const check::Note note(test::described(P, curves[j]));
            const auto target = static_cast<std::ptrdiff_t>(j);
            const double value = evaluate(options, P, curves[j]);
            CHECK(quick[j] >= 0.0 && quick[j] <= value);
            for (int level = 1; level < query->levels(); ++level) {
                const double bound = query->refined(target, level);
                CHECK(bound >= 0.0 && bound <= value);
            }
            for (const double cutoff : {value, infinity, 2.0 * value, value / 2, 0.0}) {
                const double found = query->value(target, {cutoff, 1, poller, *memory});
                CHECK_EQUAL(query->is_within(target, {cutoff, 1, poller, *memory}),
                            value <= cutoff);
                if (value <= cutoff) {
                    CHECK_EQUAL(found, value);
                } else {
                    CHECK(found > cutoff);
                }
            }
        }
    }
}

template <class Options>
void bounds_hold(const Options& options, std::ptrdiff_t dim, Random& random) {
    const bool on_sphere = pairwise::batch_measure(options)->requirements().on_sphere;
    std::vector<Curve> curves;
    for (int i = 0; i < 7; ++i) {
        const Curve curve = some_curve(random, dim);
        curves.push_back(on_sphere ? on_globe(curve) : curve);
    }
    bounds_hold(options, curves);
}

// The same number of points each, moved a little: paths are similar, and the band is equally wide
// in all rows.
void bounds_of_lines_hold() {
    Random random(13);
    for (const std::ptrdiff_t n : {9, 16, 47, 120}) {
        // Squares of the last scale lose digits, next to an end that does not change the scale.
        for (const int scale : {0, -530}) {
            const Curve zeros(std::vector<double>(static_cast<std::size_t>(n)), 1);
            std::vector<Curve> curves(4, zeros);
            for (std::ptrdiff_t i = 1; i < n; ++i) {
                const double step = random.uniform(-1, 1);
                for (Curve& curve : curves) {
                    curve(i, 0) = curve(i - 1, 0) + step + random.uniform(-0.2, 0.2);
                }
            }
            for (Curve& curve : curves) {
                curve = curve.times_power_of_two(scale);
                curve(n - 1, 0) = 1.0;
            }
            for (const std::ptrdiff_t window : {0, 1, 2, 5, 12, 40, 119, 200}) {
                for (const Metric metric : {Metric::euclidean, Metric::sqeuclidean}) {
                    for (const auto pattern : {StepPattern::symmetric1, StepPattern::symmetric2}) {
                        const check::Note note("window " + std::to_string(window));
                        DtwOptions options;
                        options.ground.metric = metric;
                        options.step_pattern = pattern;
                        options.window = window;
                        bounds_hold(options, curves);
                    }
                }
            }
        }
    }
}

void bounds_of_leashes_hold() {
    Random random(12);
    for (const std::ptrdiff_t dim : {1, 2, 3, 5}) {
        bounds_hold(FrechetContinuousOptions{}, dim, random);
    }
}

// Curves beyond the usual range of squares, next to others in the same boxes, and of zeros.
void bounds_hold_beyond_the_usual_range() {
    Random random(14);
    for (const std::ptrdiff_t dim : {1, 2}) {
        for (int i = 0; i < 10; ++i) {
            std::vector<Curve> curves;
            for (const int power : {0, 0, 0, 600, -600, -1200}) {
                curves.push_back(some_curve(random, dim).times_power_of_two(power));
            }
            bounds_hold(DtwOptions{}, curves);
            bounds_hold(FrechetOptions{}, curves);
            bounds_hold(FrechetContinuousOptions{}, curves);
            curves.erase(curves.begin() + 3);
            bounds_hold(DtwOptions{}, curves);
            curves.erase(curves.begin(), curves.begin() + 3);
            bounds_hold(FrechetOptions{}, curves);
        }
    }
}

void bounds_of_every_metric_hold() {
    Random random(11);
    std::vector<Metric> metrics(oracle::metrics.begin(), oracle::metrics.end());
    metrics.push_back(Metric::haversine);
    for (const Metric metric : metrics) {
        for (const std::ptrdiff_t dim : {1, 2, 3, 5}) {
            if (metric == Metric::haversine && dim != 2) continue;
            const check::Note note(oracle::name(metric));
            FrechetOptions frechet_options;
            frechet_options.ground = {metric, 3.0};
            bounds_hold(frechet_options, dim, random);
            DtwOptions options;
            options.ground = {metric, 3.0};
            bounds_hold(options, dim, random);
            options.open_begin = true;
            bounds_hold(options, dim, random);
            options.open_end = true;
            bounds_hold(options, dim, random);
            options.open_begin = false;
            bounds_hold(options, dim, random);
            options.open_end = false;
            options.step_pattern = StepPattern::symmetric2;
            bounds_hold(options, dim, random);
            options.normalize = true;
            bounds_hold(options, dim, random);
            options.window_fraction = 0.5;  // of few points a window that admits paths, too
            bounds_hold(options, dim, random);
            options.normalize = false;
            options.window_fraction.reset();
            for (const std::ptrdiff_t window : {1, 7, 40}) {
                options.window = window;
                bounds_hold(options, dim, random);
                options.step_pattern = StepPattern::symmetric1;
                bounds_hold(options, dim, random);
            }
        }
    }
}

}  // namespace

int main() {
    return check::run({{"bounds of leashes hold", bounds_of_leashes_hold},
                       {"bounds of lines hold", bounds_of_lines_hold},
                       {"bounds hold beyond the usual range", bounds_hold_beyond_the_usual_range},
                       {"bounds of every metric hold", bounds_of_every_metric_hold}});
}
