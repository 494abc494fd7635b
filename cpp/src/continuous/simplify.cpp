// Simplification of curves: the fewest points by a search in breadth from the last point backwards,
// and the method of Douglas & Peucker.
#include "curvewise/simplify.hpp"

#include <algorithm>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "continuous/boxed_curve.hpp"
#include "continuous/free_space.hpp"
#include "continuous/plain_range.hpp"
#include "continuous/section_reach.hpp"
#include "continuous/shortcut.hpp"
#include "curves/checks.hpp"
#include "runtime/poller.hpp"
#include "runtime/scratch.hpp"

namespace curvewise {
namespace {

using continuous::BoxedCurve;
using continuous::Radius;
using continuous::SectionReach;
using continuous::Shortcut;
using runtime::Poller;
using Rows = std::vector<std::int64_t>;

// The fewest points. Level k has the vertices from which the last one is reached with k edges and
// not fewer.
template <int Dim>
class FewestPoints {
   public:
    FewestPoints(Shortcut<Dim>& shortcut, const BoxedCurve& points, const Radius& radius,
                 Poller& poller)
        : shortcut_(shortcut),
          reach_(points, radius, poller),
          poller_(poller),
          last_(points.size() - 1),
          next_(static_cast<std::size_t>(points.size()), none) {}

    Rows rows() {
        Level level{last_}, further;
        while (!is_joined_to_first(level)) {
            further.clear();
            for (const std::ptrdiff_t j : level) extend(j, further);
            std::sort(further.begin(), further.end(), std::greater<>());
            std::swap(level, further);
        }
        Rows rows{0};
        while (rows.back() < last_) rows.push_back(next_[static_cast<std::size_t>(rows.back())]);
        return rows;
    }

   private:
    using Level = runtime::ScratchVector<std::ptrdiff_t>;
    static constexpr std::ptrdiff_t none = -1;

    // Whether an edge leads from the first vertex to one of a level, which makes other vertices
    // needless.
    bool is_joined_to_first(const Level& level) {
        for (const std::ptrdiff_t j : level) {
            if (!shortcut_.is_like_section(0, j)) continue;
            next_[0] = j;
            return true;
        }
        return false;
    }
    // Adds the vertices before j from which an edge leads to it, and which are in no level yet. The
    // vertices of a level come in descending order, so each is followed by the last possible one.
    void extend(std::ptrdiff_t j, Level& further) {
        for (const std::ptrdiff_t i : reach_.before(j)) {
            poller_.spend(1);
            std::ptrdiff_t& next = next_[static_cast<std::size_t>(i)];
            if (next != none || !shortcut_.is_like_section(i, j)) continue;
            next = j;
            further.push_back(i);
        }
    }

    Shortcut<Dim>& shortcut_;
    SectionReach<Dim> reach_;
    Poller& poller_;
    std::ptrdiff_t last_;
    runtime::ScratchVector<std::ptrdiff_t> next_;  // the vertex behind each, or none
};

// Douglas & Peucker.
template <int Dim>
Rows split_at_farthest(Shortcut<Dim>& shortcut, std::ptrdiff_t size, Poller& poller) {
    struct Section {
        std::ptrdiff_t from, to;
    };
    runtime::ScratchVector<Section> open{{0, size - 1}};
    Rows rows;
    while (!open.empty()) {
        const Section section = open.back();
        open.pop_back();
        poller.spend(2 * (section.to - section.from));
        shortcut.place(section.from, section.to);
        std::ptrdiff_t k = section.from + 1;
        while (k < section.to && shortcut.is_near(k)) ++k;
        if (k >= section.to) {
            rows.push_back(section.from);
            continue;
        }
        const std::ptrdiff_t farthest = shortcut.farthest_between(section.from, section.to);
        open.push_back({farthest, section.to});
        open.push_back({section.from, farthest});
    }
    rows.push_back(size - 1);
    return rows;
}

void check_tolerance(double tolerance) {
    if (tolerance >= 0.0) return;
    std::ostringstream message;
    message << "tolerance is " << tolerance << "; give a number >= 0";
    throw std::invalid_argument(message.str());
}

}  // namespace

std::vector<std::int64_t> simplify(const CurveView& curve, double tolerance, EdgeMeasure measure,
                                   Control* control) {
    check_tolerance(tolerance);
    curves::check_shapes({"simplify", 1, false}, {curve, "curve"});
    Poller poller(control);
    poller.begin(curve.size());
    const curves::CheckedCurve checked(curve, "curve", poller);
    if (curve.size() == 1) return {0};
    const curves::RangeScale range = continuous::plain_scale(checked.largest);
    const BoxedCurve points(curve, range, poller);
    const Radius radius(tolerance, range, curve.dim(), continuous::FreeSet::closed);
    Rows rows = continuous::with_dimension(curve.dim(), [&](auto dim) {
        Shortcut<dim> shortcut(curve, points, radius, poller);
        return measure == EdgeMeasure::frechet
                   ? FewestPoints<dim>(shortcut, points, radius, poller).rows()
                   : split_at_farthest(shortcut, curve.size(), poller);
    });
    poller.finish();
    return rows;
}

}  // namespace curvewise
