// The intervals of one-dimensional curves: with a band those of the points in it, as the band says
// them; without one as many as there are gaps.
#include <algorithm>
#include <vector>

#include "check.hpp"
#include "oracle.hpp"
#include "warping/matched_values.hpp"

namespace {

using namespace curvewise;
using curves::RangeScale;
using runtime::Poller;
using test::Curve;
using test::Random;
using warping::Band;
using warping::BandedValues;
using warping::PackedCurve;
using warping::PointOrder;

PackedCurve packed(const Curve& curve, PointOrder order) {
    Poller poller(nullptr);
    return PackedCurve(curve, RangeScale(1.0), order, poller);
}

// `order` is that of the points that have intervals.
void has_intervals_of_band(const Curve& P, const Curve& Q, std::ptrdiff_t window,
                           PointOrder order) {
    const bool is_forward = order == PointOrder::forward;
    const std::ptrdiff_t n = P.size(), m = Q.size();
    const Band band(n, m, window);
    BandedValues values;
    CHECK_EQUAL(values.assign(n, order, m, window), band.is_limited());
    if (!band.is_limited()) return;
    CHECK(values.is_new());
    values.enclose(packed(Q, is_forward ? PointOrder::reversed : PointOrder::forward));
    CHECK(!values.is_new());
    const kernels::PointsAndBoxes intervals = values.each();
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const warping::ColumnRange range = band.columns(i);
        double low = Q(range.first, 0), high = low;
        for (std::ptrdiff_t j = range.first; j <= range.last; ++j) {
            low = std::min(low, Q(j, 0));
            high = std::max(high, Q(j, 0));
        }
        const std::ptrdiff_t place = is_forward ? i : n - 1 - i;
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
        const Curve P = random.curve(n, 1), Q = random.curve(m, 1);
        for (const PointOrder order : {PointOrder::forward, PointOrder::reversed}) {
            has_intervals_of_band(P, Q, 1 + random.index(std::max(n, m)), order);
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
