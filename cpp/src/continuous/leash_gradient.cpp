// The derivatives of the continuous Fréchet distance. A critical event decides the distance: with
// any smaller radius, no path passes it in the free-space diagram (Alt & Godau 1995). There are
// three kinds:
//
// - Two vertices: the ends of the curves, or vertices from which the pair distance grows both ways
//   along one curve.
// - A vertex and the nearest point of an edge, which may be held.
// - Two vertices and one point of an edge that is equally far from both. Along the edge, the
//   distance to the first falls and the distance to the second grows. If a vertex moves, so does
//   that point. The derivative is the mean of both distances' derivatives, with the weights under
//   which moving the point changes nothing.
//
// Every path within the distance passes the deciding event, so it is sought in one matching. Other
// rows may have the same pair distance without need. They are not events, or they are events of a
// smaller distance. If several events have the same distance, the search takes one that still
// decides after both curves have been moved by at most 2^-30 of the distance. It costs O(n + m)
// beyond the value and the path, and both again at ties.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

#include "curves/moved_curve.hpp"
#include "curvewise/gradient.hpp"
#include "runtime/scratch.hpp"

namespace curvewise {
namespace {

// Relative to the largest pair distance: rows to test, and events that tie.
constexpr double nearly_whole = 1e-8;
constexpr double tied = 1e-11;
// A cosine that is 0 but for rounding.
constexpr double level = 1e-9;

using Row = std::array<double, 2>;  // of a matching

// A place on a curve, between a vertex and the next.
struct Place {
    std::ptrdiff_t vertex;
    double fraction;

    explicit Place(double parameter)
        : vertex(static_cast<std::ptrdiff_t>(parameter)),
          fraction(parameter - std::floor(parameter)) {}
    double coordinate(const CurveView& curve, std::ptrdiff_t c) const noexcept {
        const double a = curve(vertex, c);
        return fraction == 0.0 ? a : a + fraction * (curve(vertex + 1, c) - a);
    }
};

// A matched pair of places, at least one of them a vertex.
class Leash {
   public:
    Leash(const CurveView& P, const CurveView& Q, const Row& row)
        : P_(P), Q_(Q), p_(row[0]), q_(row[1]), direction_(differences()) {
        double largest = 0.0;
        for (const double d : direction_) largest = std::max(largest, std::abs(d));
        if (largest == 0.0) return;
        double sum = 0.0;
        for (const double d : direction_) sum += d / largest * (d / largest);
        length_ = largest * std::sqrt(sum);
        for (double& d : direction_) d = d / largest / std::sqrt(sum);
    }

    double length() const noexcept { return length_; }
    bool is_between_vertices() const noexcept { return p_.fraction + q_.fraction == 0.0; }
    // For a pair of vertices: whether no path with a smaller distance passes there.
    bool blocks() const noexcept {
        const bool before_p = grows(P_, p_, -1, -1.0), behind_p = grows(P_, p_, 1, -1.0);
        const bool before_q = grows(Q_, q_, -1, 1.0), behind_q = grows(Q_, q_, 1, 1.0);
        return (before_p || behind_q) && (before_q || behind_p);
    }
    // How fast it grows as its end moves along the edge, by the cosine of the angle.
    double cosine() const noexcept {
        return p_.fraction > 0.0 ? -cosine_to(P_, p_.vertex, p_.vertex + 1)
                                 : cosine_to(Q_, q_.vertex, q_.vertex + 1);
    }
    // The distance along the edge from this end to the end of another pair; nullopt if that end is
    // on another edge.
    std::optional<double> distance_along_edge(const Leash& other) const noexcept {
        const auto on_one = [](const Place& a, const Place& b) {
            return a.fraction > 0.0 && b.fraction > 0.0 && a.vertex == b.vertex;
        };
        if (on_one(p_, other.p_)) {
            return (other.p_.fraction - p_.fraction) * edge_length(P_, p_.vertex);
        }
        if (on_one(q_, other.q_)) {
            return (other.q_.fraction - q_.fraction) * edge_length(Q_, q_.vertex);
        }
        return std::nullopt;
    }
    // The row of the point of the edge that is nearest to the vertex of the other curve.
    Row nearest() const noexcept {
        const bool is_on_p = p_.fraction > 0.0;
        const Place& place = is_on_p ? p_ : q_;
        const double forward = -cosine() * length_ / edge_length(is_on_p ? P_ : Q_, place.vertex);
        const double least = static_cast<double>(place.vertex);
        const double moved = least + std::clamp(place.fraction + forward, 0.0, 1.0);
        return is_on_p ? Row{moved, static_cast<double>(q_.vertex)}
                       : Row{static_cast<double>(p_.vertex), moved};
    }
    void add(double weight, const Gradients& out) const noexcept {
        add_to(out.by_p, p_, -weight);
        add_to(out.by_q, q_, weight);
    }

   private:
    runtime::ScratchVector<double> differences() const {
        runtime::ScratchVector<double> result;
        for (std::ptrdiff_t c = 0; c < P_.dim(); ++c) {
            result.push_back(q_.coordinate(Q_, c) - p_.coordinate(P_, c));
        }
        return result;
    }
    // Whether the distance does not fall towards the next vertex of a curve, or the curve ends.
    bool grows(const CurveView& curve, const Place& place, std::ptrdiff_t step,
               double sign) const noexcept {
        const std::ptrdiff_t next = place.vertex + step;
        if (next < 0 || next >= curve.size()) return true;
        return sign * cosine_to(curve, place.vertex, next) >= -level;
    }
    // The cosine of the angle between the pair's direction and an edge; 0 for an edge of length
    // zero.
    double cosine_to(const CurveView& curve, std::ptrdiff_t from,
                     std::ptrdiff_t to) const noexcept {
        double largest = 0.0, dot = 0.0, squares = 0.0;
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            largest = std::max(largest, std::abs(curve(to, c) - curve(from, c)));
        }
        if (largest == 0.0) return 0.0;
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            const double step = (curve(to, c) - curve(from, c)) / largest;
            dot += step * direction_[static_cast<std::size_t>(c)];
            squares += step * step;
        }
        return dot / std::sqrt(squares);
    }
    static double edge_length(const CurveView& curve, std::ptrdiff_t vertex) noexcept {
        double length = 0.0;
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            length = std::hypot(length, curve(vertex + 1, c) - curve(vertex, c));
        }
        return length;
    }
    void add_to(double* out, const Place& place, double weight) const noexcept {
        if (out == nullptr) return;
        const std::ptrdiff_t dim = P_.dim();
        for (std::ptrdiff_t c = 0; c < dim; ++c) {
            const double slope = weight * direction_[static_cast<std::size_t>(c)];
            out[place.vertex * dim + c] += (1.0 - place.fraction) * slope;
            if (place.fraction > 0.0) out[(place.vertex + 1) * dim + c] += place.fraction * slope;
        }
    }

    const CurveView& P_;
    const CurveView& Q_;
    Place p_, q_;
    runtime::ScratchVector<double> direction_;  // from P to Q, of length 1
    double length_ = 0.0;
};

// The rows of an event with their weights. The second weight may be 0.
struct Event {
    Row first{}, second{};
    double first_weight = 1.0, second_weight = 0.0;
};

// The event of a matching with the largest pair distance.
class EventSearch {
   public:
    EventSearch(const CurveView& P, const CurveView& Q, const std::vector<Row>& rows) {
        runtime::ScratchVector<double> lengths;
        for (const Row& row : rows) {
            lengths.push_back(Leash(P, Q, row).length());
            if (lengths.back() <= longest_) continue;
            longest_ = lengths.back();
            found_ = {row, row};
        }
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if (lengths[k] < (1.0 - nearly_whole) * longest_) continue;
            const Leash leash(P, Q, rows[k]);
            if (leash.is_between_vertices()) {
                offer_vertices(leash, rows[k]);
                continue;
            }
            offer_nearest(leash, P, Q);
            if (leash.cosine() > 0.0) offer_pair(leash, rows[k]);
            if (leash.cosine() < 0.0) {
                falling_.emplace(leash);
                falling_row_ = rows[k];
            }
        }
    }

    const Event& found() const noexcept { return found_; }
    // Exactly one event has the largest distance.
    bool is_decided() const noexcept { return ties_ == 1; }

   private:
    bool is_whole(double leash) const noexcept { return leash >= (1.0 - tied) * longest_; }

    void offer(const Event& event, double leash) {
        if (is_whole(leash)) ++ties_;
        if (leash <= leash_) return;
        leash_ = leash;
        found_ = event;
    }

    void offer_vertices(const Leash& leash, const Row& row) {
        if (leash.blocks()) {
            offer({row, row}, leash.length());
        } else if (is_whole(leash.length())) {
            ++ties_;  // the place of an event of two pairs, at a vertex by a tie or by rounding
        }
    }

    // The event of a vertex and the nearest point of an edge, which may be a vertex of the edge.
    void offer_nearest(const Leash& leash, const CurveView& P, const CurveView& Q) {
        const Row row = leash.nearest();
        const Leash nearest(P, Q, row);
        if (nearest.is_between_vertices()) return offer_vertices(nearest, row);
        offer({row, row}, nearest.length());
    }

    // The event of a distance that grows and the last one that falls.
    void offer_pair(const Leash& leash, const Row& row) {
        if (!falling_) return;
        const std::optional<double> gap = falling_->distance_along_edge(leash);
        if (!gap) return;
        // Both distances are equal where their tangents cross.
        const double down = -falling_->cosine(), up = leash.cosine();
        const double crossing =
            (up * falling_->length() + down * leash.length() - up * down * *gap) / (up + down);
        offer({falling_row_, row, up / (up + down), down / (up + down)}, crossing);
    }

    double longest_ = -1.0;
    double leash_ = 0.0;  // of the event that is found
    Event found_;
    int ties_ = 0;
    std::optional<Leash> falling_;  // the last on an edge that is nearly whole and falls along it
    Row falling_row_{};
};

Event deciding_event(const CurveView& P, const CurveView& Q,
                     const FrechetContinuousOptions& options, double value, Control* control) {
    const EventSearch search(P, Q, frechet_continuous_path(P, Q, options, control).parameters);
    if (search.is_decided()) return search.found();
    std::minstd_rand random;
    const curves::MovedCurve p(P, value, random), q(Q, value, random);
    const Matching moved = frechet_continuous_path(p.view(), q.view(), options, control);
    return EventSearch(p.view(), q.view(), moved.parameters).found();
}

// For a distance beyond the range, the loss of small coordinates is negligible.
runtime::ScratchVector<double> shrunk(const CurveView& curve) {
    runtime::ScratchVector<double> points;
    for (std::ptrdiff_t i = 0; i < curve.size(); ++i) {
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) points.push_back(curve(i, c) * 0x1p-100);
    }
    return points;
}

}  // namespace

double value_and_gradients(const FrechetContinuousOptions& options, const CurveView& P,
                           const CurveView& Q, const Gradients& out, Control* control) {
    const double value = frechet_continuous(P, Q, options, control);
    if (out.by_p != nullptr) std::fill_n(out.by_p, P.size() * P.dim(), 0.0);
    if (out.by_q != nullptr) std::fill_n(out.by_q, Q.size() * Q.dim(), 0.0);
    if (value == 0.0) return value;
    if (std::isinf(value)) {  // the derivative equals that of smaller curves
        const runtime::ScratchVector<double> p = shrunk(P), q = shrunk(Q);
        value_and_gradients(options, CurveView(p.data(), P.size(), P.dim()),
                            CurveView(q.data(), Q.size(), Q.dim()), out, control);
        return value;
    }
    const Event event = deciding_event(P, Q, options, value, control);
    Leash(P, Q, event.first).add(event.first_weight, out);
    if (event.second_weight > 0.0) Leash(P, Q, event.second).add(event.second_weight, out);
    return value;
}

}  // namespace curvewise
