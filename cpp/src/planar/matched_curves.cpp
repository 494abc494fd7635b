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
#include "planar/quad.hpp"

namespace curvewise::planar {
namespace {

constexpr double pieces_per_side = 10.0;  // of the box
constexpr std::size_t samples_per_piece = 5;
constexpr double places_per_piece = 2.0 * samples_per_piece;
// Of the table of the warping path: a second or two. Curves that travel further than 280 sides,
// as those that oscillate do, are matched within a band of so many.
constexpr std::ptrdiff_t most_cells = 200'000'000;

using Cells = std::vector<std::array<std::int64_t, 2>>;

// Another Control watches the path: its cells are none of the steps that the poller counts.
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
        : Matching(P, Q, box, box.scaled(P, poller), range, poller) {}

    std::size_t pieces;
    Side p;
    Side q;
    Cells cells;

   private:
    Matching(const CurveView& P, const CurveView& Q, const CommonBox& box,
             const AlignedBuffer& scaled_p, const curves::RangeScale& range, Poller& poller)
        : pieces(pieces_of(travel(scaled_p, P.size(), poller))),
          p(P, range, scaled_p, samples_per_piece * pieces, poller),
          q(Q, range, box.scaled(Q, poller), samples_per_piece * pieces, poller),
          cells(warping_path(p, q, poller)) {}

    static std::size_t pieces_of(double travel) noexcept {
        return static_cast<std::size_t>(std::max(1.0, std::ceil(pieces_per_side * travel)));
    }
};

// Goes along both curves, from place to place. A place is i + j in cell (i, j) of the path, and
// between two cells by proportion. Calls visit(place, p, q) where a cell is, a vertex of a curve,
// or the end of a piece, in ascending order, each place once, p and q being the Walkers there;
// then, at the end of a piece, end_piece().
template <class Visit, class EndPiece>
class Walk {
   public:
    Walk(const Matching& matching, Poller& poller, Visit visit, EndPiece end_piece)
        : p_(matching.p.walker()),
          q_(matching.q.walker()),
          poller_(poller),
          visit_(visit),
          end_piece_(end_piece) {}

    void along(const Cells& cells) {
        visit_at(0.0);
        for (std::size_t k = 1; k < cells.size(); ++k) {
            const auto i = static_cast<double>(cells[k - 1][0]);
            const auto j = static_cast<double>(cells[k - 1][1]);
            if (cells[k][1] == cells[k - 1][1]) {
                go_alone(p_, i, i + j);
            } else if (cells[k][0] == cells[k - 1][0]) {
                go_alone(q_, j, i + j);
            } else {
                go_together(i, j);
            }
        }
    }

   private:
    // From a sample of one curve to the next, while the other one stays where it is.
    void go_alone(Walker& walker, double sample, double begin) {
        walker.look_behind(sample);
        const double end = begin + 1.0;
        for (double place; (place = walker.place(sample, begin, 1.0)) < end;
             walker.look_further()) {
            if (place <= last_) continue;
            walker.move_to(sample + (place - begin));
            visit_at(place);
        }
        walker.move_to(sample + 1.0);
        visit_whole(end);
    }

    // From one sample of each to the next.
    void go_together(double i, double j) {
        const double begin = i + j;
        p_.look_behind(i);
        q_.look_behind(j);
        const auto move_to = [&](double place) {
            p_.move_to(i + 0.5 * (place - begin));
            q_.move_to(j + 0.5 * (place - begin));
        };
        double of_p = p_.place(i, begin, 2.0), of_q = q_.place(j, begin, 2.0);
        const bool is_cut = begin + 1.0 == end_of_piece_;
        for (double end = begin + (is_cut ? 1.0 : 2.0);; end = begin + 2.0) {
            for (double place; (place = std::min(of_p, of_q)) < end;) {
                if (of_p <= place) {
                    p_.look_further();
                    of_p = p_.place(i, begin, 2.0);
                }
                if (of_q <= place) {
                    q_.look_further();
                    of_q = q_.place(j, begin, 2.0);
                }
                if (place <= last_) continue;
                move_to(place);
                visit_at(place);
            }
            move_to(end);
            visit_whole(end);
            if (end == begin + 2.0) return;
        }
    }

    void visit_at(double place) {
        poller_.poll_in_loop(visits_++);
        visit_(place, p_, q_);
        last_ = place;
    }
    void visit_whole(double place) {
        visit_at(place);
        if (place != end_of_piece_) return;
        end_piece_();
        end_of_piece_ += places_per_piece;
    }

    Walker p_, q_;
    Poller& poller_;
    Visit visit_;
    EndPiece end_piece_;
    double end_of_piece_ = places_per_piece;
    double last_ = 0.0;  // that was visited
    std::size_t visits_ = 0;
};

// Of a position along a curve, which is far from the largest whole number.
bool is_at_sample(double position) noexcept {
    return position == static_cast<double>(static_cast<std::int64_t>(position));
}

// The vertices of a curve that lie between its samples, and their places along the path. `side` is
// that of the cells: 0 for P, 1 for Q.
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
    std::vector<std::size_t> vertices;
    std::vector<double> places;
};

// Where a Walker is, one place after the other.
class PlaceRecorder {
   public:
    PlaceRecorder(const Side& curve, const Cells& cells, std::size_t side, Poller& poller)
        : of_vertices_(curve, cells, side, poller),
          length_(static_cast<double>(curve.sample_count - 1)) {}

    void add(double place, const Walker& walker) {
        const auto& [vertices, places] = of_vertices_;
        while (next_ < places.size() && places[next_] < place) ++next_;
        if (next_ < places.size() && places[next_] == place) {
            found_.push_back({true, vertices[next_], 0.0, 0.0});
        } else {
            found_.push_back(
                {false, walker.segment(), walker.fraction(), walker.position() / length_});
        }
    }
    std::vector<PlacesOnCurve::Place> take() { return std::move(found_); }

   private:
    VertexPlaces of_vertices_;
    double length_;
    std::size_t next_ = 0;
    std::vector<PlacesOnCurve::Place> found_;
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

std::vector<double> matched_areas(const CurveView& P, const CurveView& Q,
                                  const curves::RangeScale& range, Poller& poller) {
    const Matching matching(P, Q, CommonBox(P, Q), range, poller);
    std::vector<double> areas;
    areas.reserve(matching.pieces);
    Quad quad{{0.0, 0.0}, matching.p.walker().point(), matching.q.walker().point(), {0.0, 0.0}};
    double area = 0.0;
    const auto add = [&](double /*place*/, const Walker& p, const Walker& q) {
        quad = {quad.b, p.point(), q.point(), quad.c};
        area += quad.signed_area();
    };
    const auto end_piece = [&]() {
        areas.push_back(area);
        area = 0.0;
    };
    Walk(matching, poller, add, end_piece).along(matching.cells);
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
    const auto add = [&](double place, const Walker& p, const Walker& q) {
        result.A.push_back(p.point());
        result.B.push_back(q.point());
        if (!of_p) return;
        of_p->add(place, p);
        of_q->add(place, q);
    };
    const auto end_piece = [&]() { result.ends.push_back(result.A.size() - 1); };
    Walk(matching, poller, add, end_piece).along(matching.cells);
    if (on_curves != nullptr) {
        *on_curves = {{of_p->take(), as_polyline(box.scaled(P, poller), P.size())},
                      {of_q->take(), as_polyline(box.scaled(Q, poller), Q.size())},
                      box.slopes(),
                      box.is_of_p()};
    }
    return result;
}

}  // namespace curvewise::planar
