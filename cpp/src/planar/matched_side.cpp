#include "planar/matched_side.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace curvewise::planar {
namespace {

using curves::BoxSide;

// A reversal below this part of the box is noise, or an outlier, and no travel.
constexpr double least_reversal = 1.0 / 3.0;
// 30 bits hold more than any measurement does, and leave room for sums of a million distances
// without rounding.
constexpr double grid = 0x1p30;
// Further away, in boxes, than any point that could be matched to advantage; keeps sums finite.
constexpr double far = 0x1p40;

double on_grid(double x) noexcept {
    constexpr double no_fraction = 0x1.8p52;  // a number that is added to it loses its fraction
    const double value = x * grid;
    return std::abs(value) < 0x1p51 ? value + no_fraction - no_fraction : std::nearbyint(value);
}

std::uint64_t bits(double x) noexcept {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

// How far a coordinate travels, to and fro, without small reversals. In units of the grid, for no
// rounding error may decide how many pieces there are.
class Travel {
   public:
    explicit Travel(double start) noexcept : low_(start), high_(start), turn_(start) {}

    void add(double value) noexcept {
        pass(value, value);
        if (way_ != Way::down && value <= high_ - least) {
            turn_at(high_);
            low_ = value;
            way_ = Way::down;
        } else if (way_ != Way::up && value >= low_ + least) {
            turn_at(low_);
            high_ = value;
            way_ = Way::up;
        }
    }
    // Whether it may turn among values between these.
    bool may_turn(double low, double high) const noexcept {
        return (way_ != Way::down && low <= std::max(high_, high) - least) ||
               (way_ != Way::up && high >= std::min(low_, low) + least);
    }
    // Adds such values, where it does not.
    void pass(double low, double high) noexcept {
        low_ = std::min(low_, low);
        high_ = std::max(high_, high);
    }
    double up_to(double end) const noexcept {
        if (way_ == Way::unknown) return std::abs(end - turn_);
        const double last = way_ == Way::up ? high_ : low_;
        return total_ + std::abs(last - turn_) + std::abs(end - last);
    }

   private:
    static constexpr double least = least_reversal * grid;
    enum class Way { unknown, up, down };  // unknown until it has travelled far enough

    void turn_at(double value) noexcept {
        total_ += std::abs(value - turn_);
        turn_ = value;
    }

    double low_, high_, turn_;
    double total_ = 0.0;
    Way way_ = Way::unknown;
};

// The travel of every second value. Most values are tested in groups of neighbours, by the least
// and the largest of a group.
double travel_of(const double* values, std::ptrdiff_t count, Poller& poller) {
    constexpr std::ptrdiff_t some = 16;
    Travel travel(on_grid(values[0]));
    poller.in_runs(count, 1, [&](std::ptrdiff_t run, std::ptrdiff_t run_end) {
        for (std::ptrdiff_t first = run; first < run_end; first += some) {
            const std::ptrdiff_t end = std::min(first + some, run_end);
            double low = values[2 * first], high = low;
            for (std::ptrdiff_t i = first + 1; i < end; ++i) {
                low = std::min(values[2 * i], low);
                high = std::max(values[2 * i], high);
            }
            low = on_grid(low);
            high = on_grid(high);
            if (travel.may_turn(low, high)) {
                for (std::ptrdiff_t i = first; i < end; ++i) travel.add(on_grid(values[2 * i]));
            } else {
                travel.pass(low, high);
            }
        }
    });
    return travel.up_to(on_grid(values[2 * (count - 1)]));
}

// Where each vertex lies along its curve: 0 at the first, `samples` at the last.
AlignedBuffer positions_of(const double* scaled, std::ptrdiff_t count, std::size_t samples,
                           Poller& poller) {
    AlignedBuffer positions(count);
    double* const at = positions.data();
    at[0] = 0.0;
    const auto edge = [=](std::ptrdiff_t i) -> Point {
        return {scaled[2 * i] - scaled[2 * i - 2], scaled[2 * i + 1] - scaled[2 * i - 1]};
    };
    poller.in_runs(count - 1, 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        // In separate loops, which compilers vectorise.
        for (std::ptrdiff_t i = first + 1; i <= end; ++i) {
            const Point step = edge(i);
            at[i] = step.x * step.x + step.y * step.y;
        }
        // The bits of a number rise with it: a difference that is negative has the first one set.
        std::uint64_t outside = 0;
        for (std::ptrdiff_t i = first + 1; i <= end; ++i) {
            outside |= (bits(at[i]) - bits(0x1p-900) - 1) | (bits(0x1p1000) - 1 - bits(at[i]));
            at[i] = std::sqrt(at[i]);
        }
        outside &= bits(-0.0);
        for (std::ptrdiff_t i = first + 1; outside != 0 && i <= end; ++i) at[i] = norm(edge(i));
        for (std::ptrdiff_t i = first + 1; i <= end; ++i) at[i] += at[i - 1];
    });
    const double length = at[count - 1];
    const auto last = static_cast<double>(samples);
    const auto edges = static_cast<double>(count - 1);
    poller.in_runs(count, 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        if (length > 0.0) {
            for (std::ptrdiff_t i = first; i < end; ++i) at[i] = at[i] / length * last;
        } else {
            for (std::ptrdiff_t i = first; i < end; ++i) {
                at[i] = last * static_cast<double>(i) / edges;
            }
        }
    });
    return positions;
}

}  // namespace

CommonBox::CommonBox(const CurveView& Q, const curves::Box& of_p) noexcept
    : is_of_p_{of_p.x.has_extent(), of_p.y.has_extent()}, box_(of_p) {
    if (!is_of_p_[0]) box_.x = BoxSide(Q, 0);
    if (!is_of_p_[1]) box_.y = BoxSide(Q, 1);
}

AlignedBuffer CommonBox::scaled(const CurveView& curve, Poller& poller) const {
    AlignedBuffer points(2 * curve.size());
    double* const to = points.data();
    const BoxSide x = box_.x, y = box_.y;  // which writing to the points does not change
    const auto scale = [&](auto coordinate) {
        poller.in_runs(curve.size(), 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
            std::uint64_t all = 0;
            for (std::ptrdiff_t i = first; i < end; ++i) {
                to[2 * i] = x.scaled(coordinate(i, 0));
                to[2 * i + 1] = y.scaled(coordinate(i, 1));
                all |= bits(to[2 * i]) | bits(to[2 * i + 1]);
            }
            // The bit pattern of a number rises with the number, and the OR of all bit patterns is
            // not below any of them.
            if ((all & ~bits(-0.0)) <= bits(far)) return;
            for (double* value = to + 2 * first; value != to + 2 * end; ++value) {
                *value = std::clamp(*value, -far, far);
            }
        });
    };
    if (const double* const from = curve.row_major(); from != nullptr) {
        scale([=](std::ptrdiff_t i, std::ptrdiff_t c) { return from[2 * i + c]; });
    } else {
        scale(curve);
    }
    return points;
}

double travel(const AlignedBuffer& scaled, std::ptrdiff_t count, Poller& poller) {
    const double x = travel_of(scaled.data(), count, poller);
    return (x + travel_of(scaled.data() + 1, count, poller)) / grid;
}

Coordinates::Coordinates(const CurveView& curve, const curves::RangeScale& range, Poller& poller)
    : data_(range.is_identity() ? curve.row_major() : nullptr) {
    if (data_ != nullptr) return;
    copy_.reserve(2 * curve.size());
    poller.in_runs(curve.size(), 1, [&](std::ptrdiff_t first, std::ptrdiff_t end) {
        for (std::ptrdiff_t i = first; i < end; ++i) {
            copy_.data()[2 * i] = range.shrink(curve(i, 0));
            copy_.data()[2 * i + 1] = range.shrink(curve(i, 1));
        }
    });
    data_ = copy_.data();
}

Side::Side(const CurveView& curve, const curves::RangeScale& range, const AlignedBuffer& scaled,
           std::size_t samples, Poller& poller)
    : count(curve.size()),
      points(curve, range, poller),
      positions(positions_of(scaled.data(), count, samples, poller)),
      sample_count(static_cast<std::ptrdiff_t>(samples) + 1),
      sampled(2 * sample_count) {
    const SpotFinder spots(scaled.data(), positions.data(), count);
    double* to = sampled.data();
    std::ptrdiff_t segment = 0;
    for (std::ptrdiff_t k = 0; k < sample_count; ++k) {
        const Spot spot = spots.at(static_cast<double>(k), segment);
        *to++ = on_grid(spot.point.x);
        *to++ = on_grid(spot.point.y);
        segment = spot.segment;
    }
}

}  // namespace curvewise::planar
