#include "planar/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "curves/arc_length.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::planar {
namespace {

// Ties between segments that are equally long but for rounding must not be decided by it: the
// area would then change under translation. Of 53 bits the last 19 go, to nearest, ties to even.
double rounded_to_34_bits(double length) noexcept {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &length, sizeof bits);
    constexpr std::uint64_t gone = (std::uint64_t{1} << 19) - 1;
    bits += gone / 2 + ((bits >> 19) & 1);
    bits &= ~gone;
    std::memcpy(&length, &bits, sizeof bits);
    return length;
}

double segment_length(const curves::Point& edge, Spacing spacing) noexcept {
    return rounded_to_34_bits(spacing == Spacing::x ? std::abs(edge.x)
                                                    : std::sqrt(edge.x * edge.x + edge.y * edge.y));
}

// The part of an original segment from `start` to `start + width`, both fractions of it.
struct Part {
    double length;
    std::size_t segment;
    double start;
    double width;

    // The longest is bisected first, the first along the curve among equals.
    bool operator<(const Part& other) const noexcept {
        if (length != other.length) return length > other.length;
        if (segment != other.segment) return segment < other.segment;
        return start < other.start;
    }
};

// For a curve whose measured length is zero: its first part, again and again.
runtime::ScratchVector<Cut> cuts_of_no_length(std::size_t count) {
    runtime::ScratchVector<Cut> cuts;
    double start = 1.0;
    for (std::size_t c = 0; c < count; ++c) cuts.emplace_back(0, start /= 2.0);
    std::reverse(cuts.begin(), cuts.end());
    return cuts;
}

runtime::ScratchVector<Cut> bisection_cuts(const Polyline& curve, std::size_t count,
                                           Spacing spacing, Poller& poller) {
    runtime::ScratchVector<Part> parts;
    parts.reserve(curve.size() + count);
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        poller.poll_in_loop(i);
        parts.push_back({segment_length(curve[i + 1] - curve[i], spacing), i, 0.0, 1.0});
    }
    // Sorts have no other place to poll.
    std::size_t comparisons = 0;
    const auto less = [&](const auto& a, const auto& b) {
        poller.poll_in_loop(++comparisons);
        return a < b;
    };
    const std::size_t most = std::min(count, parts.size());  // that may be bisected
    const auto whole_end = parts.begin() + static_cast<std::ptrdiff_t>(most);
    if (most < parts.size()) std::nth_element(parts.begin(), whole_end, parts.end(), less);
    std::sort(parts.begin(), whole_end, less);
    if (parts.front().length == 0.0) return cuts_of_no_length(count);
    // Parts are bisected in the order of their lengths, so the halves are in this order, too. The
    // longest part of all is the next whole segment or the next half.
    runtime::ScratchVector<Part> halves;
    halves.reserve(2 * count);
    runtime::ScratchVector<Cut> cuts;
    cuts.reserve(count);
    auto whole = parts.begin();
    for (std::size_t half = 0; cuts.size() < count;) {
        const bool is_whole =
            whole != whole_end && (half == halves.size() || *whole < halves[half]);
        Part part = is_whole ? *whole++ : halves[half++];
        part.length /= 2.0;
        part.width /= 2.0;
        halves.push_back(part);
        part.start += part.width;
        halves.push_back(part);
        cuts.emplace_back(part.segment, part.start);
    }
    std::sort(cuts.begin(), cuts.end(), less);
    return cuts;
}

Polyline refined(const Polyline& curve, const runtime::ScratchVector<Cut>& cuts, Poller& poller) {
    Polyline result;
    result.reserve(curve.size() + cuts.size());
    auto cut = cuts.begin();
    for (std::size_t i = 0; i < curve.size(); ++i) {
        poller.poll_in_loop(i);
        result.push_back(curve[i]);
        for (; cut != cuts.end() && cut->first == i; ++cut) {
            result.push_back(interpolate(curve[i], curve[i + 1], cut->second));
        }
    }
    return result;
}

// A curve walked by relative arc length.
class RelativeWalk {
   public:
    RelativeWalk(const Polyline& curve, runtime::ScratchVector<double> arc_lengths)
        : curve_(curve), u_(std::move(arc_lengths)) {
        const double length = u_.back();
        const bool measurable = length > 0.0 && std::isfinite(length);
        for (double& u : u_) u = measurable ? u / length : 0.0;
        u_.back() = 1.0;
    }
    bool at_end() const noexcept { return vertex_ + 1 == curve_.size(); }
    // The place of the next vertex; beyond the last one, a place further than any.
    double next() const noexcept { return at_end() ? 2.0 : u_[vertex_ + 1]; }
    // The point at u, at most next(); passes the vertex there.
    curves::Point advance(double u) noexcept {
        if (next() == u) return curve_[++vertex_];
        if (at_end()) return curve_.back();
        const double h = (u - u_[vertex_]) / (u_[vertex_ + 1] - u_[vertex_]);
        return interpolate(curve_[vertex_], curve_[vertex_ + 1], h);
    }

   private:
    const Polyline& curve_;
    runtime::ScratchVector<double> u_;
    std::size_t vertex_ = 0;
};

FacingCurves face_by_arc_length(const Polyline& P, const Polyline& Q,
                                runtime::ScratchVector<double> lengths_p,
                                runtime::ScratchVector<double> lengths_q, Poller& poller) {
    RelativeWalk along_p(P, std::move(lengths_p));
    RelativeWalk along_q(Q, std::move(lengths_q));
    FacingCurves result{{P.front()}, {Q.front()}, {}};
    result.A.reserve(P.size() + Q.size());
    result.B.reserve(P.size() + Q.size());
    while (!along_p.at_end() || !along_q.at_end()) {
        poller.poll_in_loop(result.A.size());
        const double u = std::min(along_p.next(), along_q.next());
        result.A.push_back(along_p.advance(u));
        result.B.push_back(along_q.advance(u));
    }
    return result;
}

}  // namespace

FacingCurves face(const CurveView& P, const CurveView& Q, const curves::RangeScale& range,
                  Spacing spacing, Poller& poller) {
    Polyline A = polyline(P, range, poller);
    Polyline B = polyline(Q, range, poller);
    if (spacing == Spacing::arc_length) {
        const curves::Box box(P);
        return face_by_arc_length(A, B, box_scaled_arc_lengths(P, box, poller),
                                  box_scaled_arc_lengths(Q, box, poller), poller);
    }
    if (A.size() < B.size()) std::swap(A, B);
    runtime::ScratchVector<Cut> cuts;
    if (A.size() > B.size()) {
        cuts = bisection_cuts(B, A.size() - B.size(), spacing, poller);
        B = refined(B, cuts, poller);
    }
    return {std::move(A), std::move(B), std::move(cuts)};
}

}  // namespace curvewise::planar
