#include "planar/matched_curves.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "curvewise/control.hpp"
#include "curvewise/dtw.hpp"
#include "planar/matched_side.hpp"
#include "planar/matched_walk.hpp"
#include "planar/quad.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::planar {
namespace {

constexpr double pieces_per_side = 10.0;  // of the box
constexpr std::size_t samples_per_piece = 5;
constexpr double places_per_piece = 2.0 * samples_per_piece;
// Cells of the table of the warping path: a second or two. Curves that travel further than 280
// sides, for example oscillating ones, are matched within a band of this number of cells.
constexpr std::ptrdiff_t most_cells = 200'000'000;

// Another Control watches the path; the poller does not count its cells.
Cells warping_path(const Side& P, const Side& Q, Poller& poller) {
    poller.poll_in_loop(0);
    DtwOptions options;
    options.ground.metric = Metric::cityblock;
    const std::ptrdiff_t samples = P.samples().size();
    if (samples > most_cells / samples) options.window = most_cells / samples / 2;
    Control control([&](std::int64_t, std::int64_t) { return !poller.poll(); },
                    std::chrono::milliseconds(20));
    return dtw_path(P.samples(), Q.samples(), options,
                    poller.control() == nullptr ? nullptr : &control)
        .path;
}

// Both curves, and the warping path between their samples.
struct Matching {
    Matching(const CurveView& P, const CurveView& Q, const CommonBox& box,
             const curves::RangeScale& range, Poller& poller)
        : Matching(P, Q, box, box.scaled(P, poller), range, poller) {
        cells = warping_path(p, q, poller);
    }

    std::size_t pieces;
    Side p;
    Side q;
    Cells cells;

   private:
    Matching(const CurveView& P, const CurveView& Q, const CommonBox& box,
             const AlignedBuffer& scaled_p, const curves::RangeScale& range, Poller& poller)
        : pieces(pieces_of(travel(scaled_p, P.size(), poller))),
          p(P, range, scaled_p, samples_per_piece * pieces, poller),
          q(Q, range, box.scaled(Q, poller), samples_per_piece * pieces, poller) {}

    static std::size_t pieces_of(double travel) noexcept {
        return static_cast<std::size_t>(std::max(1.0, std::ceil(pieces_per_side * travel)));
    }
};

// For a position along a curve, which is far from the largest whole number.
bool is_at_sample(double position) noexcept {
    return position == static_cast<double>(static_cast<std::int64_t>(position));
}

// The vertices of a curve that lie between its samples, and their places along the path. `side` is
// the side of the cells: 0 for P, 1 for Q.
struct VertexPlaces {
    VertexPlaces(const Side& curve, const Cells& cells, std::size_t side, Poller& poller) {
        std::size_t step = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(curve.count); ++k) {
            poller.poll_in_loop(k);
            const double position = curve.positions.data()[k];
            if (is_at_sample(position)) continue;
            while (static_cast<double>(cells[step + 1][side]) < position) ++step;
            const auto begin = static_cast<double>(cells[step][0] + cells[step][1]);
            const auto end = static_cast<double>(cells[step + 1][0] + cells[step + 1][1]);
            const auto sample = static_cast<double>(cells[step][side]);
            vertices.push_back(k);
            places.push_back(begin + (position - sample) * (end - begin));
        }
    }
    runtime::ScratchVector<std::size_t> vertices;
    runtime::ScratchVector<double> places;
};

// Spots, one place after the other.
class PlaceRecorder {
   public:
    PlaceRecorder(const Side& curve, const Cells& cells, std::size_t side, Poller& poller)
        : of_vertices_(curve, cells, side, poller),
          length_(static_cast<double>(curve.sample_count - 1)) {}

    void add(double place, const Spot& spot) {
        const auto& [vertices, places] = of_vertices_;
        while (next_ < places.size() && places[next_] < place) ++next_;
        if (next_ < places.size() && places[next_] == place) {
            found_.push_back({true, vertices[next_], 0.0, 0.0});
        } else {
            found_.push_back({false, static_cast<std::size_t>(spot.segment), spot.fraction,
                              spot.position / length_});
        }
    }
    runtime::ScratchVector<PlacesOnCurve::Place> take() { return std::move(found_); }

   private:
    VertexPlaces of_vertices_;
    double length_;
    std::size_t next_ = 0;
    runtime::ScratchVector<PlacesOnCurve::Place> found_;
};

Polyline as_polyline(const AlignedBuffer& points, std::ptrdiff_t count) {
    Polyline line;
    line.reserve(static_cast<std::size_t>(count));
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        line.push_back({points.data()[2 * i], points.data()[2 * i + 1]});
    }
    return line;
}

}  // namespace

runtime::ScratchVector<double> matched_areas(const CurveView& P, const CurveView& Q,
                                             const curves::RangeScale& range, Poller& poller) {
    const Matching matching(P, Q, CommonBox(P, Q), range, poller);
    runtime::ScratchVector<double> areas;
    areas.reserve(matching.pieces);
    Quad quad{{0.0, 0.0},
              matching.p.spots().at(0.0, 0).point,
              matching.q.spots().at(0.0, 0).point,
              {0.0, 0.0}};
    double area = 0.0;
    const auto add = [&](double /*place*/, const Spot& p, const Spot& q) {
        quad = {quad.b, p.point, q.point, quad.c};
        area += quad.signed_area();
    };
    const auto end_piece = [&]() {
        areas.push_back(area);
        area = 0.0;
    };
    walk(matching.p, matching.q, matching.cells, places_per_piece, poller, add, end_piece);
    return areas;
}

MatchedCurves match(const CurveView& P, const CurveView& Q, const curves::RangeScale& range,
                    Poller& poller, PlacesOnCurves* on_curves) {
    const CommonBox box(P, Q);
    const Matching matching(P, Q, box, range, poller);
    MatchedCurves result;
    // Vertices, the path's cells, and the ends of pieces.
    const auto vertices = static_cast<std::size_t>(P.size() + Q.size());
    const std::size_t most = vertices + matching.cells.size() + matching.pieces;
    result.A.reserve(most);
    result.B.reserve(most);
    result.ends.reserve(matching.pieces);
    std::optional<PlaceRecorder> of_p, of_q;
    if (on_curves != nullptr) {
        of_p.emplace(matching.p, matching.cells, 0, poller);
        of_q.emplace(matching.q, matching.cells, 1, poller);
    }
    const auto add = [&](double place, const Spot& p, const Spot& q) {
        result.A.push_back(p.point);
        result.B.push_back(q.point);
        if (!of_p) return;
        of_p->add(place, p);
        of_q->add(place, q);
    };
    const auto end_piece = [&]() { result.ends.push_back(result.A.size() - 1); };
    walk(matching.p, matching.q, matching.cells, places_per_piece, poller, add, end_piece);
    if (on_curves != nullptr) {
        *on_curves = {{of_p->take(), as_polyline(box.scaled(P, poller), P.size())},
                      {of_q->take(), as_polyline(box.scaled(Q, poller), Q.size())},
                      box.slopes(),
                      box.is_of_p()};
    }
    return result;
}

}  // namespace curvewise::planar
