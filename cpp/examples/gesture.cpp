// A gesture recogniser. Each template is prepared once. A stroke is compared with one template
// after the other, and the best distance so far is the cutoff of the next comparison.
#include <cstddef>
#include <cstdio>
#include <curvewise/curvewise.hpp>
#include <string>
#include <utility>
#include <vector>

namespace {

struct Point {
    double x, y;
};
using Stroke = std::vector<Point>;

// Points on straight lines from corner to corner.
Stroke drawn(const Stroke& corners, int points_per_edge) {
    Stroke stroke;
    for (std::size_t k = 1; k < corners.size(); ++k) {
        for (int i = 0; i < points_per_edge; ++i) {
            const double t = static_cast<double>(i) / points_per_edge;
            const Point a = corners[k - 1], b = corners[k];
            stroke.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    stroke.push_back(corners.back());
    return stroke;
}

class Recogniser {
   public:
    void learn(const std::string& name, const Stroke& stroke) {
        curvewise::DtwOptions options;
        options.window_fraction = 0.25;
        templates_.emplace_back(name, curvewise::Prepared(stroke, options));
    }

    // The nearest template, or "unknown" if none is within the limit.
    std::pair<std::string, double> recognise(const Stroke& stroke, double limit) const {
        std::pair<std::string, double> best{"unknown", limit};
        for (const auto& [name, compare] : templates_) {
            curvewise::BatchOptions options;
            options.cutoff = best.second;  // a larger distance becomes infinity, and costs little
            const double distance = compare(stroke, options);
            if (distance < best.second) best = {name, distance};
        }
        return best;
    }

   private:
    std::vector<std::pair<std::string, curvewise::Prepared>> templates_;
};

}  // namespace

int main() {
    Recogniser recogniser;
    recogniser.learn("square", drawn({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, 16));
    recogniser.learn("triangle", drawn({{0, 0}, {4, 0}, {2, 4}, {0, 0}}, 16));
    recogniser.learn("zigzag", drawn({{0, 0}, {1, 4}, {2, 0}, {3, 4}, {4, 0}}, 16));

    const Stroke live = drawn({{0.125, 0}, {4.25, 0.25}, {2, 3.5}, {0, 0.25}}, 32);
    const auto [name, distance] = recogniser.recognise(live, 100.0);
    std::printf("%s %.17g\n", name.c_str(), distance);

    const Stroke scribble = drawn({{9, 9}, {0, 9}, {9, 0}}, 32);
    std::printf("%s\n", recogniser.recognise(scribble, 100.0).first.c_str());
}
