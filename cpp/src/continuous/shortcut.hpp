// The edge between two vertices of a curve, compared with the section of the curve between them.
// Every answer is exact (free_space.hpp).
//
// The Fréchet distance of an edge and a section is at most the radius if the vertices of the
// section are within the radius of points of the edge, in their order (Alt & Godau 1995): the least
// such point of a vertex is that of the vertex before it, or where its own reach begins. The
// Hausdorff distance is at most the radius if each vertex is within the radius of the edge: since
// the section leads from one end of the edge to the other, no point of the edge is farther from it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "continuous/boxed_curve.hpp"
#include "continuous/exact_signs.hpp"
#include "continuous/free_space.hpp"
#include "curvewise/curve.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise::continuous {

template <int Dim>
class Shortcut {
   public:
    // `points` are those of the curve, scaled.
    Shortcut(const CurveView& curve, const BoxedCurve& points, const Radius& radius, Poller& poller)
        : curve_(curve),
          points_(points),
          radius_(radius),
          poller_(poller),
          ends_(static_cast<std::size_t>(2 * curve.dim())),
          scaled_ends_(ends_.size()),
          view_(ends_.data(), 2, curve.dim()),
          edge_(scaled_ends_.data(), view_, poller),
          family_(edge_, points, ExactSigns(view_, curve)) {}

    // Makes it the edge between two vertices.
    void place(std::ptrdiff_t from, std::ptrdiff_t to) {
        const auto dim = static_cast<std::size_t>(curve_.dim());
        for (std::size_t side = 0; side < 2; ++side) {
            const std::ptrdiff_t vertex = side == 0 ? from : to;
            const double* const scaled = points_.point<Dim>(vertex);
            std::copy(scaled, scaled + dim, scaled_ends_.data() + side * dim);
            for (std::size_t c = 0; c < dim; ++c) {
                ends_[side * dim + c] = curve_(vertex, static_cast<std::ptrdiff_t>(c));
            }
        }
    }

    // Whether a vertex is within the radius of the edge.
    bool is_near(std::ptrdiff_t k) const {
        return family_.vertex_is_free(0, k, radius_) || family_.vertex_is_free(1, k, radius_) ||
               family_.inside_is_free(0, k, radius_);
    }
    // The first of the vertices between two that are farthest from the edge.
    std::ptrdiff_t farthest_between(std::ptrdiff_t from, std::ptrdiff_t to) const {
        double greatest = -1.0;
        std::ptrdiff_t farthest = from;
        for (std::ptrdiff_t k = from + 1; k < to; ++k) {
            const double square = family_.square_distance_at(0, family_.nearest(0, k), k);
            if (square <= greatest) continue;
            greatest = square;
            farthest = k;
        }
        return farthest;
    }

    // Whether the Fréchet distance of the edge and the section between its vertices is at most the
    // radius.
    bool is_like_section(std::ptrdiff_t from, std::ptrdiff_t to) {
        if (to - from < 2) return true;
        place(from, to);
        if (misses_witness(from, to)) return false;
        poller_.spend(to - from);
        Bound low;
        for (std::ptrdiff_t k = from + 1; k < to; ++k) {
            const FreePart part = family_.free_part(0, k, family_.vertex_is_free(0, k, radius_),
                                                    family_.vertex_is_free(1, k, radius_), radius_);
            if (part.is_empty) {
                remember(farthest_between(from, to));
                return false;
            }
            const FreePart rest = family_.from(0, low, part, radius_);
            if (rest.is_empty) return false;
            low = rest.low;
        }
        return true;
    }

   private:
    // Whether a vertex that was too far from another edge is too far from this one, as it often is.
    // The last of them that was comes first.
    bool misses_witness(std::ptrdiff_t from, std::ptrdiff_t to) {
        for (auto k = witnesses_.begin(); k != witnesses_.end(); ++k) {
            if (*k <= from || *k >= to || is_near(*k)) continue;
            std::rotate(witnesses_.begin(), k, k + 1);
            return true;
        }
        return false;
    }
    // In the place of the one that was of no use for longest.
    void remember(std::ptrdiff_t k) {
        witnesses_.back() = k;
        std::rotate(witnesses_.begin(), witnesses_.end() - 1, witnesses_.end());
    }

    CurveView curve_;
    const BoxedCurve& points_;
    Radius radius_;
    Poller& poller_;
    runtime::ScratchVector<double> ends_, scaled_ends_;
    CurveView view_;
    BoxedCurve edge_;  // its boxes are not read
    EdgeFamily<Dim> family_;
    std::array<std::ptrdiff_t, 16> witnesses_{};  // vertices, or 0
};

}  // namespace curvewise::continuous
