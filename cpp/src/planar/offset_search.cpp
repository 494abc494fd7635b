// The continuous search is a branch and bound over offsets. f is S-Lipschitz, which discards an
// interval far from the best value in O(n + m). Near it that bound is too weak (of first order in
// the interval's width h), so a second one is used. As long as s_i + o stays on one segment, d_i is
// convex, so it lies above its tangent at the interval's centre. Corners inside the interval reduce
// this bound; the reduction is added up exactly, corner by corner. The loss is of second order in
// h, so that a few intervals per halving survive.
//
// Typically 10^3 evaluations are needed; pcm.hpp gives the maximum. Each takes O(n + m) time: if
// more corners are inside, the second bound gives up, and the interval is halved.
#include "planar/offset_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "curvewise/pcm.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::planar {
namespace {

using curves::ArcPosition;
using curves::Point;

// Relative to S; or to the value, if that is so far above S that the last bits of its sum are
// larger.
constexpr double finest_tolerance = 1e-12;
constexpr double of_the_value = 0.1;

// The maximum number of corners for one lower bound, relative to the corners of both curves.
constexpr std::size_t most_corners = 16;

double dot(const Point& a, const Point& b) noexcept { return a.x * b.x + a.y * b.y; }

// f and its lower bound over an interval.
class AreaAtOffset {
   public:
    AreaAtOffset(const ArcCurve& shorter, const ArcCurve& longer, Poller& poller)
        : shorter_(shorter),
          longer_(longer),
          poller_(poller),
          weights_(shorter.points().size(), 0.0) {
        const runtime::ScratchVector<double>& s = shorter.arc_lengths();
        for (std::size_t i = 0; i + 1 < s.size(); ++i) {
            poller_.poll_in_loop(i);
            const double half = 0.5 * (s[i + 1] - s[i]);
            weights_[i] += half;
            weights_[i + 1] += half;
        }
        const runtime::ScratchVector<double>& t = longer.arc_lengths();
        segments_.reserve(t.size() + 1);
        for (std::size_t k = 0; k + 1 < t.size(); ++k) {
            poller_.poll_in_loop(k);
            const double length = t[k + 1] - t[k];
            const Point edge = longer.points()[k + 1] - longer.points()[k];
            const Point direction =
                length > 0.0 ? Point{edge.x / length, edge.y / length} : Point{};
            segments_.push_back({t[k], longer.points()[k], direction});
        }
        // The end itself, which a long last segment would miss by its rounding; and the end of
        // every walk.
        segments_.push_back({longer.length(), longer.points().back(), {}});
        segments_.push_back({std::numeric_limits<double>::infinity(), {}, {}});
        fill_signposts();
    }

    double value(double offset) const { return values<1>({offset})[0]; }

    // At several offsets in one walk: their steps do not wait for each other.
    template <std::size_t count>
    std::array<double, count> values(const std::array<double, count>& offsets) const {
        std::array<double, count> sums{}, x{}, y{};
        std::array<const Segment*, count> at{};
        at.fill(segments_.data());
        for (std::size_t i = 0; i < weights_.size(); ++i) {
            poller_.poll_in_loop(i);
            const Point vertex = shorter_.points()[i];
            const double s = shorter_.arc_lengths()[i];
            for (std::size_t o = 0; o < count; ++o) {
                const double u = std::min(s + offsets[o], longer_.length());
                at[o] = std::max(at[o], signpost(u));
                // One step without a branch, which would be mispredicted often.
                at[o] += at[o][1].start <= u;
                while (at[o][1].start <= u) ++at[o];
                const double along = u - at[o]->start;
                x[o] = at[o]->from.x + along * at[o]->direction.x;
                y[o] = at[o]->from.y + along * at[o]->direction.y;
            }
            for (std::size_t o = 0; o < count; ++o) {
                const Point gap{x[o] - vertex.x, y[o] - vertex.y};
                sums[o] += weights_[i] * std::sqrt(dot(gap, gap));
            }
        }
        for (std::size_t o = 0; o < count; ++o) {
            // Squares have overflown, or vanished.
            const bool in_range = sums[o] > 0x1p-400 && std::isfinite(sums[o]);
            if (!in_range) sums[o] = careful_value(offsets[o]);
        }
        return sums;
    }

    // A lower bound of f over centre - half .. centre + half.
    double lower_bound(double centre, double half) {
        ArcPosition position = start(centre);
        double value = 0.0;
        double slope = 0.0;
        double deficit = 0.0;
        corners_ = 0;
        const std::size_t most = most_corners * (weights_.size() + segments_.size());
        for (std::size_t i = 0; i < weights_.size(); ++i) {
            if (corners_ > most) return -std::numeric_limits<double>::infinity();
            poller_.poll_in_loop(i);
            const double u = shorter_.arc_lengths()[i] + centre;
            position.move_to(u);
            const Tangent tangent = tangent_at(i, u, position);
            value += weights_[i] * tangent.value;
            slope += weights_[i] * tangent.slope;
            deficit += weights_[i] * std::max(deficit_after(i, tangent, position, u + half),
                                              deficit_before(i, tangent, position, u - half));
        }
        return value - std::abs(slope) * half - deficit;
    }

   private:
    // A segment of the longer curve: points at start + along are from + along * direction.
    struct Segment {
        double start;
        Point from;
        Point direction;
    };

    struct Tangent {
        double at;
        double value;
        double slope;
        double operator()(double u) const noexcept { return value + slope * (u - at); }
    };

    // Of any magnitude.
    double careful_value(double offset) const {
        ArcPosition position = start(offset);
        double sum = 0.0;
        for (std::size_t i = 0; i < weights_.size(); ++i) {
            poller_.poll_in_loop(i);
            position.move_to(shorter_.arc_lengths()[i] + offset);
            sum += weights_[i] * norm(position.point_on(longer_.points()) - shorter_.points()[i]);
        }
        return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
    }

    // A segment at or shortly before arc length u. A walk that starts there takes few steps, and
    // none of its steps waits for the steps to an earlier place.
    const Segment* signpost(double u) const noexcept {
        return segments_.data() + signposts_[static_cast<std::size_t>(u * signposts_per_length_)];
    }

    void fill_signposts() {
        constexpr std::size_t per_segment = 4;
        const runtime::ScratchVector<double>& t = longer_.arc_lengths();
        const std::size_t count = per_segment * t.size();
        signposts_per_length_ = static_cast<double>(count) / longer_.length();
        signposts_.reserve(count + 2);  // rounding may lead one past the last
        ArcPosition position(t);
        for (std::size_t b = 0; b < count + 2; ++b) {
            poller_.poll_in_loop(b);
            position.move_to(static_cast<double>(b) / signposts_per_length_);
            signposts_.push_back(position.segment());
        }
    }

    ArcPosition start(double offset) const noexcept {
        ArcPosition position(longer_.arc_lengths());
        position.move_to(offset);
        return position;
    }

    // The rate at which the distance from `gap` away grows along a segment; 0 where they touch,
    // which is a slope below all that the distance has there.
    double rate(const Point& gap, double distance, std::size_t segment) const noexcept {
        const double length = segment_length(segment);
        if (distance == 0.0 || length == 0.0) return 0.0;
        const Point edge = longer_.points()[segment + 1] - longer_.points()[segment];
        const double cosine = dot(gap, edge) / (distance * length);
        if (std::isfinite(cosine)) return cosine;
        // The products have overflown.
        const Point from{gap.x / distance, gap.y / distance};
        return dot(from, {edge.x / length, edge.y / length});
    }

    double segment_length(std::size_t segment) const noexcept {
        return longer_.arc_lengths()[segment + 1] - longer_.arc_lengths()[segment];
    }

    Tangent tangent_at(std::size_t i, double u, const ArcPosition& position) const noexcept {
        const Point gap = position.point_on(longer_.points()) - shorter_.points()[i];
        const double distance = norm(gap);
        return {u, distance, rate(gap, distance, position.segment())};
    }

    // How far d_i falls below its tangent between the tangent's place and `end` after it. Behind
    // each corner, d_i lies above the line that leaves the corner with d_i's derivative there.
    double deficit_after(std::size_t i, const Tangent& tangent, const ArcPosition& position,
                         double end) {
        const runtime::ScratchVector<double>& t = longer_.arc_lengths();
        double worst = 0.0;
        for (std::size_t k = position.segment() + 1; k + 1 < t.size() && t[k] < end; ++k) {
            poller_.poll_in_loop(++corners_);
            const Point gap = longer_.points()[k] - shorter_.points()[i];
            const double distance = norm(gap);
            const double stop = std::min(t[k + 1], end);
            const double line = distance + rate(gap, distance, k) * (stop - t[k]);
            worst = std::max(worst, tangent(stop) - line);
        }
        return worst;
    }

    double deficit_before(std::size_t i, const Tangent& tangent, const ArcPosition& position,
                          double begin) {
        const runtime::ScratchVector<double>& t = longer_.arc_lengths();
        double worst = 0.0;
        for (std::size_t k = position.segment(); k > 0 && t[k] > begin; --k) {
            poller_.poll_in_loop(++corners_);
            const Point gap = longer_.points()[k] - shorter_.points()[i];
            const double distance = norm(gap);
            const double stop = std::max(t[k - 1], begin);
            const double line = distance - rate(gap, distance, k - 1) * (t[k] - stop);
            worst = std::max(worst, tangent(stop) - line);
        }
        return worst;
    }

    const ArcCurve& shorter_;
    const ArcCurve& longer_;
    Poller& poller_;
    runtime::ScratchVector<double> weights_;
    runtime::ScratchVector<Segment> segments_;
    runtime::ScratchVector<std::size_t> signposts_;
    double signposts_per_length_ = 0.0;
    std::size_t corners_ = 0;  // tested for the present lower bound
};

double slack(const ArcCurve& shorter, const ArcCurve& longer) noexcept {
    return std::max(0.0, longer.length() - shorter.length());
}

void improve(Offset& best, double at, double area) noexcept {
    if (area < best.area || (area == best.area && at < best.at)) best = {at, area};
}

// Offset i of `count` evenly spaced ones.
double grid_offset(double slack, std::ptrdiff_t i, std::ptrdiff_t count) noexcept {
    return i == 0 ? 0.0 : slack * (static_cast<double>(i) / static_cast<double>(count - 1));
}

// The search for the best of a grid, in rounds. Each round evaluates the middle offset of every
// interval between two offsets with known areas, unless no offset inside can be the best. f is
// S-Lipschitz: between a and b it is at least (f(a) + f(b) - S (b - a)) / 2.
class GridSearch {
   public:
    GridSearch(const AreaAtOffset& f, double S, double slack, std::ptrdiff_t count)
        : f_(f), S_(S), slack_(slack), count_(count) {}

    // `doubt`: the largest possible rounding error of an area.
    Offset best(double doubt) {
        runtime::ScratchVector<Stretch> open = first_stretches();
        while (!open.empty()) {
            const double most = best_.area + doubt * (1.0 + best_.area);
            const auto is_done = [&](const Stretch& stretch) { return !may_hold(stretch, most); };
            open.erase(std::remove_if(open.begin(), open.end(), is_done), open.end());
            for (const Stretch& stretch : open) {
                wanted_.push_back((stretch.first + stretch.last) / 2);
            }
            evaluate();
            for (std::size_t k = 0; k < wanted_.size(); ++k) {
                open.push_back({wanted_[k], open[k].last, areas_[k], open[k].area_at_last});
                open[k].last = wanted_[k];
                open[k].area_at_last = areas_[k];
            }
            wanted_.clear();
        }
        return best_;
    }

   private:
    // An interval between two offsets of the grid, with the areas there. The areas of the whole
    // grid might not fit into memory.
    struct Stretch {
        std::ptrdiff_t first;
        std::ptrdiff_t last;
        double area_at_first;
        double area_at_last;
    };

    runtime::ScratchVector<Stretch> first_stretches() {
        constexpr std::ptrdiff_t first_ones = 16;
        const std::ptrdiff_t stride = std::max<std::ptrdiff_t>(1, count_ / (first_ones - 1));
        for (std::ptrdiff_t i = 0; i < count_; i += stride) wanted_.push_back(i);
        if (wanted_.back() != count_ - 1) wanted_.push_back(count_ - 1);
        evaluate();
        runtime::ScratchVector<Stretch> stretches;
        for (std::size_t k = 1; k < wanted_.size(); ++k) {
            stretches.push_back({wanted_[k - 1], wanted_[k], areas_[k - 1], areas_[k]});
        }
        wanted_.clear();
        return stretches;
    }

    double offset(std::ptrdiff_t i) const noexcept { return grid_offset(slack_, i, count_); }

    // An offset inside the best one. Not where areas are infinite, or differences of them no
    // number.
    bool may_hold(const Stretch& stretch, double most) const noexcept {
        const double width = offset(stretch.last) - offset(stretch.first);
        if (stretch.last - stretch.first < 2 || !(width > 0.0)) return false;
        return !(0.5 * (stretch.area_at_first + stretch.area_at_last - S_ * width) > most);
    }

    // The areas at the requested offsets, many at once while there are many.
    void evaluate() {
        areas_.resize(wanted_.size());
        std::size_t done = 0;
        while (wanted_.size() - done >= 16) done = evaluate<16>(done);
        while (wanted_.size() - done >= 4) done = evaluate<4>(done);
        while (wanted_.size() > done) done = evaluate<1>(done);
    }

    template <std::size_t at_once>
    std::size_t evaluate(std::size_t done) {
        std::array<double, at_once> offsets{};
        for (std::size_t o = 0; o < at_once; ++o) offsets[o] = offset(wanted_[done + o]);
        const std::array<double, at_once> areas = f_.values(offsets);
        for (std::size_t o = 0; o < at_once; ++o) {
            areas_[done + o] = areas[o];
            improve(best_, offsets[o], areas[o]);
        }
        return done + at_once;
    }

    const AreaAtOffset& f_;
    double S_;
    double slack_;
    std::ptrdiff_t count_;
    runtime::ScratchVector<std::ptrdiff_t> wanted_;
    runtime::ScratchVector<double> areas_;  // at those
    Offset best_{0.0, std::numeric_limits<double>::infinity()};
};

// Rounding: the sum has a term for each vertex. The terms are distances between points whose
// coordinates are at most those of the box, a distance from it, and the length of a curve.
Offset best_of_grid(const AreaAtOffset& f, const ArcCurve& shorter, const ArcCurve& longer,
                    std::ptrdiff_t count) {
    const double S = shorter.length(), T = longer.length();
    const auto vertices = static_cast<double>(shorter.points().size() + longer.points().size());
    const double doubt = 4.0 * (vertices + 64.0) * std::numeric_limits<double>::epsilon();
    return GridSearch(f, S, slack(shorter, longer), count).best(doubt * (1.0 + S * (2.0 + T)));
}

// f is S-Lipschitz, and no offset is farther than this from one of the grid.
double grid_tolerance(double S, double slack, std::ptrdiff_t count) noexcept {
    return S * (count == 1 ? slack : 0.5 * slack / static_cast<double>(count - 1));
}

struct Interval {
    double low;
    double high;
};

}  // namespace

Offset best_of_grid(const ArcCurve& shorter, const ArcCurve& longer, std::ptrdiff_t count,
                    Poller& poller) {
    const double range = slack(shorter, longer);
    Offset best = best_of_grid(AreaAtOffset(shorter, longer, poller), shorter, longer, count);
    best.tolerance = grid_tolerance(shorter.length(), range, count);
    return best;
}

Offset best_of_all(const ArcCurve& shorter, const ArcCurve& longer, Poller& poller,
                   const SearchEffort& effort) {
    constexpr std::ptrdiff_t count = PcmOptions{}.offsets;
    AreaAtOffset f(shorter, longer, poller);
    const double S = shorter.length();
    const double range = slack(shorter, longer);
    Offset best = best_of_grid(f, shorter, longer, count);
    runtime::ScratchVector<Interval> open;
    for (std::ptrdiff_t i = count - 1; i > 0; --i) {
        open.push_back({grid_offset(range, i - 1, count), grid_offset(range, i, count)});
    }
    double tolerance = finest_tolerance;
    const auto allowed = [&] { return tolerance * std::max(S, of_the_value * best.area); };
    // An infinite tolerance leaves nothing open that has a bound.
    for (std::int64_t tried = 1; !open.empty() && std::isfinite(tolerance); ++tried) {
        if (tried > effort.patience && tried % effort.impatience == 0) tolerance *= 2.0;
        const Interval interval = open.back();
        open.pop_back();
        const double centre = 0.5 * interval.low + 0.5 * interval.high;
        const double half = 0.5 * interval.high - 0.5 * interval.low;
        if (!(interval.low < centre && centre < interval.high)) continue;
        const double area = f.value(centre);
        improve(best, centre, area);
        const double target = best.area - allowed();
        if (area - S * half >= target || f.lower_bound(centre, half) >= target) continue;
        open.push_back({centre, interval.high});
        open.push_back({interval.low, centre});
    }
    best.tolerance = std::min(allowed(), grid_tolerance(S, range, count));
    return best;
}

}  // namespace curvewise::planar
