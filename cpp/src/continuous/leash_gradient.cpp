// The derivatives of the continuous Fréchet distance. The distance is the leash at one place of the
// free-space diagram, where it decides whether a path exists (Alt & Godau 1995):
//
//   - between two vertices, or between a vertex and the point of an edge that is nearest to it: the
//     leash moves with both of its ends, and the nearest point may be held;
//   - between one point of an edge and two vertices that are equally far from it, one of them
//   passed
//     before the other: when a vertex moves, so does that point. The derivative is the mean of
//     those of both leashes with the weights under which moving the point changes nothing.
//
// The place is read off a matching: O(n + m) beyond the value and the path.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "curvewise/gradient.hpp"

namespace curvewise {
namespace {

// Leashes that are equal but for rounding, and cosines that are 0.
constexpr double same_leash = 1e-9;
constexpr double right_angle = 1e-5;

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

// The leash between two places.
class Leash {
   public:
    Leash(const CurveView& P, const CurveView& Q, const std::array<double, 2>& parameters)
        : P_(P), Q_(Q), p_(parameters[0]), q_(parameters[1]), direction_(differences()) {
        double largest = 0.0;
        for (const double d : direction_) largest = std::max(largest, std::abs(d));
        if (largest == 0.0) return;
        double sum = 0.0;
        for (const double d : direction_) sum += d / largest * (d / largest);
        length_ = largest * std::sqrt(sum);
        for (double& d : direction_) d = d / largest / std::sqrt(sum);
    }

    double length() const noexcept { return length_; }
    // How fast it grows as its end moves along the edge on which that is, by the cosine of the
    // angle; none where both ends are vertices.
    std::optional<double> cosine() const noexcept {
        if (p_.fraction > 0.0) return -cosine_to(P_, p_.vertex);
        if (q_.fraction > 0.0) return cosine_to(Q_, q_.vertex);
        return std::nullopt;
    }
    // Whether both have an end on the same edge.
    bool shares_edge(const Leash& other) const noexcept {
        const auto same = [](const Place& a, const Place& b) {
            return a.fraction > 0.0 && b.fraction > 0.0 && a.vertex == b.vertex;
        };
        return same(p_, other.p_) || same(q_, other.q_);
    }
    void add(double weight, const Gradients& out) const noexcept {
        add_to(out.by_p, p_, -weight);
        add_to(out.by_q, q_, weight);
    }

   private:
    std::vector<double> differences() const {
        std::vector<double> result;
        for (std::ptrdiff_t c = 0; c < P_.dim(); ++c) {
            result.push_back(q_.coordinate(Q_, c) - p_.coordinate(P_, c));
        }
        return result;
    }
    double cosine_to(const CurveView& curve, std::ptrdiff_t vertex) const noexcept {
        double largest = 0.0, dot = 0.0, squares = 0.0;
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            largest = std::max(largest, std::abs(curve(vertex + 1, c) - curve(vertex, c)));
        }
        for (std::ptrdiff_t c = 0; c < curve.dim(); ++c) {
            const double step = (curve(vertex + 1, c) - curve(vertex, c)) / largest;
            dot += step * direction_[static_cast<std::size_t>(c)];
            squares += step * step;
        }
        return dot / std::sqrt(squares);
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
    std::vector<double> direction_;  // from P to Q, of length 1
    double length_ = 0.0;
};

// The other leash of a pair that decides together with the longest; none where that does alone.
std::optional<Leash> partner_of(const Leash& longest, const Matching& matching, const CurveView& P,
                                const CurveView& Q) {
    const std::optional<double> cosine = longest.cosine();
    if (!cosine || std::abs(*cosine) <= right_angle) return std::nullopt;
    for (const auto& row : matching.parameters) {
        const Leash other(P, Q, row);
        if (other.length() < (1.0 - same_leash) * longest.length()) continue;
        if (other.shares_edge(longest) && *other.cosine() * *cosine < 0.0) return other;
    }
    return std::nullopt;
}

}  // namespace

double value_and_gradients(const FrechetContinuousOptions& options, const CurveView& P,
                           const CurveView& Q, const Gradients& out, Control* control) {
    const double value = frechet_continuous(P, Q, options, control);
    if (out.by_p != nullptr) std::fill_n(out.by_p, P.size() * P.dim(), 0.0);
    if (out.by_q != nullptr) std::fill_n(out.by_q, Q.size() * Q.dim(), 0.0);
    if (value == 0.0) return value;
    const Matching matching = frechet_continuous_path(P, Q, options, control);
    const std::array<double, 2>* place = nullptr;
    double length = -1.0;
    for (const auto& row : matching.parameters) {
        const double its_length = Leash(P, Q, row).length();
        if (its_length <= length) continue;
        length = its_length;
        place = &row;
    }
    const Leash longest(P, Q, *place);
    if (const std::optional<Leash> partner = partner_of(longest, matching, P, Q)) {
        const double own = *longest.cosine(), other = *partner->cosine();
        longest.add(other / (other - own), out);
        partner->add(own / (own - other), out);
    } else {
        longest.add(1.0, out);
    }
    return value;
}

}  // namespace curvewise
