// The walk along two curves that a path matches (matched_curves.hpp), from place to place. A place
// is i + j in cell (i, j) of the path, and by proportion between two cells.
//
// Three sequences are merged: the cells and the ends of pieces, the vertices of one curve, and
// those of the other. Their order cannot be predicted, so no branch depends on it. Rounding decides
// whether a curve has come to a vertex at the vertex's own place, so no branch depends on that
// either. The steps and vertices ahead are prepared for the walk, some at a time. Time O(n + m +
// k), memory O(1).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "planar/matched_side.hpp"

namespace curvewise::planar {

using Cells = std::vector<std::array<std::int64_t, 2>>;

// Where a path goes from a sample of a curve to the next.
struct Passage {
    double begin;  // the place
    double rate;   // places a sample
};

// The vertices of a curve that are ahead, and the last two before them.
class VerticesAhead {
   public:
    static constexpr std::ptrdiff_t most_steps = 128;
    struct Vertex {
        double place;  // infinite for the last of them, which is further ahead
        double position;
        Point point;
    };

    explicit VerticesAhead(const Side& curve) noexcept
        : positions_(curve.positions.data()), points_(curve.points.data()), spots_(curve.spots()) {}

    // Up to most_steps samples from `first` on.
    void begin(std::int64_t first, std::int64_t end) noexcept {
        first_sample_ = first;
        end_sample_ = static_cast<double>(end);
    }
    void pass(std::int64_t sample, const Passage& passage) noexcept {
        passages_[static_cast<std::size_t>(sample - first_sample_)] = passage;
    }
    // Reads those from `next` on, up to the last of the samples. Returns where `next` is then.
    const Vertex* read(const Vertex* next) noexcept;
    const Vertex* next() const noexcept { return vertices_.data() + before; }
    // The place of the last vertex that has been read; infinite if no more vertices follow before
    // the last sample.
    double last_place() const noexcept { return last_place_; }

    // Where the curve is at a position, given the vertex behind the place.
    Spot at(double position, const Vertex* next) const noexcept {
        const Vertex* begin = next - 1;
        begin = begin->position > position ? begin - 1 : begin;
        const double fraction =
            (position - begin->position) / (begin[1].position - begin->position);
        const std::ptrdiff_t segment = index_ + (begin - this->next());
        if (!is_from_0_to_1(fraction)) return spots_.at(position, segment);
        const Point& start = begin->point;
        return {position,
                segment,
                fraction,
                {start.x + fraction * (begin[1].point.x - start.x),
                 start.y + fraction * (begin[1].point.y - start.y)}};
    }

   private:
    static constexpr std::ptrdiff_t before = 2;
    static constexpr std::ptrdiff_t most = 256;  // ahead

    // Excludes 1. One comparison of bits suffices: negative numbers and NaN have larger bit
    // patterns.
    static bool is_from_0_to_1(double fraction) noexcept {
        constexpr std::uint64_t bits_of_1 = std::uint64_t{0x3ff} << 52;
        std::uint64_t bits = 0;
        std::memcpy(&bits, &fraction, sizeof bits);
        return bits < bits_of_1;
    }

    const double* positions_;
    const double* points_;
    SpotFinder spots_;
    std::int64_t first_sample_ = 0;
    double end_sample_ = 0.0;
    std::ptrdiff_t index_ = 1;  // of the next vertex: the walk begins at the first
    double last_place_ = 0.0;
    std::array<Vertex, before + most + 1> vertices_;
    std::array<Passage, most_steps> passages_;
};

// The steps of a path that are ahead.
class StepsAhead {
   public:
    // From a cell to the next, or up to the end of a piece between them.
    struct Step {
        double end;                   // its place; it starts at
        double begin;                 // the place of the cell, at
        double i, j;                  // the two samples, with
        double rate_of_p, rate_of_q;  // samples a place
    };

    StepsAhead(const Cells& cells, double places_per_piece) noexcept
        : cells_(cells), places_per_piece_(places_per_piece), end_of_piece_(places_per_piece) {}
    // Reads the next cells, and the places where they pass samples. False if no cells remain.
    bool read(VerticesAhead& of_p, VerticesAhead& of_q) noexcept;
    const Step* next() const noexcept { return steps_.data(); }
    double last_place() const noexcept { return steps_[count_ - 1].end; }

   private:
    const Cells& cells_;
    std::size_t cell_ = 0;
    double places_per_piece_;
    double end_of_piece_;
    std::size_t count_ = 0;
    std::array<Step, 2 * VerticesAhead::most_steps> steps_;
};

// Calls visit(place, p, q) at each cell, each vertex of a curve and each end of a piece, in
// ascending order. Each place comes once; p and q are the Spots there. At the end of a piece, calls
// end_piece(), too.
template <class Visit, class EndPiece>
void walk(const Side& P, const Side& Q, const Cells& cells, double places_per_piece, Poller& poller,
          Visit visit, EndPiece end_piece) {
    VerticesAhead p(P), q(Q);
    StepsAhead steps(cells, places_per_piece);
    visit(0.0, P.spots().at(0.0, 0), Q.spots().at(0.0, 0));
    double last = 0.0;  // that was visited
    double end_of_piece = places_per_piece;
    const auto* of_p = p.next();
    const auto* of_q = q.next();
    while (steps.read(p, q)) {
        const auto* step = steps.next();
        of_p = p.read(of_p);
        of_q = q.read(of_q);
        while (last < steps.last_place()) {
            if (of_p->place > p.last_place()) of_p = p.read(of_p);
            if (of_q->place > q.last_place()) of_q = q.read(of_q);
            const double end = std::min({steps.last_place(), p.last_place(), q.last_place()});
            poller.spend(VerticesAhead::most_steps);
            double place = 0.0;
            do {
                place = std::min(std::min(of_p->place, of_q->place), step->end);
                const double from = place - step->begin;
                of_p = of_p->place <= place ? of_p + 1 : of_p;
                of_q = of_q->place <= place ? of_q + 1 : of_q;
                const Spot at_p = p.at(step->i + step->rate_of_p * from, of_p);
                const Spot at_q = q.at(step->j + step->rate_of_q * from, of_q);
                step = step->end <= place ? step + 1 : step;
                if (place <= last) continue;
                last = place;
                visit(place, at_p, at_q);
                if (place != end_of_piece) continue;
                end_piece();
                end_of_piece += places_per_piece;
            } while (place < end);
        }
    }
}

}  // namespace curvewise::planar
