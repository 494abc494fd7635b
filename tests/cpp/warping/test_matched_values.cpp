// With a band, the boxes of the points in it; without a band and in one dimension, one interval
// more than the gaps between the values.
#include <algorithm>
#include <vector>

#include "check.hpp"
#include "oracle.hpp"
#include "warping/dispatch.hpp"
#include "warping/kernels/strip.hpp"
#include "warping/matched_values.hpp"

namespace {

using namespace curvewise;
using test::Curve;
using test::Random;
using warping::Band;
using warping::BandedValues;

// Of points that are stored in reverse, as is the other curve.
void has_intervals_of_band(std::ptrdiff_t n, const Curve& Q, std::ptrdiff_t window,
                           const warping::Level& level) {
    const std::ptrdiff_t m = Q.size();
    const Band band(n, m, window);
    BandedValues values;
    CHECK_EQUAL(values.assign(n, m, window), band.is_limited());
    if (!band.is_limited()) return;
    CHECK(values.is_new());
    const std::ptrdiff_t stride = m + 3;
    std::vector<double> reversed(static_cast<std::size_t>(Q.dim() * stride));
    for (std::ptrdiff_t c = 0; c < Q.dim(); ++c) {
        for (std::ptrdiff_t j = 0; j < m; ++j) {
            reversed[static_cast<std::size_t>(c * stride + m - 1 - j)] = Q(j, c);
        }
    }
    values.enclose(reversed.data(), stride, Q.dim(), level.kernels->extremes);
    CHECK(!values.is_new());
    const kernels::PointsAndBoxes intervals = values.each();
    for (std::ptrdiff_t k = 0; k < n * Q.dim(); ++k) {
        const std::ptrdiff_t i = k / Q.dim(), c = k % Q.dim();
        const warping::ColumnRange range = band.columns(i);
        double low = Q(range.first, c), high = low;
        for (std::ptrdiff_t j = range.first; j <= range.last; ++j) {
            low = std::min(low, Q(j, c));
            high = std::max(high, Q(j, c));
        }
        const std::ptrdiff_t place = c * intervals.corner_stride + n - 1 - i;
        // Where the curves have as many points each, no wider ones, either.
        CHECK(n == m ? intervals.low[place] == low : intervals.low[place] <= low);
        CHECK(n == m ? intervals.high[place] == high : intervals.high[place] >= high);
    }
}

void intervals_hold_the_points_of_the_band() {
    Random random(3);
    for (int round = 0; round < 400; ++round) {
        const std::ptrdiff_t n = 2 + random.index(60);
        const std::ptrdiff_t m = round % 2 == 0 ? n : 2 + random.index(60);
        const Curve Q = random.curve(m, 1 + round % 3);
        const std::ptrdiff_t window = 1 + random.index(std::max(n, m));
        for (const warping::Level& level : warping::available_levels()) {
            has_intervals_of_band(n, Q, window, level);
        }
    }
}

void intervals_that_overlap_become_one() {
    const std::vector<double> boxes{0.0, 1.0, 5.0, 6.0, 1.0, 2.0, 5.5, 5.6, 2.5, 3.0, 9.0, 9.0};
    std::vector<double> merged(boxes.size());
    const auto count = [&](double most_gap) {
        return warping::merge_intervals(boxes.data(), 6, most_gap, merged.data());
    };
    CHECK_EQUAL(count(0.0), std::ptrdiff_t{4});  // 0 to 2, 2.5 to 3, 5 to 6, 9
    CHECK_EQUAL(count(0.5), std::ptrdiff_t{3});
    CHECK_EQUAL(count(2.0), std::ptrdiff_t{2});
    CHECK_EQUAL(count(3.0), std::ptrdiff_t{1});
    CHECK_EQUAL(merged[0], 0.0);
    CHECK_EQUAL(merged[1], 9.0);
}

}  // namespace

int main() {
    return check::run(
        {{"intervals hold the points of the band", intervals_hold_the_points_of_the_band},
         {"intervals that overlap become one", intervals_that_overlap_become_one}});
}
