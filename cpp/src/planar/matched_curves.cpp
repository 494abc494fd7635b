#include "planar/matched_curves.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "curves/arc_length.hpp"
#include "curves/box.hpp"
#include "curvewise/control.hpp"
#include "curvewise/dtw.hpp"

namespace curvewise::planar {
namespace {

using curves::ArcPosition;
using curves::BoxSide;
using curves::Point;

constexpr double pieces_per_side = 10.0;  // of the box
constexpr std::size_t samples_per_piece = 5;
// Of the table of the warping path: a second or two. Curves that travel further than 280 sides,
// as those that oscillate do, are matched within a band of so many.
constexpr std::ptrdiff_t most_cells = 200'000'000;
// A reversal below this part of the box is noise, or an outlier, and no travel.
constexpr double least_reversal = 1.0 / 3.0;
// 30 bits hold more than any measurement does, and leave room for sums of a million distances
// without rounding.
constexpr double grid = 0x1p30;
// Further away, in boxes, than any point that could be matched to advantage; keeps sums finite.
constexpr double far = 0x1p40;

// The box of P; of Q, in a direction in which P has no extent.
class CommonBox {
   public:
    CommonBox(const CurveView& P, const CurveView& Q)
        : is_of_p_{BoxSide(P, 0).has_extent(), BoxSide(P, 1).has_extent()},
          sides_{BoxSide(is_of_p_[0] ? P : Q, 0), BoxSide(is_of_p_[1] ? P : Q, 1)} {}

    Polyline scaled(const CurveView& curve, Poller& poller) const {
        Polyline points;
        points.reserve(static_cast<std::size_t>(curve.size()));
        for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
            poller.poll_in_loop(points.size());
            points.push_back({std::clamp(sides_[0].scaled(curve(i, 0)), -far, far),
                              std::clamp(sides_[1].scaled(curve(i, 1)), -far, far)});
        }
        return points;
    }
    std::array<double, 2> slopes() const noexcept { return {sides_[0].slope(), sides_[1].slope()}; }
    const std::array<bool, 2>& is_of_p() const noexcept { return is_of_p_; }

   private:
    std::array<bool, 2> is_of_p_;
    std::array<BoxSide, 2> sides_;
};

double on_grid(double x) noexcept { return std::nearbyint(x * grid); }

// How far a coordinate travels, to and fro, without small reversals. In units of the grid, for no
// rounding error may decide how many pieces there are.
double travel_of(const Polyline& points, double Point::*coordinate, Poller& poller) {
    constexpr double least = least_reversal * grid;
    double total = 0.0;
    double low = on_grid(points.front().*coordinate), high = low, turn = low;
    std::optional<bool> rises;  // not known until it has travelled far enough
    for (std::size_t i = 0; i < points.size(); ++i) {
        poller.poll_in_loop(i);
        const double value = on_grid(points[i].*coordinate);
        low = std::min(low, value);
        high = std::max(high, value);
        if (rises != false && value <= high - least) {
            total += high - turn;
            turn = high;
            low = value;
            rises = false;
        } else if (rises != true && value >= low + least) {
            total += turn - low;
            turn = low;
            high = value;
            rises = true;
        }
    }
    const double end = on_grid(points.back().*coordinate);
    if (!rises) return std::abs(end - turn);
    const double last = *rises ? high : low;
    return total + std::abs(last - turn) + std::abs(end - last);
}

std::size_t count_pieces(const Polyline& scaled, Poller& poller) {
    const double travel =
        (travel_of(scaled, &Point::x, poller) + travel_of(scaled, &Point::y, poller)) / grid;
    return static_cast<std::size_t>(std::max(1.0, std::ceil(pieces_per_side * travel)));
}

// Where each vertex lies along its curve: 0 at the first, `samples` at the last.
std::vector<double> positions_of(const Polyline& scaled, std::size_t samples, Poller& poller) {
    std::vector<double> positions = arc_lengths(scaled, poller);
    const double length = positions.back();
    const auto last = static_cast<double>(samples);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        poller.poll_in_loop(i);
        positions[i] = length > 0.0 ? positions[i] / length * last
                                    : last * static_cast<double>(i) /
                                          static_cast<double>(positions.size() - 1);
    }
    return positions;
}

// One of the two curves.
struct Side {
    Side(const CurveView& curve, const curves::RangeScale& range, const Polyline& scaled,
         std::size_t samples, Poller& poller)
        : points(polyline(curve, range, poller)), positions(positions_of(scaled, samples, poller)) {
        sampled.reserve(2 * (samples + 1));
        ArcPosition at(positions);
        for (std::size_t k = 0; k <= samples; ++k) {
            at.move_to(static_cast<double>(k));
            const Point point = at.point_on(scaled);
            sampled.push_back(on_grid(point.x));
            sampled.push_back(on_grid(point.y));
        }
    }
    CurveView samples() const noexcept {
        return {sampled.data(), static_cast<std::ptrdiff_t>(sampled.size() / 2), 2};
    }

    Polyline points;
    std::vector<double> positions;
    std::vector<double> sampled;  // x and y at positions 0, 1, ..., on the grid
};

// The cells of the warping path, as numbers.
struct Route {
    explicit Route(const Alignment& alignment) {
        for (const auto& [row, column] : alignment.path) {
            i.push_back(static_cast<double>(row));
            j.push_back(static_cast<double>(column));
            places.push_back(i.back() + j.back());
        }
    }
    std::vector<double> i, j;
    std::vector<double> places;  // i + j, which ascends along the path
};

// Another Control watches the path: its cells are none of the steps that the poller counts.
Route warping_path(const Side& P, const Side& Q, Poller& poller) {
    DtwOptions options;
    options.ground.metric = Metric::cityblock;
    const std::ptrdiff_t samples = P.samples().size();
    if (samples > most_cells / samples) options.window = most_cells / samples / 2;
    Control control([&](std::int64_t, std::int64_t) { return !poller.poll(); },
                    std::chrono::milliseconds(20));
    return Route(dtw_path(P.samples(), Q.samples(), options,
                          poller.control() == nullptr ? nullptr : &control));
}

// Of a position along a curve, which is far from the largest whole number.
bool is_at_sample(double position) noexcept {
    return position == static_cast<double>(static_cast<std::int64_t>(position));
}

// The places along the path of a curve's vertices between its samples, of which the path's cells
// have the numbers `samples`.
std::vector<double> places_of_vertices(const Side& curve, const std::vector<double>& samples,
                                       const Route& route, Poller& poller) {
    std::vector<double> places;
    places.reserve(curve.positions.size());
    std::size_t step = 0;
    for (std::size_t k = 0; k < curve.positions.size(); ++k) {
        poller.poll_in_loop(k);
        const double position = curve.positions[k];
        if (is_at_sample(position)) continue;
        while (samples[step + 1] < position) ++step;
        places.push_back(route.places[step] + (position - samples[step]) *
                                                  (route.places[step + 1] - route.places[step]));
    }
    return places;
}

// Both, in ascending order, each place once.
std::vector<double> merged(const std::vector<double>& a, const std::vector<double>& b,
                           Poller& poller) {
    std::vector<double> result(a.size() + b.size());
    double* const first = result.data();
    double* last = first;
    const auto add = [&](double place) {
        if (last == first || last[-1] != place) *last++ = place;
    };
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        poller.poll_in_loop(i + j);
        add(a[i] <= b[j] ? a[i++] : b[j++]);
    }
    for (; i < a.size(); ++i) add(a[i]);
    for (; j < b.size(); ++j) add(b[j]);
    result.resize(static_cast<std::size_t>(last - first));
    return result;
}

// Calls visit(place, position, at) for places along the path, `position` and `at` being where they
// are on a curve.
template <class Visit>
void for_each_position(const std::vector<double>& places, const Side& curve,
                       const std::vector<double>& samples, const Route& route, Poller& poller,
                       Visit visit) {
    ArcPosition at(curve.positions);
    const std::size_t steps = route.places.size() - 1;
    for (std::size_t step = 0, k = 0; step < steps; ++step) {
        const double from = samples[step], begin = route.places[step];
        const double end = route.places[step + 1];
        const double slope = (samples[step + 1] - from) / (end - begin);
        const bool is_last = step + 1 == steps;
        for (; k < places.size() && (is_last || places[k] < end); ++k) {
            poller.poll_in_loop(k);
            const double position = from + slope * (places[k] - begin);
            at.move_to(position);
            visit(places[k], position, at);
        }
    }
}

// The points of a curve at places along the path.
Polyline points_at(const std::vector<double>& places, const Side& curve,
                   const std::vector<double>& samples, const Route& route, Poller& poller) {
    Polyline points(places.size());
    Point* next = points.data();
    for_each_position(places, curve, samples, route, poller,
                      [&](double /*place*/, double /*position*/, const ArcPosition& at) {
                          *next++ = at.point_on(curve.points);
                      });
    return points;
}

// The same in full; `of_vertices` are the places of those of the curve's vertices that lie between
// samples, in their order.
std::vector<PlacesOnCurve::Place> places_on(const std::vector<double>& places, const Side& curve,
                                            const std::vector<double>& of_vertices,
                                            const std::vector<double>& samples, const Route& route,
                                            Poller& poller) {
    std::vector<std::size_t> vertices;  // of `of_vertices`
    for (std::size_t k = 0; k < curve.positions.size(); ++k) {
        poller.poll_in_loop(k);
        if (!is_at_sample(curve.positions[k])) vertices.push_back(k);
    }
    std::vector<PlacesOnCurve::Place> found;
    found.reserve(places.size());
    std::size_t next = 0;
    for_each_position(places, curve, samples, route, poller,
                      [&](double place, double position, const ArcPosition& at) {
                          while (next < vertices.size() && of_vertices[next] < place) ++next;
                          if (next < vertices.size() && of_vertices[next] == place) {
                              found.push_back({true, vertices[next], 0.0, 0.0});
                          } else {
                              found.push_back({false, at.segment(), at.fraction(),
                                               position / curve.positions.back()});
                          }
                      });
    return found;
}

}  // namespace

MatchedCurves match(const CurveView& P, const CurveView& Q, const curves::RangeScale& range,
                    Poller& poller, PlacesOnCurves* on_curves) {
    const CommonBox box(P, Q);
    const Polyline scaled_p = box.scaled(P, poller);
    const std::size_t pieces = count_pieces(scaled_p, poller);
    const Side p(P, range, scaled_p, samples_per_piece * pieces, poller);
    const Side q(Q, range, box.scaled(Q, poller), samples_per_piece * pieces, poller);
    poller.poll_in_loop(0);
    const Route route = warping_path(p, q, poller);

    std::vector<double> cuts(pieces);
    for (std::size_t k = 0; k < pieces; ++k) {
        cuts[k] = static_cast<double>(2 * samples_per_piece * (k + 1));
    }
    std::vector<double> places = merged(route.places, cuts, poller);
    const std::vector<double> of_p = places_of_vertices(p, route.i, route, poller);
    places = merged(places, of_p, poller);
    const std::vector<double> of_q = places_of_vertices(q, route.j, route, poller);
    places = merged(places, of_q, poller);

    MatchedCurves result{points_at(places, p, route.i, route, poller),
                         points_at(places, q, route.j, route, poller),
                         {}};
    result.ends.reserve(pieces);
    for (std::size_t i = 0; result.ends.size() < pieces; ++i) {
        if (places[i] == cuts[result.ends.size()]) result.ends.push_back(i);
    }
    if (on_curves != nullptr) {
        *on_curves = {{places_on(places, p, of_p, route.i, route, poller), scaled_p},
                      {places_on(places, q, of_q, route.j, route, poller), box.scaled(Q, poller)},
                      box.slopes(),
                      box.is_of_p()};
    }
    return result;
}

}  // namespace curvewise::planar
