// The tolerance check of a test bench: a measured loop against its reference, with a limit for each
// measure. The exit status is 0 if all limits are kept, 1 if one is exceeded, and 2 after an error.
//   test_bench GAIN      (the sensor's gain: 1 is the reference)
#include <array>
#include <cstdio>
#include <cstdlib>
#include <curvewise/curvewise.hpp>
#include <exception>
#include <map>
#include <string>
#include <vector>

namespace {

using Points = std::vector<std::array<double, 2>>;

// A closed loop: x a triangle wave, y a parabola on each branch.
Points loop(int n, double gain) {
    Points points;
    for (int i = 0; i < n; ++i) {
        const double t = 4.0 * i / (n - 1);
        const double u = t < 2.0 ? t - 1.0 : 3.0 - t;
        const double bow = 0.5 * (1.0 - u * u);
        points.push_back({u, gain * (t < 2.0 ? u + bow : u - bow)});
    }
    return points;
}

const std::map<std::string, double> limits{
    {"area", 0.06}, {"pcm", 0.06}, {"frechet", 0.05}, {"dtw", 4.0}, {"curve_length", 1.0}};

bool check(const Points& reference, const Points& measured) {
    bool is_within = true;
    for (const auto& [measure, value] : curvewise::compare(reference, measured).values) {
        const double limit = limits.at(measure);
        is_within = is_within && value <= limit;
        std::printf("%-12s %.17g %s\n", measure, value, value <= limit ? "" : "exceeds its limit");
    }
    return is_within;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const double gain = argc > 1 ? std::atof(argv[1]) : 1.0;
        const bool is_within = check(loop(129, 1.0), loop(65, gain));
        std::puts(is_within ? "PASS" : "FAIL");
        return is_within ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "test_bench: %s\n", error.what());
        return 2;
    }
}
