#include "curvewise/symmetric_difference.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "curves/checks.hpp"
#include "curves/polyline.hpp"
#include "curves/range_scale.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise {
namespace {

using curves::Point;
using curves::Polyline;
using runtime::Poller;

// An edge that is not vertical, from left to right.
struct Edge {
    Point a, b;

    double at(double x) const noexcept {
        if (x <= a.x) return a.y;
        if (x >= b.x) return b.y;
        return interpolate(a, b, (x - a.x) / (b.x - a.x)).y;
    }
};

void add_edges(const Polyline& points, runtime::ScratchVector<Edge>& edges) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point &a = points[i], &b = points[i + 1 == points.size() ? 0 : i + 1];
        if (a.x < b.x) edges.push_back({a, b});
        if (b.x < a.x) edges.push_back({b, a});
    }
}

// The slabs between neighbouring x of points, one after the other. The even-odd rule for the edges
// of both curves together gives the symmetric difference.
class Slabs {
   public:
    Slabs(runtime::ScratchVector<Edge> edges, Poller& poller)
        : edges_(std::move(edges)), poller_(poller) {
        std::size_t comparisons = 0;
        std::sort(edges_.begin(), edges_.end(), [&](const Edge& e, const Edge& f) {
            poller.poll_in_loop(++comparisons);
            return e.a.x < f.a.x;
        });
        for (const Edge& edge : edges_) {
            ends_.push_back(edge.a.x);
            ends_.push_back(edge.b.x);
        }
        std::sort(ends_.begin(), ends_.end(), [&](double x, double y) {
            poller.poll_in_loop(++comparisons);
            return x < y;
        });
        ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    }

    double area() {
        double sum = 0.0;
        auto next = edges_.begin();
        for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
            const double low = ends_[i], high = ends_[i + 1];
            active_.erase(std::remove_if(active_.begin(), active_.end(),
                                         [&](const Edge& edge) { return edge.b.x <= low; }),
                          active_.end());
            for (; next != edges_.end() && next->a.x <= low; ++next) active_.push_back(*next);
            find_crossings(low, high);
            double left = low;
            for (const double right : crossings_) {
                sum += (right - left) * every_second_gap(left + 0.5 * (right - left));
                left = right;
            }
            poller_.spend(static_cast<std::int64_t>(active_.size()));
        }
        return sum;
    }

   private:
    struct Crossed {
        double low, high;
    };

    // The x at which active edges cross within a slab, and its end, in their order: two edges cross
    // if their orders on its sides differ.
    void find_crossings(double low, double high) {
        sides_.clear();
        for (const Edge& edge : active_) sides_.push_back({edge.at(low), edge.at(high)});
        std::sort(sides_.begin(), sides_.end(), [](const Crossed& e, const Crossed& f) {
            return e.low < f.low || (e.low == f.low && e.high < f.high);
        });
        crossings_.assign(1, high);
        for (std::size_t i = 1; i < sides_.size(); ++i) {
            for (std::size_t j = i; j > 0 && sides_[j].high < sides_[j - 1].high; --j) {
                const double before = sides_[j].low - sides_[j - 1].low;
                const double behind = sides_[j - 1].high - sides_[j].high;
                const double x = low + before / (before + behind) * (high - low);
                if (x > low && x < high) crossings_.push_back(x);
                std::swap(sides_[j], sides_[j - 1]);
            }
            poller_.spend(1);
        }
        std::sort(crossings_.begin(), crossings_.end());
    }

    // How much of the line at x is enclosed.
    double every_second_gap(double x) {
        heights_.clear();
        for (const Edge& edge : active_) heights_.push_back(edge.at(x));
        std::sort(heights_.begin(), heights_.end());
        double sum = 0.0;
        for (std::size_t k = 0; k + 1 < heights_.size(); k += 2) {
            sum += heights_[k + 1] - heights_[k];
        }
        poller_.spend(static_cast<std::int64_t>(heights_.size()));
        return sum;
    }

    runtime::ScratchVector<Edge> edges_, active_;
    runtime::ScratchVector<double> ends_, crossings_, heights_;
    runtime::ScratchVector<Crossed> sides_;
    Poller& poller_;
};

}  // namespace

double symmetric_difference(const CurveView& P, const CurveView& Q, Control* control) {
    curves::check_shapes({"symmetric_difference", 1, true}, {P, "P"}, {Q, "Q"});
    Poller poller(control);
    poller.begin(P.size() + Q.size());
    const curves::CheckedCurve p(P, "P", poller), q(Q, "Q", poller);
    const curves::RangeScale range(std::max(p.largest, q.largest));
    runtime::ScratchVector<Edge> edges;
    edges.reserve(static_cast<std::size_t>(P.size() + Q.size()));
    add_edges(curves::polyline(P, range, poller), edges);
    add_edges(curves::polyline(Q, range, poller), edges);
    const double area = Slabs(std::move(edges), poller).area();
    poller.finish();
    return range.restore(area, 2);
}

}  // namespace curvewise
