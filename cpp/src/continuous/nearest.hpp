// The largest distance of a vertex of one curve to the other curve: the directed Hausdorff distance
// of a set of points to a curve. It is a lower bound of the continuous Fréchet distance. It is
// equal to the distance for many similar curves, and the search begins there. The value is rounded,
// so it is a guess and not a certified bound. For vertices near enough, a test of the edges around
// the last nearest one suffices; the rest search the tree of boxes. About O(n + log m) for similar
// curves.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "continuous/boxed_curve.hpp"
#include "runtime/poller.hpp"

namespace curvewise::continuous {

// The vertex furthest from the curve.
struct Furthest {
    double square = 0.0;  // of its distance, in units of the scaled curves
    std::ptrdiff_t vertex = 0;
};

template <int Dim>
class NearestEdges {
   public:
    NearestEdges(const BoxedCurve& curve, Poller& poller) : curve_(curve), poller_(poller) {}

    // The furthest of all vertices of `points`, or `floor` if all are nearer.
    Furthest furthest(const BoxedCurve& points, const Furthest& floor) const {
        Furthest found = floor;
        std::ptrdiff_t near = 0;
        // The vertices between those of a coarse round are seldom further, so few need a search.
        for (const std::ptrdiff_t step : {std::ptrdiff_t{61}, std::ptrdiff_t{1}}) {
            near = 0;
            for (std::ptrdiff_t i = 0; i < points.size(); i += step) {
                poller_.spend(8);
                const double* const z = points.point<Dim>(i);
                double square = descend(z, near);
                if (square <= found.square) continue;
                square = search(z, square, near);
                if (square > found.square) found = {square, i};
            }
        }
        return found;
    }

    // The square of a point's distance from the curve, whose nearest edge is put into `near`, where
    // the search begins.
    double nearest(const double* z, std::ptrdiff_t& near) const {
        return search(z, descend(z, near), near);
    }

    // From edge `near` to one whose neighbours are not nearer.
    double descend(const double* z, std::ptrdiff_t& near) const {
        double square = square_to_edge(z, near);
        for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, std::ptrdiff_t{-1}}) {
            for (;;) {
                const std::ptrdiff_t edge = near + step;
                if (edge < 0 || edge >= curve_.size() - 1) break;
                const double other = square_to_edge(z, edge);
                if (other >= square) break;
                square = other;
                near = edge;
            }
        }
        return square;
    }

    // Which part of an edge lies before its point nearest to z.
    double fraction(const double* z, std::ptrdiff_t edge) const noexcept {
        const double* const x = curve_.point<Dim>(edge);
        const double* const y = curve_.point<Dim>(edge + 1);
        double uu = 0.0, uw = 0.0;
        for (std::ptrdiff_t c = 0; c < curve_.dim(); ++c) {
            const double u = y[c] - x[c];
            uu += u * u;
            uw += u * (z[c] - x[c]);
        }
        return uu > 0.0 ? std::min(std::max(uw / uu, 0.0), 1.0) : 0.0;
    }

    double square_to_edge(const double* z, std::ptrdiff_t edge) const noexcept {
        const double* const x = curve_.point<Dim>(edge);
        const double* const y = curve_.point<Dim>(edge + 1);
        const double t = fraction(z, edge);
        double square = 0.0;
        for (std::ptrdiff_t c = 0; c < curve_.dim(); ++c) {
            const double h = (z[c] - x[c]) - t * (y[c] - x[c]);
            square += h * h;
        }
        return square;
    }

   private:
    // The nearest edge of all, where one is nearer than `square`.
    double search(const double* z, double square, std::ptrdiff_t& near) const {
        search_box(z, curve_.levels() - 1, 0, square, near);
        return square;
    }

    void search_box(const double* z, int level, std::ptrdiff_t b, double& square,
                    std::ptrdiff_t& near) const {
        if (square_distance_to_box<Dim>(z, curve_.box<Dim>(level, b), curve_.dim()) >= square)
            return;
        poller_.spend(8);
        if (level == 0) {
            constexpr std::ptrdiff_t leaf = BoxedCurve::leaf;
            const std::ptrdiff_t end = std::min((b + 1) * leaf, curve_.size() - 1);
            for (std::ptrdiff_t edge = b * leaf; edge < end; ++edge) {
                const double other = square_to_edge(z, edge);
                if (other >= square) continue;
                square = other;
                near = edge;
            }
            return;
        }
        search_box(z, level - 1, 2 * b, square, near);
        if (2 * b + 1 < curve_.boxes(level - 1)) search_box(z, level - 1, 2 * b + 1, square, near);
    }

    const BoxedCurve& curve_;
    Poller& poller_;
};

}  // namespace curvewise::continuous
