#include "planar/symmetric_difference.hpp"

#include <utility>

namespace curvewise::planar {

using curves::Polyline;

SymmetricDifference::SymmetricDifference(const Polyline& P, const Polyline& Q,
                                         runtime::Poller& poller)
    : origin_(P.front()), poller_(poller) {
    edges_.reserve(P.size() + Q.size());
    add_edges(P, 0);
    add_edges(Q, 1);
    std::size_t comparisons = 0;
    std::sort(edges_.begin(), edges_.end(), [&](const Edge& e, const Edge& f) {
        poller.poll_in_loop(++comparisons);
        return e.a.x < f.a.x;
    });
    ends_.reserve(2 * edges_.size());
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

void SymmetricDifference::add_edges(const Polyline& points, std::size_t polygon) {
    Point a = points.back() - origin_;
    for (const Point& point : points) {
        const Point b = point - origin_;
        if (a.x < b.x) edges_.push_back({a, b, polygon, 1});
        if (b.x < a.x) edges_.push_back({b, a, polygon, -1});
        a = b;
    }
}

void SymmetricDifference::enter_slab(double low, double high) {
    active_.erase(std::remove_if(active_.begin(), active_.end(),
                                 [&](const Edge& edge) { return edge.b.x <= low; }),
                  active_.end());
    for (; next_ < edges_.size() && edges_[next_].a.x <= low; ++next_) {
        active_.push_back(edges_[next_]);
    }
    find_crossings(low, high);
    poller_.spend(static_cast<std::int64_t>(active_.size()));
}

// Two edges cross if their orders on the sides of the slab differ.
void SymmetricDifference::find_crossings(double low, double high) {
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

void SymmetricDifference::sort_levels(double x) {
    levels_.clear();
    for (const Edge& edge : active_) levels_.push_back({edge.at(x), &edge});
    std::sort(levels_.begin(), levels_.end(),
              [](const Level& e, const Level& f) { return e.y < f.y; });
    poller_.spend(static_cast<std::int64_t>(levels_.size()));
}

}  // namespace curvewise::planar
