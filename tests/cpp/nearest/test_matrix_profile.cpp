// The matrix profile against the distances of all pairs of windows, bit for bit: also where
// windows are equal or constant, where rounding exceeds differences, and where no pair is compared.
#include <cmath>
#include <cstdint>
#include <limits>
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

constexpr double infinity = std::numeric_limits<double>::infinity();

Curve zeros(std::ptrdiff_t n, std::ptrdiff_t dim) {
    return {std::vector<double>(static_cast<std::size_t>(n * dim)), dim};
}

struct Moments {
    Curve means, deviations;
};

Moments moments_of(const Curve& record, std::ptrdiff_t length) {
    const std::ptrdiff_t count = record.size() - length + 1;
    Moments found{zeros(count, record.dim()), zeros(count, record.dim())};
    const auto n = static_cast<double>(length);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        for (std::ptrdiff_t c = 0; c < record.dim(); ++c) {
            double sum = 0.0, squares = 0.0;
            for (std::ptrdiff_t t = 0; t < length; ++t) sum += record(i + t, c);
            const double mean = found.means(i, c) = sum / n;
            for (std::ptrdiff_t t = 0; t < length; ++t) {
                squares += (record(i + t, c) - mean) * (record(i + t, c) - mean);
            }
            found.deviations(i, c) = std::sqrt(squares / n);
        }
    }
    return found;
}

double squared_distance(const Curve& record, const Moments& moments, std::ptrdiff_t i,
                        std::ptrdiff_t j) {
    const auto normalized = [&](std::ptrdiff_t window, std::ptrdiff_t t, std::ptrdiff_t c) {
        const double deviation = moments.deviations(window, c);
        if (deviation == 0.0) return 0.0;
        return (record(window + t, c) - moments.means(window, c)) / deviation;
    };
    const std::ptrdiff_t length = record.size() - moments.means.size() + 1;
    double total = 0.0;
    for (std::ptrdiff_t t = 0; t < length; ++t) {
        double square = 0.0;
        for (std::ptrdiff_t c = 0; c < record.dim(); ++c) {
            const double difference = normalized(i, t, c) - normalized(j, t, c);
            square += difference * difference;
        }
        total += square;
    }
    return total;
}

// Returns the number of windows that have a neighbor.
int check_all_pairs(const Curve& record, std::ptrdiff_t length, std::ptrdiff_t exclusion) {
    const Moments moments = moments_of(record, length);
    const std::ptrdiff_t count = moments.means.size();
    const MatrixProfile profile =
        matrix_profile(record, moments.means, moments.deviations, exclusion);
    const MatrixProfile threads =
        matrix_profile(record, moments.means, moments.deviations, exclusion, 3);
    CHECK_EQUAL(threads.distances, profile.distances);
    CHECK_EQUAL(threads.indices, profile.indices);
    CHECK_EQUAL(static_cast<std::ptrdiff_t>(profile.indices.size()), count);
    int neighbors = 0;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const check::Note note("window " + std::to_string(i));
        std::int64_t nearest = -1;
        double least = infinity;
        for (std::ptrdiff_t j = 0; j < count; ++j) {
            if (std::abs(i - j) <= exclusion) continue;
            const double square = squared_distance(record, moments, i, j);
            if (square < least) {
                least = square;
                nearest = j;
            }
        }
        const auto at = static_cast<std::size_t>(i);
        CHECK_EQUAL(profile.distances[at], std::sqrt(least));
        CHECK_EQUAL(profile.indices[at], nearest);
        neighbors += nearest >= 0;
    }
    return neighbors;
}

// Windows that are constant, and windows that are equal.
Curve with_steps(Random& random, std::ptrdiff_t n, std::ptrdiff_t dim) {
    Curve record = random.lattice_curve(n, dim);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) record(i, c) = record(i / 5, c);
    }
    return record;
}

// The rounding of products with the spike is larger than all other numbers.
Curve with_spike(Random& random, std::ptrdiff_t n, std::ptrdiff_t dim) {
    Curve record = random.curve(n, dim);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) record(i, c) *= i == n / 3 ? 1e5 : 1e-7;
    }
    return record;
}

Curve on_a_level(Random& random, std::ptrdiff_t n, std::ptrdiff_t dim) {
    Curve record = random.curve(n, dim);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        for (std::ptrdiff_t c = 0; c < dim; ++c) record(i, c) += 1e9;
    }
    return record;
}

void every_window_has_its_nearest() {
    struct Shape {
        std::ptrdiff_t n, dim, length, exclusion;
    };
    Random random(1);
    // The longer records have several blocks of rows, the last of which is cut off.
    for (const Shape& shape : {Shape{30, 1, 4, 2}, Shape{41, 2, 7, 0}, Shape{26, 3, 2, 5},
                               Shape{420, 1, 30, 15}, Shape{300, 2, 9, 4}}) {
        for (const auto& record_of : {+[](Random&drawn, std::ptrdiff_t n, std::ptrdiff_t dim) {
                                          return drawn.curve(n, dim);
                                      },
                                      with_steps, with_spike, on_a_level}) {
            const check::Note note("length " + std::to_string(shape.length));
            const Curve record = record_of(random, shape.n, shape.dim);
            const std::ptrdiff_t count = shape.n - shape.length + 1;
            CHECK_EQUAL(check_all_pairs(record, shape.length, shape.exclusion), count);
        }
    }
}

void windows_that_are_not_compared_have_no_neighbor() {
    Random random(2);
    const Curve record = random.curve(20, 1);  // 16 windows of 5 points
    CHECK_EQUAL(check_all_pairs(record, 5, 9), 12);
    CHECK_EQUAL(check_all_pairs(record, 5, 15), 0);
    CHECK_EQUAL(check_all_pairs(record, 5, 1000), 0);
    CHECK_EQUAL(check_all_pairs(record, 20, 0), 0);  // a single window
}

void a_control_ends_it() {
    Random random(3);
    const Curve record = random.curve(600, 1);
    const Moments moments = moments_of(record, 20);
    for (const std::ptrdiff_t workers : {1, 2}) {
        Control stopping;
        stopping.stop();
        CHECK_THROWS(
            matrix_profile(record, moments.means, moments.deviations, 10, workers, &stopping),
            Stopped, "stopped before the work was done");
        Control counting;
        static_cast<void>(
            matrix_profile(record, moments.means, moments.deviations, 10, workers, &counting));
        CHECK_EQUAL(counting.done(), counting.total());
        CHECK(counting.total() > 0);
    }
}

void refusals_say_what_is_wrong() {
    const Curve record{{1}, {2}, {4}, {3}, {infinity}}, part = record.part(0, 4);
    const Moments moments = moments_of(part, 3);
    const Curve& means = moments.means;
    CHECK_THROWS(matrix_profile(part, means, moments.deviations, -1), std::invalid_argument,
                 "exclusion is -1; give a whole number >= 0");
    CHECK_THROWS(matrix_profile(record, means, moments.deviations, 0), std::invalid_argument,
                 "record[4, 0] is inf; curves must be finite");
    CHECK_THROWS(matrix_profile(part, means, means.part(0, 1), 0), std::invalid_argument,
                 "record, means and deviations have shapes (4, 1), (2, 1) and (1, 1); give a mean "
                 "and a deviation of each window");
    CHECK_THROWS(matrix_profile(part, Curve{{0, 0}, {0, 0}}, moments.deviations, 0),
                 std::invalid_argument,
                 "record, means and deviations have shapes (4, 1), (2, 2) and (2, 1); give a mean "
                 "and a deviation of each window");
    CHECK_THROWS(matrix_profile(means, record, record, 0), std::invalid_argument,
                 "record, means and deviations have shapes (2, 1), (5, 1) and (5, 1); give a mean "
                 "and a deviation of each window");
    CHECK_THROWS(matrix_profile(part, means, moments.deviations, 0, 0), std::invalid_argument,
                 "workers is 0; give a whole number >= 1, or -1 for all cores");
}

}  // namespace

int main() {
    return check::run({{"every window has its nearest", every_window_has_its_nearest},
                       {"windows that are not compared have no neighbor",
                        windows_that_are_not_compared_have_no_neighbor},
                       {"a control ends it", a_control_ends_it},
                       {"refusals say what is wrong", refusals_say_what_is_wrong}});
}
